// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelCaps_h
#define po_TexelCaps_h

#include "SweepTexels.h"

#include <cstddef>

namespace po
{
/// Tells the texels of which a cap of the unit sphere, normal . axis > cosine, covers all from
/// those of which it may cover a part.
/// @param sine of the cap's half angle
/// @param covered, part one mask for each group
void classifyCap(const TexelDiscs& discs, Vec3f axis, float cosine, float sine, GroupMask* covered,
  GroupMask* part);

/// A cap of the unit sphere: normal . axis > cosine.
struct RimCap
{
  Vec3f axis;
  float cosine;
};

/// Clears the bits of the points of one group that lie inside any of some caps.
/// @param bits of the first pattern; those of the next are `stride` further
void clearCaps(const TexelPatterns& patterns, std::size_t group, const RimCap* caps,
  std::size_t count, GroupMask* bits, std::size_t stride);
}

#endif
