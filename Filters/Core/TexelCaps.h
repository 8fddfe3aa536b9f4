// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelCaps_h
#define po_TexelCaps_h

#include "SweepTexels.h"
#include "TexelRims.h"

#include <array>
#include <cstddef>

namespace po
{
/// Tells the texels of which a cap of the unit sphere, normal . axis > cosine, covers all from
/// those of which it may cover a part.
/// @param sine of the cap's half angle
/// @param covered, part one mask for each group
void classifyCap(const TexelDiscs& discs, Vec3f axis, float cosine, float sine, GroupMask* covered,
  GroupMask* part);

/// Clears the bits of the points of one group that lie inside any of some caps.
/// @param bits of the first pattern; those of the next are `stride` further
void clearCaps(const TexelPatterns& patterns, std::size_t group, const CapList& caps,
  GroupMask* bits, std::size_t stride);

/// Over the points of each texel of a group that lie outside all caps.
struct OutsideSums
{
  std::array<float, GroupSize> points;     ///< how many there are
  std::array<float, GroupSize> weights;    ///< sums
  std::array<float, GroupSize> irradiance; ///< sums, where asked for
};

/// Sums over the points of one group, of all patterns.
/// @param outside the texels that count; others have none
/// @param weights, irradiance [TexelPatterns::Count][GroupSize] of the points of the group; the
/// second may be null
void sumOutside(const TexelPatterns& patterns, std::size_t group, const CapList& caps,
  GroupMask outside, const float* weights, const float* irradiance, OutsideSums& sums);

/// Clears the points of a pattern that lie inside other spheres; false if none is left.
/// @param mask one for each group
bool clearInside(
  const TexelPatterns& patterns, std::size_t pattern, const TexelRims& rims, GroupMask* mask);
}

#endif
