// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SharedTiles_h
#define po_SharedTiles_h

// Tiles of traced frames on their way from the process that traced them to another one. Not depths
// travel but which sphere each pixel shows: depths follow from the spheres, in double precision.

#include "ProcessGroup.h"
#include "TracedDepth.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// Appends tiles of a layer: its placement, the spheres that are seen, and for each tile runs of
/// pixels that show the same sphere.
/// @param tiles numbers of tiles of DepthTileSize pixels, row by row from the lower left corner
/// @param process that has the layer
void appendTiles(
  const TracedLayer& layer, const std::vector<int>& tiles, int process, ProcessGroup::Words& words);

/// One tile of one layer, where it has arrived. Refers to the words.
struct SharedTile
{
  int tile;
  std::size_t layer;            ///< of SharedTiles
  std::size_t sphereCount;      ///< at most the pixels of a tile
  const std::uint32_t* spheres; ///< numbers in SharedTiles::spheres, less the layer's first
  const std::uint8_t* runs;     ///< pairs: which of `spheres`, and the number of pixels less one

  /// Stands for no sphere, unless there are so many.
  static constexpr std::uint8_t NoSphere = 255;

  [[nodiscard]] bool showsSphere(std::uint8_t value) const
  {
    return value != NoSphere || sphereCount > NoSphere;
  }
};

/// All that has arrived, in the order in which it was sent.
struct SharedTiles
{
  std::vector<Matrix4> localToWorld;      ///< of each layer
  std::vector<std::uint32_t> firstSphere; ///< of each layer
  std::vector<int> processes;             ///< of each layer
  std::vector<Sphere> spheres;            ///< in the coordinates of their layer
  std::vector<SharedTile> tiles;
};

/// @param words what several appendTiles() made; must live as long as the result
[[nodiscard]] SharedTiles readTiles(const ProcessGroup::Words& words);
}

#endif
