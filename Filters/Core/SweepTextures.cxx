// SPDX-License-Identifier: BSD-3-Clause
#include "SweepTextures.h"

#include "Constants.h"
#include "MaskedSums.h"
#include "TexelCaps.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace po
{
SweepTextures::SweepTextures(
  const VisibilityRecords& records, const Background& background, TextureSmoothing smoothing)
  : records_(records)
  , formula_(records.texels(), records.patterns(), background)
  , smoothing_(std::move(smoothing))
{
  for (const SweepEpoch& epoch : records.epochs())
  {
    points_.emplace_back(epoch.patterns);
  }
}

void SweepTextures::fill(unsigned sphere, float* values, float* shares) const
{
  const float* sums = records_.sums(sphere);
  if (sums == nullptr)
  {
    formula_.fill(0, isDark(sphere) ? 1.0f : 0.0f, values, shares);
    return;
  }
  const TexelRims* rims = records_.rims(sphere);
  if (rims == nullptr)
  {
    formula_.fill(formula_.whole(), sums, records_.openWeights().total.data(), values, shares);
  }
  else
  {
    thread_local CutSurface cut;
    lookAt(*rims, cut);
    formula_.fill(cut.surface, sums, cut.weights.data(), values, shares);
  }
  smoothing_.apply(values, shares);
}

void SweepTextures::lookAt(const TexelRims& rims, CutSurface& cut) const
{
  cut.rims.assign(rims.count * GroupSize, 0.0f);
  formula_.cutWhole(rims.outside, cut.surface);
  for (std::size_t rim = 0; rim < rims.count; ++rim)
  {
    lookAtRim(rims, rim, cut);
  }
  weigh(rims, cut);
}

/// Points of past epochs count by their weights, the present ones for the surface too.
void SweepTextures::lookAtRim(const TexelRims& rims, std::size_t rim, CutSurface& cut) const
{
  const std::size_t group = rims.rims[rim].group;
  const std::size_t first = TexelPatterns::index(0, group * GroupSize);
  for (std::size_t i = 0; i < points_.size(); ++i)
  {
    const SweepEpoch& epoch = records_.epochs()[i];
    const bool isPresent = &epoch.patterns == &records_.patterns();
    OutsideSums sums;
    sumOutside(points_[i], group, rims.capsOf(rim), rims.outside[group], rims.rims[rim].crossed,
      epoch.weights.data() + first, isPresent ? formula_.irradianceOf(group) : nullptr, sums);
    std::transform(sums.weights.begin(), sums.weights.end(), cut.rims.data() + rim * GroupSize,
      cut.rims.data() + rim * GroupSize, std::plus<>());
    if (isPresent)
    {
      formula_.cutGroup(group, sums.points.data(), sums.irradiance.data(), cut.surface);
    }
  }
}

void SweepTextures::weigh(const TexelRims& rims, CutSurface& cut) const
{
  const std::vector<float>& open = records_.openWeights().total;
  cut.weights.assign(open.size(), 0.0f);
  addMasked(records_.texels().groups(), rims.outside, open.data(), cut.weights.data());
  for (std::size_t rim = 0; rim < rims.count; ++rim)
  {
    const float* sums = cut.rims.data() + rim * GroupSize;
    const float* most = open.data() + rims.rims[rim].group * GroupSize;
    float* weights = cut.weights.data() + rims.rims[rim].group * GroupSize;
    for (std::size_t i = 0; i < GroupSize; ++i)
    {
      // A texel that no rim crosses: the same sum in another order. Keep the one that the sums are
      // compared with, so that an open texel is exactly 1.
      const bool whole = sums[i] > most[i] * (1 - 1e-4f);
      weights[i] = whole ? most[i] : sums[i];
    }
  }
}

SquaredError SweepTextures::squaredError(unsigned sphere) const
{
  const float* seen = records_.subsetSums(sphere);
  const TexelRims* rims = records_.rims(sphere);
  if (seen == nullptr && rims == nullptr)
  {
    return { 0, records_.isBuried(sphere) ? 0 : 4 * Pi };
  }
  const std::vector<float> dark(
    seen == nullptr ? ErrorSubsets * records_.texels().slots() : 0, 0.0f);
  const float* sums = seen == nullptr ? dark.data() : seen;
  if (rims == nullptr)
  {
    return formula_.squaredError(
      formula_.whole(), sums, records_.openWeights().subsets.data(), smoothing_);
  }
  CutSurface cut;
  lookAt(*rims, cut);
  return formula_.squaredError(cut.surface, sums, subsetWeights(cut).data(), smoothing_);
}

/// The outside part of a texel's weights is nearly the same in all subsets; what it is in each is
/// not kept.
std::vector<float> SweepTextures::subsetWeights(const CutSurface& cut) const
{
  const OpenWeights& open = records_.openWeights();
  std::vector<float> weights = open.subsets;
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    const std::size_t slot = i % cut.weights.size();
    weights[i] *= open.total[slot] > 0 ? cut.weights[slot] / open.total[slot] : 0.0f;
  }
  return weights;
}
}
