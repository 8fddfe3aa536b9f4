// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OccluderCells_h
#define po_OccluderCells_h

#include "DepthTiles.h"

#include <vector>

namespace po
{
/// The occluders that a tile's receivers have met so far, listed by cells of the projection.
///
/// A cell lists every occluder that may overlap a receiver whose centre lies in the cell, so that a
/// receiver looks into one cell only; occluders much wider than a cell have a list of their own,
/// which every receiver looks into.
class OccluderCells
{
public:
  struct Entry
  {
    float x, y, z, radius;
  };

  /// Empties the cells and lays them over a tile.
  /// @param reach the largest radius of a receiver
  void begin(const DepthTile& tile, float reach);

  /// Occluders come from the light downward.
  void insert(const ProjectedSphere& sphere);

  [[nodiscard]] const std::vector<Entry>& cellOf(const ProjectedSphere& receiver) const
  {
    return cells_[static_cast<std::size_t>(
      cellIndex(receiver.y - lowY_) * side_ + cellIndex(receiver.x - lowX_))];
  }
  [[nodiscard]] const std::vector<Entry>& wide() const { return wide_; }

private:
  [[nodiscard]] int cellIndex(float offset) const;

  std::vector<std::vector<Entry>> cells_;
  std::vector<Entry> wide_;
  float lowX_ = 0, lowY_ = 0, cell_ = 1, reach_ = 0;
  int side_ = 0; ///< cells along each side
};
}

#endif
