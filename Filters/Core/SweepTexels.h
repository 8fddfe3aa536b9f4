// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SweepTexels_h
#define po_SweepTexels_h

#include "BakeSettings.h"
#include "SweepDirections.h"
#include "Vec3.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace po
{
/// Texels are handled in groups of this many, a bit each in a GroupMask.
inline constexpr std::size_t GroupSize = 16;
using GroupMask = std::uint16_t;
inline constexpr GroupMask AllOfGroup = 0xFFFF;

/// A group is a square of texels, row by row.
inline constexpr std::size_t PatchSide = 4;
static_assert(PatchSide * PatchSide == GroupSize);

/// Points that every texel has, one for each sweep direction in turn.
inline constexpr std::size_t PointsPerTexel = 32;

/// Discs on the unit sphere: their centres, 0 in empty slots, and their angular radii. There are a
/// whole number of groups of them.
struct TexelDiscs
{
  std::vector<float> x, y, z;
  std::vector<float> cosRadius, sinRadius;

  void add(Vec3d center, double radius);
  void addEmpty() { add({}, 0); }
};

/// The texels that a sweep follows, and where in them it looks.
///
/// The grid is that of the texture, or a whole multiple of it where the texture has fewer than 12
/// rows: a handful of points would not do to tell hidden spheres. Patches of 4 x 4 texels make a
/// group, since neighbours on the sphere face a direction, and are hidden, together. A texel's
/// place in this order is its slot; patches that jut out of the grid leave empty slots.
class SweepTexels
{
public:
  static constexpr std::uint32_t Empty = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t MostSlots = static_cast<std::size_t>(
    BakeSettings::MaximumTextureResolution * BakeSettings::MaximumTextureResolution);

  explicit SweepTexels(int textureResolution);

  /// Rows and columns of the fine grid: refinement() times the texture's.
  [[nodiscard]] int resolution() const { return resolution_; }
  [[nodiscard]] int refinement() const { return refinement_; }
  [[nodiscard]] std::size_t groups() const { return texelOfSlot_.size() / GroupSize; }
  [[nodiscard]] std::size_t slots() const { return texelOfSlot_.size(); }

  /// Row-major index of a slot's texel in the fine grid, or Empty.
  [[nodiscard]] std::uint32_t texelOfSlot(std::size_t slot) const { return texelOfSlot_[slot]; }

  /// Discs around the texels of all slots: each holds its texel.
  [[nodiscard]] const TexelDiscs& discs() const { return discs_; }
  /// Discs around the groups: each holds the discs of its texels.
  [[nodiscard]] const TexelDiscs& groupDiscs() const { return groupDiscs_; }

  /// A bit for each slot that is not empty, [groups].
  [[nodiscard]] const std::vector<GroupMask>& allBits() const { return allBits_; }

private:
  void addGroupDiscs();

  int refinement_;
  int resolution_;
  std::vector<std::uint32_t> texelOfSlot_;
  TexelDiscs discs_;
  TexelDiscs groupDiscs_;
  std::vector<GroupMask> allBits_;
};

/// Points on the texels: each texel has PointsPerTexel of them, spread evenly over its area.
/// Pattern p, the p-th point of every texel, serves a sweep direction.
struct TexelPatterns
{
  static constexpr std::size_t Count = PointsPerTexel;

  /// @param epoch patterns of different epochs interleave: together they are well spread too
  TexelPatterns(const SweepTexels& texels, std::uint64_t seed, std::uint32_t epoch);

  /// The unit normals [groups][Count][GroupSize], 0 in empty slots.
  std::vector<float> x, y, z;

  [[nodiscard]] std::size_t groups() const { return x.size() / (Count * GroupSize); }
  [[nodiscard]] static constexpr std::size_t index(std::size_t pattern, std::size_t slot)
  {
    return (slot / GroupSize * Count + pattern) * GroupSize + slot % GroupSize;
  }
  [[nodiscard]] Vec3f normal(std::size_t pattern, std::size_t slot) const
  {
    const std::size_t i = index(pattern, slot);
    return { x[i], y[i], z[i] };
  }
};

/// The same points texel by texel, [slots][TexelPatterns::Count].
struct TexelPoints
{
  explicit TexelPoints(const TexelPatterns& patterns);

  std::vector<float> x, y, z;
};

/// Patterns take turns in an order that is drawn anew each time: the heights of the directions
/// follow powers of two, as does the number of patterns, and a fixed order would show each pattern
/// a part of the sky only.
class PatternTurns
{
public:
  [[nodiscard]] std::size_t next();

private:
  std::vector<std::uint32_t> order_; ///< those to come
  std::uint64_t rounds_ = 0;
};

/// The texels whose points face a direction, in the frame of the projection: u and v across, w
/// towards the light. Masks have one entry for each group, arrays one for each slot.
struct FacingTexels
{
  /// @param basis of the projection across; it may serve the opposite direction too
  FacingTexels(const SweepTexels& texels, const TexelPatterns& patterns, std::size_t pattern,
    const PlaneBasis& basis, Vec3d direction);

  [[nodiscard]] std::size_t groups() const { return facing.size(); }

  std::vector<std::uint32_t> facingGroups; ///< those with a facing texel
  std::vector<GroupMask> facing;           ///< the texels with w > 0
  std::vector<float> u, v, w;
};
}

#endif
