// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_FrameLayers_h
#define po_FrameLayers_h

#include "SphereRenderer.h"

#include "vtkSmartPointer.h"

class vtkImageData;

namespace po
{
/// An image with the point arrays RGBA, Z, AO, N and id, see vtkRayTracedSphereMapper::GetLayers,
/// whose values are yet to come.
[[nodiscard]] vtkSmartPointer<vtkImageData> newLayers(int width, int height);

/// Fills rows of the image, from `firstRow` on, with the traced and shaded frame, which is as wide.
void fillLayers(const SphereRenderer& renderer, const OcclusionTextures& textures, int firstRow,
  vtkImageData* image);
}

#endif
