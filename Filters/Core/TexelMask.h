// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelMask_h
#define po_TexelMask_h

#include "SweepTexels.h"

#include <cstddef>

namespace po
{
/// A sphere in front of a receiver, seen along the direction of the light. Lengths are in radii of
/// the receiver, relative to its centre.
struct Occluder
{
  float a, b;   ///< centre across
  float height; ///< centre towards the light, at least 0
  float squaredRadius;
};

/// Clears the bits of the texels that an occluder hides: those within its disc whose point lies
/// below its centre. That is exact for points outside the occluder (see SphereScene).
/// @param mask one for each group of `facing`
/// @return whether any bit is left
bool hideTexels(const FacingTexels& facing, const Occluder& occluder, GroupMask* mask);

/// The same where light is blocked only within `distance` (in radii of the receiver) of a texel.
bool hideTexelsWithin(
  const FacingTexels& facing, const Occluder& occluder, float distance, GroupMask* mask);

/// Adds the weights of the texels that are set to their sums.
/// @param sums one for each slot
void addWeights(const FacingTexels& facing, const GroupMask* mask, float* sums);

/// Clears the bits of the points of one group that lie inside a cap of the unit sphere: those with
/// normal . axis > cosine.
/// @param bits [TexelPatterns::Count][groups]
void clearCap(const TexelPatterns& patterns, std::size_t group, Vec3f axis, float cosine,
  GroupMask* bits, std::size_t groups);

/// Adds the terms of the slots that are set to their sums; all arrays cover all groups.
void addMasked(std::size_t groups, const GroupMask* mask, const float* terms, float* sums);
}

#endif
