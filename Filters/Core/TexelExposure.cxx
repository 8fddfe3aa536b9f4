// SPDX-License-Identifier: BSD-3-Clause
#include "TexelExposure.h"

#include "MaskedSums.h"
#include "TexelCaps.h"

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
/// Takes texels that a cap covers from `outside` and returns, [caps][groups], those of which it may
/// cover a part.
std::vector<GroupMask> classify(
  const SweepTexels& texels, const std::vector<BuriedCap>& caps, std::vector<GroupMask>& outside)
{
  const std::size_t groups = texels.groups();
  std::vector<GroupMask> parts(caps.size() * groups);
  std::vector<GroupMask> covered(groups);
  for (std::size_t i = 0; i < caps.size(); ++i)
  {
    const double sine = std::sqrt((1 - caps[i].cosine) * (1 + caps[i].cosine));
    classifyCap(texels.discs(), caps[i].axis.as<float>(), static_cast<float>(caps[i].cosine),
      static_cast<float>(sine), covered.data(), parts.data() + i * groups);
    for (std::size_t g = 0; g < groups; ++g)
    {
      outside[g] = static_cast<GroupMask>(outside[g] & ~covered[g]);
    }
  }
  return parts;
}

std::vector<std::uint32_t> groupsWithRim(
  const std::vector<GroupMask>& parts, const std::vector<GroupMask>& outside)
{
  std::vector<GroupMask> rim(outside.size(), 0);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    GroupMask& mask = rim[i % outside.size()];
    mask = static_cast<GroupMask>(mask | parts[i]);
  }
  std::vector<std::uint32_t> groups;
  for (std::uint32_t g = 0; g < outside.size(); ++g)
  {
    if ((rim[g] & outside[g]) != 0)
    {
      groups.push_back(g);
    }
  }
  return groups;
}
}

void exposeTexels(const SweepTexels& texels, const TexelPatterns& patterns,
  const std::vector<BuriedCap>& caps, TexelExposure& result)
{
  const std::size_t groups = texels.groups();
  std::vector<GroupMask> outside = texels.allBits();
  const std::vector<GroupMask> parts = classify(texels, caps, outside);
  result.rimGroups = groupsWithRim(parts, outside);
  result.bits.resize(TexelPatterns::Count * groups);
  for (std::size_t p = 0; p < TexelPatterns::Count; ++p)
  {
    std::copy(outside.begin(), outside.end(), result.bits.data() + p * groups);
  }
  std::vector<RimCap> rims;
  for (const std::uint32_t g : result.rimGroups)
  {
    rims.clear();
    for (std::size_t i = 0; i < caps.size(); ++i)
    {
      if ((parts[i * groups + g] & outside[g]) != 0)
      {
        rims.push_back({ caps[i].axis.as<float>(), static_cast<float>(caps[i].cosine) });
      }
    }
    clearCaps(patterns, g, rims.data(), rims.size(), result.bits.data() + g, groups);
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
