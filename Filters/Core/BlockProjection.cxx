// SPDX-License-Identifier: BSD-3-Clause
#include "BlockProjection.h"

#include <cmath>

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs. No sum is reordered, so that only fused multiply-adds make a difference.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "BlockProjection.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#include "TexelLanes-inl.h"

#ifndef po_BlockProjection_cxx
#define po_BlockProjection_cxx
namespace po
{
namespace
{
/// Where a block's middle is in the projection, and its three directions.
struct BlockFrame
{
  Vec3f middle;
  std::array<Vec3f, 3> directions;
};
}
}
#endif

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
/// Replaces offsets from the middle by projected places.
void placeAll(const BlockFrame& frame, ProjectedBlock& block)
{
  const Floats d;
  const auto along =
    [d](hn::Vec<Floats> x, hn::Vec<Floats> y, hn::Vec<Floats> z, float middle, Vec3f direction)
  {
    const auto sum = hn::MulAdd(y, hn::Set(d, direction.y), hn::Mul(x, hn::Set(d, direction.x)));
    return hn::Add(hn::MulAdd(z, hn::Set(d, direction.z), sum), hn::Set(d, middle));
  };
  for (std::size_t i = 0; i < block.count; i += hn::Lanes(d))
  {
    const auto x = hn::LoadU(d, block.x.data() + i);
    const auto y = hn::LoadU(d, block.y.data() + i);
    const auto z = hn::LoadU(d, block.z.data() + i);
    const auto& [right, up, towards] = frame.directions;
    hn::StoreU(along(x, y, z, frame.middle.x, right), d, block.x.data() + i);
    hn::StoreU(along(x, y, z, frame.middle.y, up), d, block.y.data() + i);
    hn::StoreU(along(x, y, z, frame.middle.z, towards), d, block.z.data() + i);
  }
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(placeAll);

namespace
{
/// How far a box reaches along a direction from its middle.
float reachAlong(Vec3d direction, Vec3f half)
{
  return static_cast<float>(std::abs(direction.x)) * half.x +
    static_cast<float>(std::abs(direction.y)) * half.y +
    static_cast<float>(std::abs(direction.z)) * half.z;
}
}

BlockProjection::BlockProjection(const SweepScene& scene, Vec3d axis, const PlaneBasis& basis)
  : scene_(scene)
  , x_(basis.x)
  , y_(basis.y)
  , z_(axis)
{
}

void BlockProjection::project(
  const SweepScene::Block& block, BlockBits spheres, Vec3d origin, ProjectedBlock& result) const
{
  std::size_t count = 0;
  for (; spheres != 0; spheres &= spheres - 1)
  {
    const unsigned index =
      block.first + static_cast<unsigned>(hwy::Num0BitsBelowLS1Bit_Nonzero64(spheres));
    const Vec3f offset = (scene_.center(index) - block.middle).as<float>();
    result.x[count] = offset.x;
    result.y[count] = offset.y;
    result.z[count] = offset.z;
    result.radius[count] = scene_.sphere(index).radius;
    result.index[count] = index;
    ++count;
  }
  result.count = count;
  if (count == 0)
  {
    return;
  }
  const BlockFrame frame{ project(block.middle, origin),
    { x_.as<float>(), y_.as<float>(), z_.as<float>() } };
  HWY_DYNAMIC_DISPATCH(placeAll)(frame, result);
}

Vec3f BlockProjection::project(Vec3d place, Vec3d origin) const
{
  const Vec3d offset = place - origin;
  return { static_cast<float>(dot(offset, x_)), static_cast<float>(dot(offset, y_)),
    static_cast<float>(dot(offset, z_)) };
}

float BlockProjection::reachX(const SweepScene::Block& block) const
{
  return reachAlong(x_, block.half);
}

float BlockProjection::reachY(const SweepScene::Block& block) const
{
  return reachAlong(y_, block.half);
}
}
#endif
