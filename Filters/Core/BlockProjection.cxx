// SPDX-License-Identifier: BSD-3-Clause
#include "BlockProjection.h"

#include <hwy/base.h>

#include <cmath>

namespace po
{
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
    const Vec3f place = project(scene_.center(index), origin);
    result.x[count] = place.x;
    result.y[count] = place.y;
    result.z[count] = place.z;
    result.radius[count] = scene_.sphere(index).radius;
    result.index[count] = index;
    ++count;
  }
  result.count = count;
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
