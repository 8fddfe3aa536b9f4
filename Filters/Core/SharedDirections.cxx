// SPDX-License-Identifier: BSD-3-Clause
#include "SharedDirections.h"

#include "Random.h"
#include "Sampling.h"
#include "TexelMap.h"

#include <algorithm>

namespace po
{
namespace
{
/// The patterns take turns in an order that is drawn anew for each round: the heights of the
/// directions follow powers of two, as does the number of patterns, and in a fixed order each
/// pattern would see a part of the sky only.
class PatternOrder
{
public:
  PatternOrder(std::uint64_t seed, std::uint32_t epoch)
    : random_(mixBits(seed), epoch, 0)
    , order_(TexelPatterns::Count)
  {
  }

  std::size_t next()
  {
    const std::size_t place = taken_++ % order_.size();
    if (place == 0)
    {
      randomPermutation(random_, order_);
    }
    return order_[place];
  }

private:
  Random random_;
  std::vector<std::uint32_t> order_;
  std::size_t taken_ = 0;
};
}

SharedDirection::SharedDirection(const SweepTexels& texels, const TexelPatterns& patterns,
  std::size_t patternIndex, Vec3d direction, double luminance)
  : towardsLight(direction)
  , basis(planeBasis(direction))
  , pattern(patternIndex)
  , index(0)
  , facing(texels, patterns, pattern, basis, direction)
  , weight(texels.slots(), 0.0f)
  , normals(texels.slots())
  , importance(texels.slots())
{
  for (std::size_t slot = 0; slot < texels.slots(); ++slot)
  {
    const std::uint32_t texel = texels.texelOfSlot(slot);
    if (texel != SweepTexels::Empty)
    {
      const int row = static_cast<int>(texel) / texels.resolution();
      const auto area = static_cast<float>(texelArea(texels.resolution(), row));
      normals[slot] = patterns.normal(pattern, slot);
      weight[slot] =
        std::max(0.0f, static_cast<float>(luminance * static_cast<double>(facing.w[slot])));
      importance[slot] = weight[slot] * area;
    }
  }
}

SharedDirections::SharedDirections(const SweepTexels& texels, const Background& background,
  const std::vector<Vec3d>& axes, std::size_t first, std::uint64_t seed, std::uint32_t epoch)
  : patterns_(texels, seed, epoch)
{
  directions_.reserve(2 * axes.size());
  PatternOrder order(seed, epoch);
  for (std::size_t i = 0; i < 2 * axes.size(); ++i)
  {
    const Vec3d direction = i % 2 == 0 ? axes[i / 2] : -axes[i / 2];
    const std::size_t pattern = order.next();
    const double light = luminance(background, direction);
    if (light <= 0)
    {
      ++black_;
      continue;
    }
    directions_.emplace_back(texels, patterns_, pattern, direction, light);
    directions_.back().index = first + i;
  }
}
}
