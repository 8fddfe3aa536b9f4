// SPDX-License-Identifier: BSD-3-Clause
#include "TexelExposure.h"

#include "TexelMap.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace po
{
namespace
{
constexpr std::uint64_t AllPatterns = ~std::uint64_t(0);
static_assert(TexelPatterns::Count == 64, "one bit for each pattern");

/// A cap with what is compared for a whole texel.
struct PreparedCap
{
  Vec3d axis;
  double cosine;
  double halfAngle;
};

/// The patterns whose point of a slot lies inside the cap.
std::uint64_t buriedPatterns(const TexelPatterns& patterns, std::size_t slot, const PreparedCap& cap)
{
  std::uint64_t buried = 0;
  for (std::size_t p = 0; p < TexelPatterns::Count; ++p)
  {
    const bool inside = dot(patterns.normal(p, slot).as<double>(), cap.axis) > cap.cosine;
    buried |= std::uint64_t(inside) << p;
  }
  return buried;
}

/// The patterns whose point of a slot is outside all caps.
std::uint64_t exposedPatterns(const SweepTexels& texels, const TexelPatterns& patterns,
  std::size_t slot, const std::vector<PreparedCap>& caps, const std::vector<double>& radii)
{
  const std::uint32_t texel = texels.texelOfSlot(slot);
  if (texel == SweepTexels::Empty)
  {
    return 0;
  }
  const auto columns = static_cast<std::uint32_t>(texels.resolution());
  const std::uint32_t row = texel / columns;
  const std::uint32_t column = texel % columns;
  const Vec3d center =
    textureDirection({ (column + 0.5) / texels.resolution(), (row + 0.5) / texels.resolution() });
  const double reach = radii[row];
  std::uint64_t exposed = AllPatterns;
  for (const PreparedCap& cap : caps)
  {
    const double angle = std::acos(std::clamp(dot(center, cap.axis), -1.0, 1.0));
    if (angle + reach < cap.halfAngle)
    {
      return 0;
    }
    if (angle - reach <= cap.halfAngle)
    {
      exposed &= ~buriedPatterns(patterns, slot, cap);
    }
  }
  return exposed;
}
}

TexelExposure exposeTexels(
  const SweepTexels& texels, const TexelPatterns& patterns, const std::vector<BuriedCap>& caps)
{
  std::vector<PreparedCap> prepared;
  std::transform(caps.begin(), caps.end(), std::back_inserter(prepared),
    [](const BuriedCap& cap) {
      return PreparedCap{ cap.axis, cap.cosine, std::acos(cap.cosine) };
    });
  std::vector<double> radii;
  for (int row = 0; row < texels.resolution(); ++row)
  {
    // A little wider than the texel: rounding may then cost time, but never a wrong answer.
    radii.push_back(texelAngularRadius(texels.resolution(), row) + 1e-6);
  }
  TexelExposure exposure;
  const std::size_t groups = texels.groups();
  exposure.bits.assign(TexelPatterns::Count * groups, 0);
  for (std::size_t slot = 0; slot < texels.slots(); ++slot)
  {
    const std::uint64_t exposed = exposedPatterns(texels, patterns, slot, prepared, radii);
    const std::size_t lane = slot % GroupSize;
    for (std::size_t p = 0; p < TexelPatterns::Count && exposed != 0; ++p)
    {
      const unsigned bit = static_cast<unsigned>((exposed >> p) & 1) << lane;
      GroupMask& mask = exposure.bits[p * groups + slot / GroupSize];
      mask = static_cast<GroupMask>(mask | bit);
    }
  }
  return exposure;
}
}
