// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RimFronts_h
#define po_RimFronts_h

#include "RimShares.h"

namespace po
{
/// Sets TileLines::front of the lines of a tile.
///
/// @param reach pixels beyond an edge that its line can cover
/// @return the rows that have lines, one bit each
std::uint32_t setFronts(const RimTile& tile, int reach, RimLines& painted);
}

#endif
