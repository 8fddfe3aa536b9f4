// SPDX-License-Identifier: BSD-3-Clause
#include "SweepTexels.h"

#include "Constants.h"
#include "Random.h"
#include "Sampling.h"
#include "TexelMap.h"

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
constexpr int SmallestResolution = 12;
constexpr int Side = static_cast<int>(PatchSide);

/// Fractional part of a sum of two numbers in [0, 1).
double wrapped(double a)
{
  return a - std::floor(a);
}
}

void TexelDiscs::add(Vec3d center, double radius)
{
  x.push_back(static_cast<float>(center.x));
  y.push_back(static_cast<float>(center.y));
  z.push_back(static_cast<float>(center.z));
  cosRadius.push_back(static_cast<float>(std::cos(radius)));
  sinRadius.push_back(static_cast<float>(std::sin(radius)));
}

SweepTexels::SweepTexels(int textureResolution)
  : refinement_((SmallestResolution + textureResolution - 1) / textureResolution)
  , resolution_(refinement_ * textureResolution)
{
  const int patches = (resolution_ + Side - 1) / Side;
  for (int patch = 0; patch < patches * patches; ++patch)
  {
    for (int k = 0; k < static_cast<int>(GroupSize); ++k)
    {
      const int row = patch / patches * Side + k / Side;
      const int column = patch % patches * Side + k % Side;
      const bool exists = row < resolution_ && column < resolution_;
      const TextureCoordinate middle{ (column + 0.5) / resolution_, (row + 0.5) / resolution_ };
      texelOfSlot_.push_back(
        exists ? static_cast<std::uint32_t>(texelIndex(resolution_, row, column)) : Empty);
      discs_.add(exists ? textureDirection(middle) : Vec3d(),
        exists ? texelAngularRadius(resolution_, row) : 0);
    }
  }
  addGroupDiscs();
  allBits_.assign(groups(), 0);
  for (std::size_t slot = 0; slot < slots(); ++slot)
  {
    const bool exists = texelOfSlot_[slot] != Empty;
    GroupMask& mask = allBits_[slot / GroupSize];
    mask = static_cast<GroupMask>(mask | unsigned(exists) << (slot % GroupSize));
  }
}

void SweepTexels::addGroupDiscs()
{
  const auto centerOf = [&](std::size_t slot) {
    return Vec3f{ discs_.x[slot], discs_.y[slot], discs_.z[slot] }.as<double>();
  };
  for (std::size_t first = 0; first < slots(); first += GroupSize)
  {
    Vec3d sum; // empty slots add nothing
    for (std::size_t slot = first; slot < first + GroupSize; ++slot)
    {
      sum = sum + centerOf(slot);
    }
    const Vec3d center = normalized(sum);
    double radius = 0;
    for (std::size_t slot = first; slot < first + GroupSize; ++slot)
    {
      if (texelOfSlot_[slot] != Empty)
      {
        const double cosine = std::min(dot(center, normalized(centerOf(slot))), 1.0);
        const double own =
          std::atan2(double(discs_.sinRadius[slot]), double(discs_.cosRadius[slot]));
        radius = std::max(radius, std::acos(cosine) + own);
      }
    }
    groupDiscs_.add(center, std::min(radius, Pi));
  }
  while (groupDiscs_.x.size() % GroupSize != 0)
  {
    groupDiscs_.add({}, 0);
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

TexelPoints::TexelPoints(const TexelPatterns& patterns)
  : x(patterns.x.size())
  , y(x.size())
  , z(x.size())
{
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    const std::size_t from =
      TexelPatterns::index(i % TexelPatterns::Count, i / TexelPatterns::Count);
    x[i] = patterns.x[from];
    y[i] = patterns.y[from];
    z[i] = patterns.z[from];
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
