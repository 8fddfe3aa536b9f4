// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelMask_h
#define po_TexelMask_h

#include "DepthTiles.h"
#include "OccluderList.h"
#include "OffsetMasks.h"
#include "SweepTexels.h"

#include <array>
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

/// Occluders of one receiver, in the order in which they are tested.
struct OccluderBatch
{
  static constexpr std::size_t Most = OccluderChunk::Size;
  /// Whole vectors are stored, behind the last one that counts too.
  static constexpr std::size_t Capacity = Most + 16;

  std::size_t count = 0;
  /// A point (u, v) is within the disc where 2 a u + 2 b v - (u^2 + v^2) > a^2 + b^2 - R^2: half
  /// the work of (u - a)^2 + (v - b)^2 < R^2, at the same precision.
  std::array<float, Capacity> twiceA, twiceB, height, power;

  void add(const Occluder& o)
  {
    twiceA[count] = 2 * o.a;
    twiceB[count] = 2 * o.b;
    height[count] = o.height;
    power[count] = o.a * o.a + o.b * o.b - o.squaredRadius;
    ++count;
  }
};

/// Clears the bits of the texels that occluders hide: those within the disc of one whose point lies
/// below its centre. That is exact for points outside the occluder (see SphereScene).
/// @param mask one for each group
/// @return whether any bit is left
bool hideTexels(const FacingTexels& facing, const OccluderBatch& occluders, GroupMask* mask);

/// The same where light is blocked only within `distance` (in radii of the receiver) of a texel.
bool hideTexelsWithin(
  const FacingTexels& facing, const OccluderBatch& occluders, float distance, GroupMask* mask);

/// What all listed occluders leave of a receiver. They must come before it in depth.
/// @param z of receiver and occluders grows towards the light
/// @return whether any bit is left
bool hideBehind(const FacingTexels& facing, OccluderList occluders, const ProjectedSphere& receiver,
  GroupMask* mask);

/// The same where light is blocked only within `distance`, in the units of the projection.
bool hideBehindWithin(const FacingTexels& facing, OccluderList occluders,
  const ProjectedSphere& receiver, float distance, GroupMask* mask);

/// For a row of discs of radius 1 with centres (a + k step, b), clears the texels of the facing
/// groups that lie within disc k from masks [k][OffsetMasks::Groups].
void clearDiscs(
  const FacingTexels& facing, float a, float step, int count, float b, GroupMask* masks);
}

#endif
