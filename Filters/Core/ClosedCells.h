// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ClosedCells_h
#define po_ClosedCells_h

#include "BlockProjection.h"
#include "DepthTiles.h"

#include <vector>

namespace po
{
/// The cells of ClosedCells, seen from one end of the axis, row after row: heights, -infinity where
/// there is none.
struct CellHeights
{
  std::vector<float> closed; ///< below it a cell is closed
  std::vector<float> around; ///< see ClosedCells::finish()
};

/// Where the cells lie. Vectors may reach beyond the last one.
struct CellGrid
{
  float lowX = 0, lowY = 0, cell = 1, perCell = 1;
  int columns = 0, rows = 0;
};

/// A bit for each sphere of a block: what is hidden when the light comes from where z grows, and
/// when it comes from the other side.
struct HiddenSpheres
{
  BlockBits upward = 0, downward = 0;
};

/// Small square cells of a patch of the projection that one sphere covers wholly: whatever lies
/// behind its centre there is hidden. Tells spheres that are buried under others by one load,
/// before anything else is done with them. Both ends of the axis are treated at once.
class ClosedCells
{
public:
  static constexpr int CellsPerReach = 4;

  /// Opens all cells and lays them over a patch.
  /// @param reach the radius of the largest receiver
  void begin(const PatchArea& area, float reach);

  /// Closes what spheres cover, in any order.
  void close(const ProjectedBlock& spheres);

  /// To be called when all are closed, before hidden().
  void finish();

  /// Receivers of which all points are hidden; not all of those, see finish().
  [[nodiscard]] HiddenSpheres hidden(const ProjectedBlock& spheres) const;

private:
  CellGrid grid_;
  float reach_ = 0;
  CellHeights up_, down_;
  std::vector<float> alongRows_;
};
}

#endif
