// SPDX-License-Identifier: BSD-3-Clause
#include "SweepTextures.h"

#include "Constants.h"

#include <utility>

namespace po
{
SweepTextures::SweepTextures(
  const VisibilityRecords& records, const Background& background, TextureSmoothing smoothing)
  : records_(records)
  , formula_(records.texels(), records.patterns(), background)
  , smoothing_(std::move(smoothing))
  , dark_(ErrorSubsets * records.texels().slots(), 0.0f)
{
}

void SweepTextures::fill(unsigned sphere, float* values, float* shares) const
{
  const float* seen = records_.sums(sphere);
  const CutSphere* cut = records_.cut(sphere);
  if (seen == nullptr && cut == nullptr)
  {
    formula_.fill(0, records_.isBuried(sphere) ? 0.0f : 1.0f, values, shares);
    return;
  }
  const float* sums = seen == nullptr ? dark_.data() : seen;
  if (cut == nullptr)
  {
    formula_.fill(formula_.whole(), sums, records_.openWeights().total.data(), values, shares);
  }
  else
  {
    const std::vector<float> weights = records_.outsideWeights(*cut);
    formula_.fill(formula_.cut(cut->exposure), sums, weights.data(), values, shares);
  }
  smoothing_.apply(values, shares);
}

SquaredError SweepTextures::squaredError(unsigned sphere) const
{
  const float* seen = records_.subsetSums(sphere);
  const CutSphere* cut = records_.cut(sphere);
  if (seen == nullptr && cut == nullptr)
  {
    return { 0, records_.isBuried(sphere) ? 0 : 4 * Pi };
  }
  const float* sums = seen == nullptr ? dark_.data() : seen;
  if (cut == nullptr)
  {
    return formula_.squaredError(
      formula_.whole(), sums, records_.openWeights().subsets.data(), smoothing_);
  }
  return formula_.squaredError(
    formula_.cut(cut->exposure), sums, subsetWeights(*cut).data(), smoothing_);
}

/// The outside part of a texel's weights is nearly the same in all subsets; what it is in each is
/// not kept.
std::vector<float> SweepTextures::subsetWeights(const CutSphere& cut) const
{
  const OpenWeights& open = records_.openWeights();
  const std::vector<float> outside = records_.outsideWeights(cut);
  std::vector<float> weights = open.subsets;
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    const std::size_t slot = i % outside.size();
    weights[i] *= open.total[slot] > 0 ? outside[slot] / open.total[slot] : 0.0f;
  }
  return weights;
}
}
