// SPDX-License-Identifier: BSD-3-Clause
#include "SharedDirections.h"

#include "TexelMap.h"

namespace po
{
SharedDirection::SharedDirection(const SweepTexels& texels, const TexelPatterns& patterns,
  std::size_t patternIndex, Vec3d direction, double luminance)
  : towardsLight(direction)
  , basis(planeBasis(direction))
  , pattern(patternIndex)
  , index(0)
  , facing(texels, patterns, pattern, basis, direction, luminance)
  , normals(texels.slots())
  , importance(texels.slots())
{
  for (std::size_t slot = 0; slot < texels.slots(); ++slot)
  {
    normals[slot] = patterns.normal(pattern, slot);
    importance[slot] =
      facing.weight[slot] * static_cast<float>(texelArea(texels.resolution(), texels.rowOf(slot)));
  }
}

SharedDirections::SharedDirections(const SweepTexels& texels, const Background& background,
  const std::vector<Vec3d>& axes, std::size_t first, std::uint64_t seed, std::uint32_t epoch)
  : patterns_(texels, seed, epoch)
{
  directions_.reserve(2 * axes.size());
  for (std::size_t i = 0; i < 2 * axes.size(); ++i)
  {
    const Vec3d direction = i % 2 == 0 ? axes[i / 2] : -axes[i / 2];
    const double light = luminance(background, direction);
    if (light <= 0)
    {
      ++black_;
      continue;
    }
    directions_.emplace_back(texels, patterns_, i % TexelPatterns::Count, direction, light);
    directions_.back().index = first + i;
  }
}
}
