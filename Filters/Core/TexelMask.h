// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelMask_h
#define po_TexelMask_h

#include "DepthTiles.h"
#include "OccluderList.h"
#include "OffsetMasks.h"
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
/// @param mask one for each group
/// @return whether any bit is left
bool hideTexels(const FacingTexels& facing, const Occluder& occluder, GroupMask* mask);

/// The same where light is blocked only within `distance` (in radii of the receiver) of a texel.
bool hideTexelsWithin(
  const FacingTexels& facing, const Occluder& occluder, float distance, GroupMask* mask);

/// What all listed occluders leave of a receiver. They must come before it in depth.
/// @param z of receiver and occluders grows towards the light
/// @return whether any bit is left
bool hideBehind(const FacingTexels& facing, OccluderList occluders, const ProjectedSphere& receiver,
  GroupMask* mask);

/// The same where light is blocked only within `distance`, in the units of the projection.
bool hideBehindWithin(const FacingTexels& facing, OccluderList occluders,
  const ProjectedSphere& receiver, float distance, GroupMask* mask);

/// The same for occluders of the size of the receiver: pairs that do not overlap are looked up.
/// @param mask [OffsetMasks::Groups], those beyond the groups of `facing` unused
bool hideBehindEqual(const FacingTexels& facing, const OffsetMasks& masks, OccluderList occluders,
  const ProjectedSphere& receiver, GroupMask* mask);

/// Clears the bits that are not set in the other mask too; false if none is left.
bool intersect(std::size_t groups, const GroupMask* other, GroupMask* mask);

/// For a row of discs of radius 1 with centres (a + k step, b), clears the texels of the facing
/// groups that lie within disc k from masks [k][OffsetMasks::Groups].
void clearDiscs(
  const FacingTexels& facing, float a, float step, int count, float b, GroupMask* masks);

/// Tells the texels of which a cap of the unit sphere, normal . axis > cosine, covers all from
/// those of which it may cover a part.
/// @param sine of the cap's half angle
/// @param covered, part one mask for each group
void classifyCap(const TexelDiscs& discs, Vec3f axis, float cosine, float sine, GroupMask* covered,
  GroupMask* part);

/// Clears the bits of the points of one group that lie inside a cap of the unit sphere: those with
/// normal . axis > cosine.
/// @param bits of the first pattern; those of the next are `stride` further
void clearCap(const TexelPatterns& patterns, std::size_t group, Vec3f axis, float cosine,
  GroupMask* bits, std::size_t stride);

/// Adds the terms of the slots that are set to their sums; all arrays cover all groups.
void addMasked(std::size_t groups, const GroupMask* mask, const float* terms, float* sums);

/// Terms and the mask of the slots that they count for.
struct MaskedTerms
{
  const GroupMask* mask;
  const float* terms;
};

/// Adds, for one group, the terms [PointsPerTexel][GroupSize] of the points that are set.
/// @param mask of the first pattern; those of the next are `stride` further
void addOverPoints(const GroupMask* mask, std::size_t stride, const float* terms, float* sums);

/// Adds several, in their order, at one reading of the sums.
void addMasked(std::size_t groups, const MaskedTerms* list, std::size_t count, float* sums);
}

#endif
