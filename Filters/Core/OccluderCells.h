// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OccluderCells_h
#define po_OccluderCells_h

#include "DepthTiles.h"
#include "OccluderList.h"

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
  /// Empties the cells and lays them over a tile.
  /// @param band of the receivers
  void begin(const DepthTile& tile, const SweepScene::Band& band);

  /// Occluders come from the light downward.
  void insert(const ProjectedSphere& sphere);

  [[nodiscard]] OccluderList cellOf(const ProjectedSphere& receiver) const
  {
    return { chunks_.data(),
      heads_[cellAt(cellIndex(receiver.y - lowY_), cellIndex(receiver.x - lowX_))] };
  }
  [[nodiscard]] OccluderList wide() const { return { chunks_.data(), wide_ }; }

private:
  [[nodiscard]] int cellIndex(float offset) const;
  [[nodiscard]] std::size_t cellAt(int row, int column) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) +
      static_cast<std::size_t>(column);
  }
  void append(int& head, const ProjectedSphere& sphere);

  std::vector<OccluderChunk> chunks_;
  std::size_t used_ = 0;   ///< chunks in use
  std::vector<int> heads_; ///< by cell
  int wide_ = OccluderList::Empty;
  float lowX_ = 0, lowY_ = 0, cell_ = 1, perCell_ = 1, reach_ = 0;
  int side_ = 0; ///< cells along each side
};
}

#endif
