// SPDX-License-Identifier: BSD-3-Clause
#include "SweepTexels.h"

#include "Random.h"
#include "Sampling.h"
#include "TexelMap.h"

#include <cmath>

namespace po
{
namespace
{
constexpr int SmallestResolution = 12;
constexpr int PatchSide = 4;
static_assert(PatchSide * PatchSide == static_cast<int>(GroupSize));

/// Fractional part of a sum of two numbers in [0, 1).
double wrapped(double a)
{
  return a - std::floor(a);
}
}

SweepTexels::SweepTexels(int textureResolution)
  : refinement_((SmallestResolution + textureResolution - 1) / textureResolution)
  , resolution_(refinement_ * textureResolution)
{
  const int patches = (resolution_ + PatchSide - 1) / PatchSide;
  for (int patch = 0; patch < patches * patches; ++patch)
  {
    for (int k = 0; k < static_cast<int>(GroupSize); ++k)
    {
      const int row = patch / patches * PatchSide + k / PatchSide;
      const int column = patch % patches * PatchSide + k % PatchSide;
      const bool exists = row < resolution_ && column < resolution_;
      const TextureCoordinate middle{ (column + 0.5) / resolution_, (row + 0.5) / resolution_ };
      texelOfSlot_.push_back(
        exists ? static_cast<std::uint32_t>(texelIndex(resolution_, row, column)) : Empty);
      const Vec3f center = exists ? textureDirection(middle).as<float>() : Vec3f();
      const double radius = exists ? texelAngularRadius(resolution_, row) : 0;
      discs_.x.push_back(center.x);
      discs_.y.push_back(center.y);
      discs_.z.push_back(center.z);
      discs_.cosRadius.push_back(static_cast<float>(std::cos(radius)));
      discs_.sinRadius.push_back(static_cast<float>(std::sin(radius)));
    }
  }
  allBits_.assign(groups(), 0);
  for (std::size_t slot = 0; slot < slots(); ++slot)
  {
    const bool exists = texelOfSlot_[slot] != Empty;
    GroupMask& mask = allBits_[slot / GroupSize];
    mask = static_cast<GroupMask>(mask | unsigned(exists) << (slot % GroupSize));
  }
}

TexelPatterns::TexelPatterns(const SweepTexels& texels, std::uint64_t seed, std::uint32_t epoch)
  : x(Count * texels.slots())
  , y(x.size())
  , z(x.size())
{
  // The plastic number gives the Kronecker sequence of two dimensions that is spread best (Roberts
  // 2018); every texel shifts it by an amount of its own.
  constexpr double stepS = 0.75487766624669276;
  constexpr double stepT = 0.56984029099805327;
  for (std::size_t slot = 0; slot < texels.slots(); ++slot)
  {
    const std::uint32_t texel = texels.texelOfSlot(slot);
    if (texel == SweepTexels::Empty)
    {
      continue;
    }
    const auto columns = static_cast<std::uint32_t>(texels.resolution());
    const TexelPatch patch(
      texels.resolution(), static_cast<int>(texel / columns), static_cast<int>(texel % columns));
    Random random(seed, 0, texel);
    const double shiftS = random.uniform();
    const double shiftT = random.uniform();
    for (std::size_t pattern = 0; pattern < Count; ++pattern)
    {
      const double k = static_cast<double>(epoch) * Count + static_cast<double>(pattern);
      const Vec3d n = patch.point(wrapped(shiftS + stepS * k), wrapped(shiftT + stepT * k));
      const std::size_t i = index(pattern, slot);
      x[i] = static_cast<float>(n.x);
      y[i] = static_cast<float>(n.y);
      z[i] = static_cast<float>(n.z);
    }
  }
}

std::size_t PatternTurns::next()
{
  if (order_.empty())
  {
    Random random(mixBits(rounds_++), 0, 0);
    order_.resize(TexelPatterns::Count);
    randomPermutation(random, order_);
  }
  const std::size_t pattern = order_.back();
  order_.pop_back();
  return pattern;
}

FacingTexels::FacingTexels(const SweepTexels& texels, const TexelPatterns& patterns,
  std::size_t pattern, const PlaneBasis& basis, Vec3d direction)
  : facing(texels.groups(), 0)
{
  for (std::size_t slot = 0; slot < texels.slots(); ++slot)
  {
    const Vec3d n = patterns.normal(pattern, slot).as<double>();
    const auto height = static_cast<float>(dot(n, direction));
    const bool faces = height > 0;
    GroupMask& mask = facing[slot / GroupSize];
    mask = static_cast<GroupMask>(mask | (unsigned(faces) << (slot % GroupSize)));
    u.push_back(static_cast<float>(dot(n, basis.x)));
    v.push_back(static_cast<float>(dot(n, basis.y)));
    w.push_back(height);
  }
  for (std::uint32_t g = 0; g < facing.size(); ++g)
  {
    if (facing[g] != 0)
    {
      facingGroups.push_back(g);
    }
  }
}
}
