// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BlockProjection_h
#define po_BlockProjection_h

#include "SweepDirections.h"
#include "SweepScene.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace po
{
/// A bit for each sphere of a block of the SweepScene, the first one lowest.
using BlockBits = std::uint64_t;
static_assert(SweepScene::BlockSize == 64);

/// Some spheres of a block seen along an axis: x, y across, z along it. Places from `count` on have
/// any finite numbers.
struct ProjectedBlock
{
  static constexpr std::size_t Capacity = SweepScene::BlockSize;

  std::size_t count = 0;
  std::array<float, Capacity> x{}, y{}, z{}, radius{};
  std::array<unsigned, Capacity> index{}; ///< in the SweepScene
};

/// Projects blocks of spheres along an axis.
class BlockProjection
{
public:
  BlockProjection(const SweepScene& scene, Vec3d axis, const PlaneBasis& basis);

  /// The spheres of a block that are named, relative to an origin. Doubles are rounded once, so
  /// that a sphere's place does not depend on those that it shares a block with: processes that
  /// have other neighbours of it must find the same.
  void project(
    const SweepScene::Block& block, BlockBits spheres, Vec3d origin, ProjectedBlock& result) const;

  /// A place along the three directions of the projection.
  [[nodiscard]] Vec3f project(Vec3d place, Vec3d origin) const;

  /// How far the box of a block reaches from its middle along x and y.
  [[nodiscard]] float reachX(const SweepScene::Block& block) const;
  [[nodiscard]] float reachY(const SweepScene::Block& block) const;

private:
  const SweepScene& scene_;
  Vec3d x_, y_, z_;
};
}

#endif
