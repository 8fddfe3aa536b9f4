// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TileSweep_h
#define po_TileSweep_h

#include "DepthTiles.h"
#include "OccluderCells.h"
#include "TexelMask.h"
#include "VisibilityRecords.h"

#include <array>
#include <cstdint>
#include <vector>

namespace po
{
/// A direction of a sweep.
struct SweptDirection
{
  const FacingTexels& facing;
  std::size_t pattern; ///< of the points in the texels
  std::size_t index;   ///< in the block
  float distance;      ///< light is blocked within it: local, infinite when unbounded
};

/// Finds what of a tile's receivers is seen along a direction, from the light downward.
///
/// A sphere starts with the texels that face the light; each occluder met before clears those that
/// lie behind it. A sphere that shows no texel is no occluder: what it hides is hidden by those in
/// front of it, up to slivers that no point of its texels lies in. Where the distance is bounded
/// that does not hold, and all spheres occlude.
class TileSweep
{
public:
  explicit TileSweep(VisibilityRecords& records)
    : records_(records)
  {
  }

  /// @param reach the largest radius of a receiver
  /// @param hidden flags by sphere: set for receivers that show no texel
  void run(const DepthTile& tile, float reach, const SweptDirection& direction,
    std::vector<std::uint8_t>& hidden);

private:
  bool sees(const TileSphere& sphere, const SweptDirection& direction);
  /// Clears what the occluders hide of a receiver; false if nothing is left of it.
  bool passes(const std::vector<OccluderCells::Entry>& occluders, const ProjectedSphere& receiver,
    const SweptDirection& direction);

  /// The same for occluders whose squared distance across, in that of a touch, is in [nearest,
  /// farthest).
  bool passes(const std::vector<OccluderCells::Entry>& occluders, const ProjectedSphere& receiver,
    const SweptDirection& direction, float nearest, float farthest);

  VisibilityRecords& records_;
  OccluderCells cells_;
  std::vector<std::uint64_t> keys_;
  std::vector<std::uint32_t> order_;
  std::vector<GroupMask> mask_;
};
}

#endif
