// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ClosedCells_h
#define po_ClosedCells_h

#include "DepthTiles.h"

#include <vector>

namespace po
{
/// The cells of ClosedCells, row after row.
struct CellGrid
{
  std::vector<float> height; ///< below it a cell is closed; -infinity in an open one. Vectors may
                             ///< reach beyond the last
  int side = 0;              ///< cells along each side
  int inner = 0;             ///< cells of the margin that no receiver reaches
};

/// Small square cells of a tile that one occluder covers wholly: whatever lies below its centre
/// there is hidden. Tells spheres that are buried under others by a few loads.
///
/// Occluders must come from the light downward; heights grow towards the light.
class ClosedCells
{
public:
  /// Opens all cells and lays them over a tile.
  /// @param reach the largest radius of a receiver
  void begin(const DepthTile& tile, float reach);

  void close(const ProjectedSphere& occluder);

  /// All of the sphere's texels are hidden; false if that cannot be told so simply.
  [[nodiscard]] bool hides(const ProjectedSphere& sphere) const;

  /// No receiver of the tile whose centre is at `z` or below shows anything.
  [[nodiscard]] bool hidesAllBelow(float z) const { return open_ == 0 && z + reach_ <= lowest_; }

private:
  CellGrid cells_;
  float lowX_ = 0, lowY_ = 0, perCell_ = 1, reach_ = 0;
  float lowest_ = 0; ///< height of the latest cell that was closed, of those that receivers reach
  int open_ = 0;     ///< open cells that receivers reach
};
}

#endif
