// SPDX-License-Identifier: BSD-3-Clause
#include "TexelExposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace po
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr std::uint64_t AllPatterns = ~std::uint64_t(0);
static_assert(TexelPatterns::Count == 64, "one bit for each pattern");

/// A cap with what decides a whole texel: cosines of the angle between the axis and the texel's
/// centre, by row of the fine grid.
struct PreparedCap
{
  Vec3f axis;
  float cosine;
  std::vector<float> allBuried; ///< above it the whole texel is inside the cap
  std::vector<float> someBuried; ///< at or above it a part is
};

PreparedCap prepare(const BuriedCap& cap, const std::vector<double>& texelRadii)
{
  PreparedCap prepared{ cap.axis.as<float>(), static_cast<float>(cap.cosine), {}, {} };
  const double halfAngle = std::acos(cap.cosine);
  for (const double radius : texelRadii)
  {
    // A little wider than the texel: rounding may then cost time, but never a wrong answer.
    const double reach = radius + 1e-5;
    prepared.allBuried.push_back(
      halfAngle > reach ? static_cast<float>(std::cos(halfAngle - reach)) : 2.0f);
    prepared.someBuried.push_back(
      halfAngle + reach < Pi ? static_cast<float>(std::cos(halfAngle + reach)) : -2.0f);
  }
  return prepared;
}

/// The patterns whose point of a slot lies inside the cap.
std::uint64_t buriedPatterns(const TexelPatterns& patterns, std::size_t slot, const PreparedCap& cap)
{
  std::uint64_t buried = 0;
  for (std::size_t p = 0; p < TexelPatterns::Count; ++p)
  {
    const bool inside = dot(patterns.normal(p, slot), cap.axis) > cap.cosine;
    buried |= std::uint64_t(inside) << p;
  }
  return buried;
}

/// The patterns whose point of a slot is outside all caps.
std::uint64_t exposedPatterns(const SweepTexels& texels, const TexelPatterns& patterns,
  std::size_t slot, const std::vector<PreparedCap>& caps)
{
  if (texels.texelOfSlot(slot) == SweepTexels::Empty)
  {
    return 0;
  }
  const Vec3f center = texels.center(slot);
  const auto row = static_cast<std::size_t>(texels.rowOf(slot));
  std::uint64_t exposed = AllPatterns;
  for (const PreparedCap& cap : caps)
  {
    const float cosine = dot(center, cap.axis);
    if (cosine > cap.allBuried[row])
    {
      return 0;
    }
    if (cosine >= cap.someBuried[row])
    {
      exposed &= ~buriedPatterns(patterns, slot, cap);
    }
  }
  return exposed;
}

/// Sets the bits of a slot in all patterns.
void setExposed(TexelExposure& exposure, std::size_t groups, std::size_t slot, std::uint64_t exposed)
{
  for (std::size_t p = 0; p < TexelPatterns::Count; ++p)
  {
    GroupMask& mask = exposure.bits[p * groups + slot / GroupSize];
    mask = static_cast<GroupMask>(
      mask | static_cast<unsigned>((exposed >> p) & 1) << (slot % GroupSize));
  }
}
}

TexelExposure exposeTexels(
  const SweepTexels& texels, const TexelPatterns& patterns, const std::vector<BuriedCap>& caps)
{
  std::vector<PreparedCap> prepared;
  std::transform(caps.begin(), caps.end(), std::back_inserter(prepared),
    [&](const BuriedCap& cap) { return prepare(cap, texels.angularRadii()); });
  TexelExposure exposure;
  const std::size_t groups = texels.groups();
  exposure.bits.assign(TexelPatterns::Count * groups, 0);
  bool everywhereOpen = true;
  for (std::size_t group = 0; group < groups; ++group)
  {
    std::array<std::uint64_t, GroupSize> exposed{};
    bool allOpen = true;
    for (std::size_t lane = 0; lane < GroupSize; ++lane)
    {
      exposed[lane] = exposedPatterns(texels, patterns, group * GroupSize + lane, prepared);
      allOpen = allOpen && exposed[lane] == AllPatterns;
      everywhereOpen = everywhereOpen &&
        (exposed[lane] == AllPatterns || texels.texelOfSlot(group * GroupSize + lane) == SweepTexels::Empty);
    }
    for (std::size_t p = 0; p < TexelPatterns::Count && allOpen; ++p)
    {
      exposure.bits[p * groups + group] = AllOfGroup;
    }
    for (std::size_t lane = 0; lane < GroupSize && !allOpen; ++lane)
    {
      setExposed(exposure, groups, group * GroupSize + lane, exposed[lane]);
    }
  }
  if (everywhereOpen)
  {
    exposure.bits.clear();
    exposure.bits.shrink_to_fit();
  }
  return exposure;
}
}
