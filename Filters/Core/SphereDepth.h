// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereDepth_h
#define po_SphereDepth_h

#include "Camera.h"
#include "DepthSource.h"
#include "Sphere.h"
#include "SphereScene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// Depths of spheres, one sample a pixel, with the spheres that the pixels show.
class SphereDepth : public DepthSource
{
public:
  /// A sphere and the layer whose local coordinates it has.
  struct NumberedSphere
  {
    std::size_t layer;
    const Sphere* sphere;
  };

  [[nodiscard]] virtual NumberedSphere sphereOf(std::uint32_t number) const = 0;

  /// Numbers of the spheres that the pixels of a block show, SphereScene::None where there is none;
  /// as many numbers as the block has depths.
  virtual void fillSpheres(const SampleBlock& block, std::vector<std::uint32_t>& numbers) const = 0;

  /// Layers are spheres of one system of local coordinates.
  [[nodiscard]] virtual std::size_t layerCount() const = 0;

  /// The eye rays in the coordinates of a layer.
  [[nodiscard]] virtual const PrimaryRays& raysOf(std::size_t layer) const = 0;
};
}

#endif
