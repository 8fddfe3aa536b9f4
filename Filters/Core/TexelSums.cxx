// SPDX-License-Identifier: BSD-3-Clause
#include "TexelSums.h"

#include "TexelMap.h"
#include "TexelMask.h"

#include <algorithm>
#include <cmath>

namespace po
{
void OpenSums::add(const SharedDirections& set)
{
  for (const SharedDirection& direction : set.directions())
  {
    const FacingTexels& facing = direction.facing;
    addMasked(facing.groups(), facing.facing.data(), direction.weight.data(), total.data());
    addMasked(facing.groups(), facing.facing.data(), direction.weight.data(),
      subsets.data() + subsetOf(direction) * total.size());
  }
}

TexelSums::TexelSums(std::size_t slotCount, bool spread)
  : slots(slotCount)
  , sums(slots, 0.0f)
  , subsets(spread ? DirectionSubsets * slots : 0, 0.0f)
{
}

void TexelSums::makeCut()
{
  weights.assign(slots, 0.0f);
  subsetWeights.assign(subsets.size(), 0.0f);
  shares.assign(slots, 0.0f);
  irradiance.assign(slots, 0.0f);
}

void TexelSums::add(
  const SharedDirection& direction, const GroupMask* exposed, const GroupMask* seen)
{
  const FacingTexels& facing = direction.facing;
  addMasked(facing.groups(), seen, direction.weight.data(), sums.data());
  const std::size_t subset = subsetOf(direction) * slots;
  if (hasSubsets())
  {
    addMasked(facing.groups(), seen, direction.weight.data(), subsets.data() + subset);
  }
  if (isCut())
  {
    addMasked(facing.groups(), exposed, direction.weight.data(), weights.data());
  }
  if (isCut() && hasSubsets())
  {
    addMasked(facing.groups(), exposed, direction.weight.data(), subsetWeights.data() + subset);
  }
}

SumTextures::SumTextures(
  const SweepTexels& texels, const TexelPatterns& patterns, const Background& background)
  : texels_(texels)
  , uniform_(std::holds_alternative<UniformBackground>(background))
  , ones_(TexelPatterns::Count * GroupSize, 1.0f)
  , irradiance_(TexelPatterns::Count * texels.slots(), 0.0f)
  , openIrradiance_(texels.slots(), 0.0f)
{
  const BackgroundIrradiance irradiance(background);
  for (std::size_t slot = 0; slot < texels.slots(); ++slot)
  {
    if (texels.texelOfSlot(slot) == SweepTexels::Empty)
    {
      continue;
    }
    double sum = 0;
    for (std::size_t pattern = 0; pattern < TexelPatterns::Count; ++pattern)
    {
      const double value = irradiance(normalized(patterns.normal(pattern, slot).as<double>()));
      irradiance_[TexelPatterns::index(pattern, slot)] = static_cast<float>(value);
      sum += value;
    }
    openIrradiance_[slot] = static_cast<float>(sum / TexelPatterns::Count);
  }
  for (int row = 0; row < texels.resolution(); ++row)
  {
    areas_.push_back(texelArea(texels.resolution(), row));
  }
}

void SumTextures::measureCut(const TexelExposure& exposure, TexelSums& sums) const
{
  const std::size_t groups = texels_.groups();
  for (std::size_t group = 0; group < groups; ++group)
  {
    const GroupMask* exposed = exposure.bits.data() + group;
    const std::size_t slot = group * GroupSize;
    addOverPoints(exposed, groups, ones_.data(), sums.shares.data() + slot);
    addOverPoints(exposed, groups, irradiance_.data() + TexelPatterns::index(0, slot),
      sums.irradiance.data() + slot);
  }
  for (std::size_t slot = 0; slot < texels_.slots(); ++slot)
  {
    const float points = sums.shares[slot];
    sums.shares[slot] = points / TexelPatterns::Count;
    sums.irradiance[slot] = uniform_ || points == TexelPatterns::Count
      ? openIrradiance_[slot]
      : sums.irradiance[slot] / std::max(points, 1.0f);
  }
}

std::size_t SumTextures::texelCount() const
{
  const auto side = static_cast<std::size_t>(texels_.resolution() / texels_.refinement());
  return side * side;
}

void SumTextures::coarsen(
  const TexelSums& cut, const float* sums, const float* weights, float* values, float* shares) const
{
  const int side = texels_.resolution() / texels_.refinement();
  const std::size_t count = texelCount();
  const float* irradiance = cut.isCut() ? cut.irradiance.data() : openIrradiance_.data();
  std::vector<double> light(count, 0.0);
  std::vector<double> outside(count, 0.0);
  std::vector<double> area(count, 0.0);
  for (std::size_t slot = 0; slot < texels_.slots(); ++slot)
  {
    const std::uint32_t texel = texels_.texelOfSlot(slot);
    if (texel == SweepTexels::Empty)
    {
      continue;
    }
    const int row = static_cast<int>(texel) / texels_.resolution();
    const int column = static_cast<int>(texel) % texels_.resolution();
    const std::size_t target =
      texelIndex(side, row / texels_.refinement(), column / texels_.refinement());
    const double size = areas_[static_cast<std::size_t>(row)];
    area[target] += size;
    if (weights[slot] > 0)
    {
      const double exposed = cut.isCut() ? size * static_cast<double>(cut.shares[slot]) : size;
      const float open = std::min(sums[slot] / weights[slot], 1.0f);
      light[target] += exposed * static_cast<double>(open) * static_cast<double>(irradiance[slot]);
      outside[target] += exposed;
    }
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    values[i] = outside[i] > 0 ? static_cast<float>(light[i] / outside[i]) : 0.0f;
    shares[i] = static_cast<float>(outside[i] / area[i]);
  }
}

void SumTextures::fill(
  const TexelSums& sums, const OpenSums& open, float* values, float* shares) const
{
  if (sums.buried)
  {
    std::fill(values, values + texelCount(), 0.0f);
    std::fill(shares, shares + texelCount(), 0.0f);
    return;
  }
  const std::vector<float>& weights = sums.isCut() ? sums.weights : open.total;
  coarsen(sums, sums.sums.data(), weights.data(), values, shares);
}

double SumTextures::SquaredError::rms() const
{
  return area > 0 ? std::sqrt(sum / area) : 0;
}

SumTextures::SquaredError SumTextures::squaredError(
  const TexelSums& sums, const OpenSums& open) const
{
  SquaredError error;
  if (sums.buried)
  {
    return error;
  }
  const std::size_t slots = texels_.slots();
  const std::size_t count = texelCount();
  std::vector<float> shares(count);
  std::vector<float> values(DirectionSubsets * count);
  const std::vector<float>& weights = sums.isCut() ? sums.subsetWeights : open.subsets;
  for (std::size_t subset = 0; subset < DirectionSubsets; ++subset)
  {
    coarsen(sums, sums.subsets.data() + subset * slots, weights.data() + subset * slots,
      values.data() + subset * count, shares.data());
  }
  const int side = texels_.resolution() / texels_.refinement();
  for (std::size_t i = 0; i < count; ++i)
  {
    const double area =
      texelArea(side, static_cast<int>(i) / side) * static_cast<double>(shares[i]);
    std::array<double, DirectionSubsets> v{};
    double mean = 0;
    for (std::size_t subset = 0; subset < DirectionSubsets; ++subset)
    {
      v[subset] = static_cast<double>(values[subset * count + i]);
      mean += v[subset] / DirectionSubsets;
    }
    error.area += area;
    for (const double value : v)
    {
      error.sum +=
        area * (value - mean) * (value - mean) / (DirectionSubsets * (DirectionSubsets - 1));
    }
  }
  return error;
}
}
