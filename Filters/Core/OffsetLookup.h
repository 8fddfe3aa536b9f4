// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OffsetLookup_h
#define po_OffsetLookup_h

#include "DepthTiles.h"
#include "OccluderList.h"
#include "OffsetMasks.h"

namespace po
{
/// What all listed occluders leave of a receiver of their size, by looking up what each leaves (see
/// hideBehind(), which tests texels in place).
/// @param mask [OffsetMasks::Groups], those beyond the groups of the texels unused
/// @return whether any bit is left
bool hideBehindEqual(const OffsetMasks& masks, OccluderList occluders,
  const ProjectedSphere& receiver, GroupMask* mask);
}

#endif
