// SPDX-License-Identifier: BSD-3-Clause
#include "SweepTextures.h"

#include "Constants.h"
#include "TexelMap.h"
#include "TexelMask.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace po
{
SweepTextures::SweepTextures(const VisibilityRecords& records, const Background& background)
  : records_(records)
{
  const SweepTexels& texels = records.texels();
  const TexelPatterns& patterns = records.patterns();
  const BackgroundIrradiance irradiance(background);
  irradiance_.resize(TexelPatterns::Count * texels.slots());
  openIrradiance_.resize(texels.slots());
  for (std::size_t slot = 0; slot < texels.slots(); ++slot)
  {
    if (texels.texelOfSlot(slot) == SweepTexels::Empty)
    {
      continue;
    }
    double sum = 0;
    for (std::size_t p = 0; p < TexelPatterns::Count; ++p)
    {
      const double value = irradiance(normalized(patterns.normal(p, slot).as<double>()));
      irradiance_[patterns.index(p, slot)] = static_cast<float>(value);
      sum += value;
    }
    openIrradiance_[slot] = static_cast<float>(sum / TexelPatterns::Count);
  }
  for (int row = 0; row < texels.resolution(); ++row)
  {
    areas_.push_back(texelArea(texels.resolution(), row));
  }
}

SweepTextures::FineTexels SweepTextures::fineTexels(unsigned sphere) const
{
  const std::size_t slots = records_.texels().slots();
  const std::size_t groups = records_.texels().groups();
  FineTexels fine{ openIrradiance_, std::vector<float>(slots, 1.0f),
    records_.outsideWeights(sphere) };
  const CutSphere* cut = records_.cut(sphere);
  if (cut == nullptr)
  {
    return fine;
  }
  const std::vector<float> ones(slots, 1.0f);
  std::vector<float> points(slots, 0.0f);
  std::vector<float> irradiance(slots, 0.0f);
  std::array<MaskedTerms, TexelPatterns::Count> counted;
  std::array<MaskedTerms, TexelPatterns::Count> weighted;
  for (std::size_t p = 0; p < TexelPatterns::Count; ++p)
  {
    const GroupMask* exposed = cut->exposure.ofPattern(p, groups);
    counted[p] = { exposed, ones.data() };
    weighted[p] = { exposed, irradiance_.data() + p * slots };
  }
  addMasked(groups, counted.data(), counted.size(), points.data());
  addMasked(groups, weighted.data(), weighted.size(), irradiance.data());
  for (std::size_t slot = 0; slot < slots; ++slot)
  {
    fine.share[slot] = points[slot] / TexelPatterns::Count;
    if (points[slot] < TexelPatterns::Count)
    {
      fine.irradiance[slot] = points[slot] > 0 ? irradiance[slot] / points[slot] : 0.0f;
    }
  }
  return fine;
}

void SweepTextures::coarsen(const FineTexels& fine, const float* sums, const float* weight,
  float* values, float* shares) const
{
  const SweepTexels& texels = records_.texels();
  const int side = texels.resolution() / texels.refinement();
  const auto count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  std::vector<double> light(count, 0.0);
  std::vector<double> outside(count, 0.0);
  std::vector<double> area(count, 0.0);
  for (std::size_t slot = 0; slot < texels.slots(); ++slot)
  {
    const std::uint32_t texel = texels.texelOfSlot(slot);
    if (texel == SweepTexels::Empty)
    {
      continue;
    }
    const int row = static_cast<int>(texel) / texels.resolution();
    const int column = static_cast<int>(texel) % texels.resolution();
    const std::size_t target =
      texelIndex(side, row / texels.refinement(), column / texels.refinement());
    const double size = areas_[static_cast<std::size_t>(row)];
    area[target] += size;
    if (weight[slot] > 0)
    {
      const double exposed = size * static_cast<double>(fine.share[slot]);
      const float open = std::min(sums[slot] / weight[slot], 1.0f);
      light[target] += exposed * static_cast<double>(open) * fine.irradiance[slot];
      outside[target] += exposed;
    }
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    values[i] = outside[i] > 0 ? static_cast<float>(light[i] / outside[i]) : 0.0f;
    shares[i] = static_cast<float>(outside[i] / area[i]);
  }
}

void SweepTextures::fill(unsigned sphere, float* values, float* shares) const
{
  const SweepTexels& texels = records_.texels();
  const int side = texels.resolution() / texels.refinement();
  const float* sums = records_.sums(sphere);
  if (sums == nullptr && records_.cut(sphere) == nullptr)
  {
    std::fill(values, values + side * side, 0.0f);
    std::fill(shares, shares + side * side, records_.isBuried(sphere) ? 0.0f : 1.0f);
    return;
  }
  const FineTexels fine = fineTexels(sphere);
  const std::vector<float> dark(sums == nullptr ? texels.slots() : 0, 0.0f);
  coarsen(fine, sums == nullptr ? dark.data() : sums, fine.weight.data(), values, shares);
}

SweepTextures::SquaredError SweepTextures::squaredError(unsigned sphere) const
{
  const SweepTexels& texels = records_.texels();
  const int side = texels.resolution() / texels.refinement();
  const auto count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  SquaredError error;
  if (records_.sums(sphere) == nullptr && records_.cut(sphere) == nullptr)
  {
    error.area = records_.isBuried(sphere) ? 0 : 4 * Pi;
    return error;
  }
  const FineTexels fine = fineTexels(sphere);
  std::vector<float> shares(count);
  std::vector<float> values(SweepSubsets * count);
  std::vector<float> weight(texels.slots());
  for (std::size_t subset = 0; subset < SweepSubsets; ++subset)
  {
    const float* open = records_.openWeights().subsets.data() + subset * texels.slots();
    for (std::size_t slot = 0; slot < texels.slots(); ++slot)
    {
      // Of a texel that is cut, the outside part of the weights is nearly the same in all subsets.
      const float total = records_.openWeights().total[slot];
      weight[slot] = total > 0 ? open[slot] * (fine.weight[slot] / total) : 0.0f;
    }
    coarsen(fine, records_.subsetSums(sphere) + subset * texels.slots(), weight.data(),
      values.data() + subset * count, shares.data());
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const double area =
      texelArea(side, static_cast<int>(i) / side) * static_cast<double>(shares[i]);
    const std::array<double, SweepSubsets> v{ values[i], values[count + i], values[2 * count + i],
      values[3 * count + i] };
    const double mean = (v[0] + v[1] + v[2] + v[3]) / 4;
    error.area += area;
    for (const double value : v)
    {
      error.sum += area * (value - mean) * (value - mean) / (4 * 3);
    }
  }
  return error;
}
}
