// SPDX-License-Identifier: BSD-3-Clause
#include "TexelExposure.h"

#include "TexelMask.h"

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
/// A cap and the texels, [groups], of which it may cover a part.
struct RimCap
{
  const BuriedCap* cap;
  std::vector<GroupMask> part;
};

/// Sorts texels into those that a cap covers and those that its rim may cross.
std::vector<RimCap> classify(
  const SweepTexels& texels, const std::vector<BuriedCap>& caps, std::vector<GroupMask>& outside)
{
  std::vector<RimCap> rims;
  std::vector<GroupMask> covered(texels.groups());
  for (const BuriedCap& cap : caps)
  {
    rims.push_back({ &cap, std::vector<GroupMask>(texels.groups()) });
    const double sine = std::sqrt((1 - cap.cosine) * (1 + cap.cosine));
    classifyCap(texels.discs(), cap.axis.as<float>(), static_cast<float>(cap.cosine),
      static_cast<float>(sine), covered.data(), rims.back().part.data());
    for (std::size_t g = 0; g < texels.groups(); ++g)
    {
      outside[g] = static_cast<GroupMask>(outside[g] & ~covered[g]);
    }
  }
  return rims;
}

std::vector<std::uint32_t> groupsWithRim(
  const std::vector<RimCap>& rims, const std::vector<GroupMask>& outside)
{
  std::vector<std::uint32_t> groups;
  for (std::uint32_t g = 0; g < outside.size(); ++g)
  {
    if (std::any_of(
          rims.begin(), rims.end(), [&](const RimCap& r) { return (r.part[g] & outside[g]) != 0; }))
    {
      groups.push_back(g);
    }
  }
  return groups;
}
}

TexelExposure exposeTexels(
  const SweepTexels& texels, const TexelPatterns& patterns, const std::vector<BuriedCap>& caps)
{
  TexelExposure exposure;
  exposure.outside.assign(texels.allBits().begin(),
    texels.allBits().begin() + static_cast<std::ptrdiff_t>(texels.groups()));
  const std::vector<RimCap> rims = classify(texels, caps, exposure.outside);
  exposure.rimGroups = groupsWithRim(rims, exposure.outside);
  const std::size_t groups = exposure.rimGroups.size();
  exposure.rim.assign(TexelPatterns::Count * groups, AllOfGroup);
  for (const RimCap& rim : rims)
  {
    for (std::size_t i = 0; i < groups; ++i)
    {
      const std::uint32_t g = exposure.rimGroups[i];
      if ((rim.part[g] & exposure.outside[g]) != 0)
      {
        clearCap(patterns, g, rim.cap->axis.as<float>(), static_cast<float>(rim.cap->cosine),
          exposure.rim.data() + i, groups);
      }
    }
  }
  return exposure;
}
}
