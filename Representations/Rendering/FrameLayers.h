// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_FrameLayers_h
#define po_FrameLayers_h

#include "SphereRenderer.h"

#include "vtkSmartPointer.h"

#include <cstdint>

class vtkImageData;

namespace po
{
/// An image with the point arrays RGBA, Z, AO, N and id, see vtkRayTracedSphereMapper::GetLayers,
/// whose values are yet to come.
[[nodiscard]] vtkSmartPointer<vtkImageData> newLayers(int width, int height);

/// Fills rows of the image, from `firstRow` on, with the traced and shaded frame, which is as wide.
void fillLayers(const SphereRenderer& renderer, const OcclusionTextures& textures, int firstRow,
  vtkImageData* image);

/// Traces, shades and refines a picture of any size in parts of up to 4 million pixels.
/// @return its layers; an empty image if nothing can be drawn, see SphereRenderer::trace
[[nodiscard]] vtkSmartPointer<vtkImageData> traceLayers(SphereRenderer& renderer,
  const Camera& camera, const Matrix4& modelToWorld, const Style& style, int samples);

/// Layers of the last frame, made when they are asked for.
class LastLayers
{
public:
  /// @param version another number for other pictures
  /// @return the layers of the shaded frame, an empty image if there is none; kept by this object
  [[nodiscard]] vtkImageData* update(
    const SphereRenderer& renderer, const OcclusionTextures& textures, std::uint64_t version);

  /// Pictures of this version do not replace the layers at hand.
  void keepAt(std::uint64_t version) { version_ = version; }

  void forget();

private:
  vtkSmartPointer<vtkImageData> layers_;
  std::uint64_t version_ = 0;
};
}

#endif
