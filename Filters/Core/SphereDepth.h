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
/// Spheres of one system of local coordinates.
struct SphereLayer
{
  const Sphere* spheres;
  std::uint32_t firstNumber, count; ///< number of the first of them, which the others follow
  const PrimaryRays* rays;          ///< the eye rays in these coordinates
};

/// Depths of spheres, one sample a pixel, with the spheres that the pixels show.
class SphereDepth : public DepthSource
{
public:
  /// Numbers of the spheres that the pixels of a block show, SphereScene::None where there is none;
  /// as many numbers as the block has depths.
  virtual void fillSpheres(const SampleBlock& block, std::vector<std::uint32_t>& numbers) const = 0;

  [[nodiscard]] virtual std::size_t layerCount() const = 0;
  [[nodiscard]] virtual SphereLayer layer(std::size_t index) const = 0;
};
}

#endif
