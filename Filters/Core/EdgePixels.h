// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_EdgePixels_h
#define po_EdgePixels_h

#include "SilhouetteEdges.h"
#include "SilhouetteTiles.h"

namespace po
{
/// Writes the lines of some tiles where they are the edges themselves: strength 1 at all of them,
/// and the pixels of the picture in front; and clears rows that had lines.
void writeEdges(const EdgeFinder& finder, const SearchedTiles& tiles, SilhouetteImage& image);
}

#endif
