// SPDX-License-Identifier: BSD-3-Clause
#include "TexelExposure.h"

#include "Constants.h"
#include "TexelMask.h"

#include <cmath>

namespace po
{
namespace
{
/// A cap with what decides a whole texel: cosines of the angle between the axis and the texel's
/// centre, by row of the fine grid.
struct PreparedCap
{
  Vec3f axis;
  float cosine;
  std::vector<float> allBuried;  ///< above it the whole texel is inside the cap
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

enum class Cover
{
  None,
  Part,
  All
};

/// How much of a group of texels lies inside a cap.
Cover coverOf(const SweepTexels& texels, std::size_t group, const PreparedCap& cap)
{
  bool all = true;
  bool none = true;
  for (std::size_t slot = group * GroupSize; slot < (group + 1) * GroupSize; ++slot)
  {
    const auto row = static_cast<std::size_t>(texels.rowOf(slot));
    const float cosine = dot(texels.center(slot), cap.axis);
    all = all && cosine > cap.allBuried[row];
    none = none && cosine < cap.someBuried[row];
  }
  return all ? Cover::All : (none ? Cover::None : Cover::Part);
}

void clearGroup(TexelExposure& exposure, std::size_t group, std::size_t groups)
{
  for (std::size_t pattern = 0; pattern < TexelPatterns::Count; ++pattern)
  {
    exposure.bits[pattern * groups + group] = 0;
  }
}
}

TexelExposure exposeTexels(
  const SweepTexels& texels, const TexelPatterns& patterns, const std::vector<BuriedCap>& caps)
{
  const std::size_t groups = texels.groups();
  TexelExposure exposure{ texels.allBits() };
  for (const BuriedCap& buried : caps)
  {
    const PreparedCap cap = prepare(buried, texels.angularRadii());
    for (std::size_t group = 0; group < groups; ++group)
    {
      const Cover cover = coverOf(texels, group, cap);
      if (cover == Cover::All)
      {
        clearGroup(exposure, group, groups);
      }
      else if (cover == Cover::Part)
      {
        clearCap(patterns, group, cap.axis, cap.cosine, exposure.bits.data(), groups);
      }
    }
  }
  return exposure;
}
}
