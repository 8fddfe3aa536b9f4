// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelCaps_h
#define po_TexelCaps_h

#include "SweepTexels.h"
#include "TexelRims.h"

#include <array>
#include <cstddef>

namespace po
{
/// Tells the discs of a group that a cap covers from those of which caps may cover a part.
/// @param sines of the half angles of the caps, by place
/// @param parts by cap of the list: the discs that it may cover in part, which is not told of discs
/// that are covered
/// @return the discs that are covered as a whole
[[nodiscard]] GroupMask classifyCaps(const TexelDiscs& discs, std::size_t group,
  const CapList& caps, const float* sines, GroupMask* parts);

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
/// @param crossed those of them that are not outside as a whole
/// @param weights, irradiance [TexelPatterns::Count][GroupSize] of the points of the group; the
/// second may be null
void sumOutside(const TexelPoints& points, std::size_t group, const CapList& caps,
  GroupMask outside, GroupMask crossed, const float* weights, const float* irradiance,
  OutsideSums& sums);

/// Clears the points of a pattern that lie inside other spheres; false if none is left.
/// @param mask one for each group
bool clearInside(
  const TexelPatterns& patterns, std::size_t pattern, const TexelRims& rims, GroupMask* mask);
}

#endif
