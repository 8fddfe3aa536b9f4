// SPDX-License-Identifier: BSD-3-Clause
#include "SweepTextures.h"

#include "Constants.h"
#include "MaskedSums.h"

#include <hwy/cache_control.h>

#include <utility>

namespace po
{
SweepTextures::SweepTextures(
  const VisibilityRecords& records, const Background& background, TextureSmoothing smoothing)
  : records_(records)
  , formula_(records.texels(), records.patterns(), background)
  , smoothing_(std::move(smoothing))
{
}

void SweepTextures::fill(unsigned sphere, float* values, float* shares) const
{
  const float* sums = records_.sums(sphere);
  const TexelRims* rims = records_.rims(sphere);
  if (sums == nullptr)
  {
    formula_.fill(0, records_.isBuried(sphere) ? 0.0f : 1.0f, values, shares);
    return;
  }
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

void SweepTextures::prefetch(unsigned sphere) const
{
  constexpr std::size_t perLine = 16; // floats
  const float* sums = records_.sums(sphere);
  for (std::size_t slot = 0; sums != nullptr && slot < records_.texels().slots(); slot += perLine)
  {
    hwy::Prefetch(sums + slot);
  }
}

/// Points of past epochs count by their weights, the present ones for the surface too.
void SweepTextures::lookAt(const TexelRims& known, CutSurface& cut) const
{
  // One that was not seen, but is watched.
  const TexelRims rims = known.areToldApart() ? known : cut.finder.find(records_.texels(), known);
  cut.rims.assign(rims.count * GroupSize, 0.0f);
  for (const SweepEpoch& epoch : records_.epochs())
  {
    exposeTexels(records_.texels(), epoch.patterns, rims, cut.exposure);
    for (std::size_t rim = 0; rim < rims.count; ++rim)
    {
      const std::size_t group = rims.rims[rim].group;
      addOverPoints(cut.exposure.bits.data() + group, records_.texels().groups(),
        epoch.weights.data() + TexelPatterns::index(0, group * GroupSize),
        cut.rims.data() + rim * GroupSize);
    }
  }
  formula_.cut(cut.exposure, cut.surface);
  weigh(rims, cut);
}

void SweepTextures::weigh(const TexelRims& rims, CutSurface& cut) const
{
  const std::vector<float>& open = records_.openWeights().total;
  cut.weights.assign(open.size(), 0.0f);
  addMasked(records_.texels().groups(), rims.outside, open.data(), cut.weights.data());
  for (std::size_t i = 0; i < cut.rims.size(); ++i)
  {
    const std::size_t slot = rims.rims[i / GroupSize].group * GroupSize + i % GroupSize;
    // A texel that no rim crosses: the same sum in another order. Keep the one that the sums are
    // compared with, so that an open texel is exactly 1.
    const bool whole = cut.rims[i] > open[slot] * (1 - 1e-4f);
    cut.weights[slot] = whole ? open[slot] : cut.rims[i];
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
