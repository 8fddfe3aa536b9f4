// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TileSweep_h
#define po_TileSweep_h

#include "DepthOrder.h"
#include "DepthTiles.h"
#include "OccluderCells.h"
#include "OffsetMasks.h"
#include "SweepDivision.h"
#include "TexelMask.h"
#include "TileFiller.h"
#include "VisibilityRecords.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace po
{
/// One of the two opposite directions that share a projection.
struct SweptDirection
{
  FacingTexels facing;
  double luminance;               ///< of the background
  const OffsetMasks* offsetMasks; ///< null where pairs of equal spheres are not looked up
  std::size_t pattern;            ///< of the points in the texels
  std::size_t axis;               ///< in the block
  float distance;                 ///< light is blocked within it: local, infinite when unbounded
  bool upward;                    ///< the light comes from where z grows
  bool full;                      ///< all spheres take part, not only those ever seen

  /// Of this direction in marks by sphere.
  [[nodiscard]] std::uint8_t bit() const { return upward ? Upward : Downward; }
};

/// Finds what of a tile's receivers is seen along a direction, from the light downward.
///
/// A sphere starts with the texels that face the light; each occluder met before clears those that
/// lie behind it. A receiver that shows no texel is no occluder: what it hides is hidden by those
/// in front of it, up to slivers that no point of its texels lies in. One that shows points inside
/// others alone is an occluder: it stops light that came through such slivers. Where the distance
/// is bounded all spheres occlude, and so do those around the tile: to find out what shows of them
/// would cost more than it spares.
class TileSweep
{
public:
  /// @param division null where nobody else takes part
  TileSweep(VisibilityRecords& records, SweepDivision* division)
    : records_(records)
    , division_(division)
    , mask_(std::max(OffsetMasks::Groups, records.texels().groups()), 0)
  {
  }

  /// @param order of the tile's spheres
  /// @param band of the tile's receivers; those before it were swept already
  /// @param seen receivers that show a texel are marked
  void run(const DepthTile& tile, DepthOrder& order, const SweepScene::Band& band,
    const SweptDirection& direction, SeenMarks& seen);

  /// Spheres that were looked at.
  /// @param full in directions in which all spheres took part, or in the others
  [[nodiscard]] std::uint64_t visits(bool full) const { return visits_[full ? 1 : 0]; }

private:
  /// What a direction sees of a receiver.
  enum class Sight
  {
    Nothing,
    Occluder, ///< points inside others alone
    Surface
  };

  void listVisited(DepthOrder& order, const SweptDirection& direction);
  void visit(const TileSphere& sphere, const SweptDirection& direction, SeenMarks& seen);
  [[nodiscard]] Sight look(const ProjectedSphere& sphere, const SweptDirection& direction);
  void keep(unsigned sphere, const SweptDirection& direction);
  [[nodiscard]] bool passes(
    OccluderList occluders, const ProjectedSphere& receiver, const SweptDirection& direction);

  VisibilityRecords& records_;
  SweepDivision* division_;
  OccluderCells cells_;
  SweepScene::Band band_{};
  std::vector<const TileSphere*> visited_; ///< in the direction at hand
  std::vector<GroupMask> mask_;            ///< of the sphere at hand
  std::array<std::uint64_t, 2> visits_{};
};
}

#endif
