// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ForEachTile_h
#define po_ForEachTile_h

#include "Camera.h"
#include "DepthSource.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace po
{
/// Calls f(tile) for all tiles of DepthTileSize pixels of a window, in parallel. Neighbouring
/// pixels of a tile mostly show the same spheres, whose data are then near at hand.
template <typename Function>
void forEachTile(int width, int height, const Function& f)
{
  const int columns = depthTiles(width), rows = depthTiles(height);
  tbb::parallel_for(tbb::blocked_range<int>(0, columns * rows),
    [&](const tbb::blocked_range<int>& tiles)
    {
      for (int tile = tiles.begin(); tile < tiles.end(); ++tile)
      {
        const int x = tile % columns * DepthTileSize, y = tile / columns * DepthTileSize;
        f(intersect({ 0, 0, width, height }, { x, y, x + DepthTileSize, y + DepthTileSize }));
      }
    });
}
}

#endif
