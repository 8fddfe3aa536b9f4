// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_FrameLayers_h
#define po_FrameLayers_h

#include "SphereRenderer.h"

#include "vtkSmartPointer.h"

class vtkImageData;

namespace po
{
/// The traced and shaded frame as an image with the point arrays RGBA, Z, AO, N and id, see
/// vtkRayTracedSphereMapper::GetLayers.
[[nodiscard]] vtkSmartPointer<vtkImageData> makeLayers(
  const SphereRenderer& renderer, const OcclusionTextures& textures);
}

#endif
