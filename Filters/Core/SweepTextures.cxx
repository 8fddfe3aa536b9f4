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
namespace
{
/// The irradiance of an open surface at all points, in the order of TexelPatterns.
std::vector<float> irradianceOfPoints(
  const SweepTexels& texels, const TexelPatterns& patterns, const Background& background)
{
  const BackgroundIrradiance irradiance(background);
  std::vector<float> values(TexelPatterns::Count * texels.slots(), 0.0f);
  for (std::size_t slot = 0; slot < texels.slots(); ++slot)
  {
    for (std::size_t p = 0; p < TexelPatterns::Count; ++p)
    {
      if (texels.texelOfSlot(slot) != SweepTexels::Empty)
      {
        const Vec3d normal = normalized(patterns.normal(p, slot).as<double>());
        values[TexelPatterns::index(p, slot)] = static_cast<float>(irradiance(normal));
      }
    }
  }
  return values;
}
}

SweepTextures::SweepTextures(const VisibilityRecords& records, const Background& background)
  : records_(records)
  , uniform_(std::holds_alternative<UniformBackground>(background))
  , ones_(TexelPatterns::Count * records.texels().slots(), 1.0f)
{
  const SweepTexels& texels = records.texels();
  irradiance_ = uniform_ ? ones_ : irradianceOfPoints(texels, records.patterns(), background);
  open_ = openTexels();
  const int side = texels.resolution() / texels.refinement();
  areas_.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0f);
  for (std::size_t slot = 0; slot < texels.slots(); ++slot)
  {
    const std::uint32_t texel = texels.texelOfSlot(slot);
    if (texel != SweepTexels::Empty)
    {
      const int row = static_cast<int>(texel) / texels.resolution();
      const int column = static_cast<int>(texel) % texels.resolution();
      const int coarseRow = row / texels.refinement();
      parts_.push_back({ slot, texelIndex(side, coarseRow, column / texels.refinement()),
        static_cast<float>(texelArea(texels.resolution(), row) / texelArea(side, coarseRow)) });
      areas_[parts_.back().texel] += parts_.back().area;
    }
  }
}

SweepTextures::FineTexels SweepTextures::openTexels() const
{
  const std::size_t slots = records_.texels().slots();
  FineTexels fine{ std::vector<float>(slots), std::vector<float>(slots, 1.0f),
    records_.openWeights().total };
  for (std::size_t slot = 0; slot < slots; ++slot)
  {
    double sum = 0;
    for (std::size_t p = 0; p < TexelPatterns::Count; ++p)
    {
      sum += static_cast<double>(irradiance_[TexelPatterns::index(p, slot)]);
    }
    fine.irradiance[slot] = static_cast<float>(sum / TexelPatterns::Count);
  }
  return fine;
}

SweepTextures::FineTexels SweepTextures::cutTexels(const CutSphere& cut) const
{
  const TexelExposure& exposure = cut.exposure;
  FineTexels fine = open_;
  fine.weight = records_.outsideWeights(cut);
  for (std::size_t slot = 0; slot < fine.share.size(); ++slot)
  {
    const bool outside = (exposure.bits[slot / GroupSize] >> (slot % GroupSize) & 1) != 0;
    fine.share[slot] = outside ? 1.0f : 0.0f;
  }
  const std::size_t rimTexels = exposure.rimGroups.size() * GroupSize;
  std::vector<float> points(rimTexels, 0.0f);
  std::vector<float> irradiance(rimTexels, 0.0f);
  records_.addOverPoints(cut, ones_, points.data());
  if (!uniform_)
  {
    records_.addOverPoints(cut, irradiance_, irradiance.data());
  }
  for (std::size_t i = 0; i < rimTexels; ++i)
  {
    const std::size_t slot = exposure.rimGroups[i / GroupSize] * GroupSize + i % GroupSize;
    fine.share[slot] = points[i] / TexelPatterns::Count;
    if (!uniform_ && points[i] > 0 && points[i] < TexelPatterns::Count)
    {
      fine.irradiance[slot] = irradiance[i] / points[i];
    }
  }
  return fine;
}

void SweepTextures::coarsen(const FineTexels& fine, const float* sums, const float* weight,
  float* values, float* shares) const
{
  const int side = records_.texels().resolution() / records_.texels().refinement();
  std::fill(values, values + side * side, 0.0f);
  std::fill(shares, shares + side * side, 0.0f);
  for (const Part& part : parts_)
  {
    if (weight[part.slot] > 0)
    {
      const float exposed = part.area * fine.share[part.slot];
      const float open = std::min(sums[part.slot] / weight[part.slot], 1.0f);
      values[part.texel] += exposed * open * fine.irradiance[part.slot];
      shares[part.texel] += exposed;
    }
  }
  for (int i = 0; i < side * side; ++i)
  {
    values[i] = shares[i] > 0 ? values[i] / shares[i] : 0.0f;
    shares[i] /= areas_[static_cast<std::size_t>(i)];
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
  const CutSphere* cut = records_.cut(sphere);
  if (cut == nullptr)
  {
    coarsen(open_, sums, open_.weight.data(), values, shares);
    return;
  }
  const FineTexels fine = cutTexels(*cut);
  const std::vector<float> dark(sums == nullptr ? texels.slots() : 0, 0.0f);
  coarsen(fine, sums == nullptr ? dark.data() : sums, fine.weight.data(), values, shares);
}

void SweepTextures::SquaredError::add(const SquaredError& other)
{
  sum += other.sum;
  area += other.area;
}

double SweepTextures::SquaredError::rms() const
{
  return area > 0 ? std::sqrt(sum / area) : 0;
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
  const CutSphere* cut = records_.cut(sphere);
  const FineTexels fine = cut == nullptr ? open_ : cutTexels(*cut);
  std::vector<float> shares(count);
  std::vector<float> values(SweepSubsets * count);
  std::vector<float> weight(texels.slots());
  const float* subsetSums = records_.subsetSums(sphere);
  const std::vector<float> dark(subsetSums == nullptr ? SweepSubsets * texels.slots() : 0, 0.0f);
  const float* sums = subsetSums == nullptr ? dark.data() : subsetSums;
  for (std::size_t subset = 0; subset < SweepSubsets; ++subset)
  {
    const float* open = records_.openWeights().subsets.data() + subset * texels.slots();
    for (std::size_t slot = 0; slot < texels.slots(); ++slot)
    {
      // Of a texel that is cut, the outside part of the weights is nearly the same in all subsets.
      const float total = records_.openWeights().total[slot];
      weight[slot] = total > 0 ? open[slot] * (fine.weight[slot] / total) : 0.0f;
    }
    coarsen(fine, sums + subset * texels.slots(), weight.data(), values.data() + subset * count,
      shares.data());
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
