// SPDX-License-Identifier: BSD-3-Clause
#include "NearSpheres.h"

namespace po
{
void NearSpheres::clear()
{
  size_ = 0;
  blocks_.clear();
}

void NearSpheres::add(Vec3f center, float radius)
{
  const std::size_t place = size_ % BlockSize;
  if (place == 0)
  {
    blocks_.push_back({});
  }
  Block& block = blocks_.back();
  block.x[place] = center.x;
  block.y[place] = center.y;
  block.z[place] = center.z;
  block.squaredRadius[place] = radius * radius;
  block.squaredTouch[place] = (1 + radius) * (1 + radius);
  ++size_;
}

void NearSpheres::project(
  std::size_t block, const SharedDirection& direction, Projection& projection) const
{
  const Block& spheres = blocks_[block];
  const Vec3f x = direction.basis.x.as<float>();
  const Vec3f y = direction.basis.y.as<float>();
  const Vec3f z = direction.towardsLight.as<float>();
  for (std::size_t i = 0; i < BlockSize; ++i)
  {
    const Vec3f center{ spheres.x[i], spheres.y[i], spheres.z[i] };
    const float a = dot(center, x);
    const float b = dot(center, y);
    const float height = dot(center, z);
    projection.a[i] = a;
    projection.b[i] = b;
    projection.height[i] = height;
    projection.meets[i] = unsigned(height > 0) & unsigned(a * a + b * b < spheres.squaredTouch[i]);
  }
}
}
