// SPDX-License-Identifier: BSD-3-Clause
#include "TexelExposure.h"

#include "MaskedSums.h"
#include "TexelCaps.h"

#include <algorithm>

namespace po
{
void exposeTexels(const SweepTexels& texels, const TexelPatterns& patterns, const TexelRims& rims,
  TexelExposure& result)
{
  const std::size_t groups = texels.groups();
  result.bits.resize(TexelPatterns::Count * groups);
  for (std::size_t p = 0; p < TexelPatterns::Count; ++p)
  {
    std::copy_n(rims.outside, groups, result.bits.data() + p * groups);
  }
  result.rimGroups.clear();
  for (std::size_t rim = 0; rim < rims.count; ++rim)
  {
    const std::uint32_t g = rims.rims[rim].group;
    result.rimGroups.push_back(g);
    clearCaps(patterns, g, rims.capsOf(rim), result.bits.data() + g, groups);
  }
}

bool facingOutside(const FacingTexels& facing, const TexelExposure& exposure, std::size_t pattern,
  std::vector<GroupMask>& mask)
{
  mask = facing.facing;
  if (!exposure.bits.empty())
  {
    return intersect(mask.size(), exposure.ofPattern(pattern, mask.size()), mask.data());
  }
  return !facing.facingGroups.empty();
}
}
