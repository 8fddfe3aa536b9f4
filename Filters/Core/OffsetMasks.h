// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OffsetMasks_h
#define po_OffsetMasks_h

#include "SweepTexels.h"

#include <vector>

namespace po
{
/// What a sphere in front leaves of a sphere of the same size.
///
/// Of two such spheres that do not overlap the one whose centre is higher is the higher one along
/// every line that meets both, so what is hidden depends on the offset across alone. Where they
/// overlap, points above the centre of the one in front stay open: they lie inside it, or before
/// it. Offsets are rounded to 1/16 of the radius; the grid is shifted at random from direction to
/// direction, so that the roundings of a pair of spheres average out.
class OffsetMasks
{
public:
  static constexpr float CellsPerRadius = 16;
  static constexpr int Side = 4 * 16 + 2; ///< offsets from -2 to 2 radii and one cell for the shift
  static constexpr int Levels = 2 * 16 + 2; ///< heights from 0 to 2 radii likewise

  /// Groups of a mask. With more the masks of all offsets would not stay in the cache.
  static constexpr std::size_t Groups = 16;
  [[nodiscard]] static bool fits(const SweepTexels& texels) { return texels.groups() <= Groups; }

  /// @param shiftX, shiftY, shiftZ of the grid in cells, 0 to 1
  void build(const FacingTexels& facing, float shiftX, float shiftY, float shiftZ);

  /// Column (row, level) of an offset in radii is the whole part of offset * CellsPerRadius +
  /// origin.
  [[nodiscard]] float originX() const { return originX_; }
  [[nodiscard]] float originY() const { return originY_; }
  [[nodiscard]] float originZ() const { return originZ_; }

  /// The masks [Groups] of the texels that stay open; those beyond the groups of the texels unused.
  [[nodiscard]] const GroupMask* at(int column, int row) const
  {
    return masks_.data() + static_cast<std::size_t>(row * Side + column) * Groups;
  }

  /// The masks [Groups] of the texels above the centre of one that overlaps.
  [[nodiscard]] const GroupMask* above(int level) const
  {
    return above_.data() + static_cast<std::size_t>(level) * Groups;
  }

private:
  void buildAbove(const FacingTexels& facing);

  std::vector<GroupMask> masks_;
  std::vector<GroupMask> above_;
  float originX_ = 0, originY_ = 0, originZ_ = 0;
};
}

#endif
