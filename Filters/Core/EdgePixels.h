// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_EdgePixels_h
#define po_EdgePixels_h

#include "SilhouetteEdges.h"
#include "SilhouetteTiles.h"

#include <cstdint>

namespace po
{
/// Sets the lines of a tile where they are the edges themselves: strength 1 at all of them, and the
/// pixels of the picture in front.
///
/// @param width, height of the picture
/// @return the rows that have lines, one bit each
std::uint32_t setEdgePixels(
  const EdgeFinder& finder, const SearchedTile& tile, int width, int height, TileLines& lines);
}

#endif
