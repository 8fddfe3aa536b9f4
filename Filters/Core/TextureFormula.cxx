// SPDX-License-Identifier: BSD-3-Clause
#include "TextureFormula.h"

#include "MaskedSums.h"
#include "TexelMap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace po
{
namespace
{
/// The mean of the subsets' values and its squared standard error.
struct Spread
{
  double mean;
  double squaredError;
};

template <typename Value>
Spread spreadOf(const Value& valueOfSubset)
{
  double mean = 0;
  for (std::size_t subset = 0; subset < ErrorSubsets; ++subset)
  {
    mean += static_cast<double>(valueOfSubset(subset)) / ErrorSubsets;
  }
  double squares = 0;
  for (std::size_t subset = 0; subset < ErrorSubsets; ++subset)
  {
    const double deviation = static_cast<double>(valueOfSubset(subset)) - mean;
    squares += deviation * deviation;
  }
  return { mean, squares / (ErrorSubsets * (ErrorSubsets - 1)) };
}
}

void SquaredError::add(const SquaredError& other)
{
  sum += other.sum;
  area += other.area;
}

double SquaredError::rms() const
{
  return area > 0 ? std::sqrt(sum / area) : 0;
}

TextureFormula::TextureFormula(
  const SweepTexels& texels, const TexelPatterns& patterns, const Background& background)
  : groups_(texels.groups())
  , isWhole_(texels.refinement() == 1)
  , uniform_(std::holds_alternative<UniformBackground>(background))
  , ones_(TexelPatterns::Count * GroupSize, 1.0f)
  , whole_{ std::vector<float>(texels.slots(), 1.0f), std::vector<float>(texels.slots(), 1.0f) }
  , fine_(texels)
{
  addParts(texels);
  if (!uniform_)
  {
    addIrradiance(texels, patterns, background);
  }
}

void TextureFormula::addParts(const SweepTexels& texels)
{
  const int side = texels.resolution() / texels.refinement();
  areas_.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0f);
  steradians_.resize(areas_.size());
  for (std::size_t slot = 0; slot < texels.slots(); ++slot)
  {
    const std::uint32_t texel = texels.texelOfSlot(slot);
    if (texel != SweepTexels::Empty)
    {
      const int row = static_cast<int>(texel) / texels.resolution();
      const int column = static_cast<int>(texel) % texels.resolution();
      const int coarseRow = row / texels.refinement();
      const double whole = texelArea(side, coarseRow);
      parts_.push_back({ slot, texelIndex(side, coarseRow, column / texels.refinement()),
        static_cast<float>(texelArea(texels.resolution(), row) / whole) });
      areas_[parts_.back().texel] += parts_.back().area;
      steradians_[parts_.back().texel] = whole;
    }
  }
}

void TextureFormula::addIrradiance(
  const SweepTexels& texels, const TexelPatterns& patterns, const Background& background)
{
  const BackgroundIrradiance irradiance(background);
  irradiance_.assign(TexelPatterns::Count * texels.slots(), 0.0f);
  for (const Part& part : parts_)
  {
    double sum = 0;
    for (std::size_t p = 0; p < TexelPatterns::Count; ++p)
    {
      const Vec3d normal = normalized(patterns.normal(p, part.slot).as<double>());
      const auto value = static_cast<float>(irradiance(normal));
      irradiance_[TexelPatterns::index(p, part.slot)] = value;
      sum += static_cast<double>(value);
    }
    whole_.irradiance[part.slot] = static_cast<float>(sum / TexelPatterns::Count);
  }
}

void TextureFormula::cut(const TexelExposure& exposure, OutsideSurface& surface) const
{
  cutWhole(exposure.ofPattern(0, groups_), surface);
  for (const std::uint32_t group : exposure.rimGroups)
  {
    const GroupMask* exposed = exposure.bits.data() + group;
    std::array<float, GroupSize> points{};
    std::array<float, GroupSize> irradiance{};
    addOverPoints(exposed, groups_, ones_.data(), points.data());
    if (!uniform_)
    {
      addOverPoints(exposed, groups_, irradianceOf(group), irradiance.data());
    }
    cutGroup(group, points.data(), irradiance.data(), surface);
  }
}

void TextureFormula::cutWhole(const GroupMask* outside, OutsideSurface& surface) const
{
  surface.irradiance = whole_.irradiance;
  surface.shares.assign(whole_.shares.size(), 0.0f);
  addMasked(groups_, outside, whole_.shares.data(), surface.shares.data());
}

void TextureFormula::cutGroup(
  std::size_t group, const float* points, const float* irradiance, OutsideSurface& surface) const
{
  for (std::size_t i = 0; i < GroupSize; ++i)
  {
    const std::size_t slot = group * GroupSize + i;
    surface.shares[slot] = points[i] / TexelPatterns::Count;
    if (!uniform_ && points[i] > 0 && points[i] < TexelPatterns::Count)
    {
      surface.irradiance[slot] = irradiance[i] / points[i];
    }
  }
}

void TextureFormula::fill(const OutsideSurface& surface, const float* sums, const float* weights,
  float* values, float* shares) const
{
  if (isWhole_)
  {
    fine_.fill({ surface.shares.data(), surface.irradiance.data(), sums, weights }, values, shares);
    return;
  }
  fill(0, 0, values, shares);
  for (const Part& part : parts_)
  {
    if (weights[part.slot] > 0)
    {
      const float exposed = part.area * surface.shares[part.slot];
      const float open = std::min(sums[part.slot] / weights[part.slot], 1.0f);
      values[part.texel] += exposed * open * surface.irradiance[part.slot];
      shares[part.texel] += exposed;
    }
  }
  for (std::size_t i = 0; i < texels(); ++i)
  {
    values[i] = shares[i] > 0 ? values[i] / shares[i] : 0.0f;
    shares[i] /= areas_[i];
  }
}

void TextureFormula::fill(float value, float share, float* values, float* shares) const
{
  std::fill(values, values + texels(), value);
  std::fill(shares, shares + texels(), share);
}

SquaredError TextureFormula::squaredError(const OutsideSurface& surface, const float* sums,
  const float* weights, const TextureSmoothing& smoothing) const
{
  const std::size_t slots = groups_ * GroupSize;
  const std::size_t count = texels();
  std::vector<float> shares(count);
  std::vector<float> rough(ErrorSubsets * count);
  for (std::size_t subset = 0; subset < ErrorSubsets; ++subset)
  {
    fill(surface, sums + subset * slots, weights + subset * slots, rough.data() + subset * count,
      shares.data());
  }
  std::vector<float> smooth = rough;
  for (std::size_t subset = 0; subset < ErrorSubsets; ++subset)
  {
    smoothing.apply(smooth.data() + subset * count, shares.data());
  }
  SquaredError error;
  double blur = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double area = steradians_[i] * static_cast<double>(shares[i]);
    const Spread smoothed = spreadOf([&](std::size_t k) { return smooth[k * count + i]; });
    const Spread change =
      spreadOf([&](std::size_t k) { return smooth[k * count + i] - rough[k * count + i]; });
    error.area += area;
    error.sum += area * smoothed.squaredError;
    blur += area * (change.mean * change.mean - change.squaredError);
  }
  error.sum += std::max(blur, 0.0);
  return error;
}
}
