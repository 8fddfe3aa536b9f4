// SPDX-License-Identifier: BSD-3-Clause
#include "TexelSums.h"

#include "MaskedSums.h"

#include <utility>

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
  , subsets(spread ? ErrorSubsets * slots : 0, 0.0f)
{
}

void TexelSums::makeCut(OutsideSurface surface)
{
  outside = std::move(surface);
  weights.assign(slots, 0.0f);
  subsetWeights.assign(subsets.size(), 0.0f);
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

void fillTexture(const TextureFormula& formula, const TexelSums& sums, const OpenSums& open,
  float* values, float* shares)
{
  if (sums.buried)
  {
    formula.fill(0, 0, values, shares);
    return;
  }
  const std::vector<float>& weights = sums.isCut() ? sums.weights : open.total;
  formula.fill(sums.isCut() ? sums.outside : formula.whole(), sums.sums.data(), weights.data(),
    values, shares);
}

SquaredError squaredError(const TextureFormula& formula, const TexelSums& sums,
  const OpenSums& open, const TextureSmoothing& smoothing)
{
  if (sums.buried)
  {
    return {};
  }
  const std::vector<float>& weights = sums.isCut() ? sums.subsetWeights : open.subsets;
  return formula.squaredError(
    sums.isCut() ? sums.outside : formula.whole(), sums.subsets.data(), weights.data(), smoothing);
}
}
