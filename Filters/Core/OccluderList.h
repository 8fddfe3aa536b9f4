// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OccluderList_h
#define po_OccluderList_h

#include "SweepTexels.h"

#include <array>
#include <cstddef>

namespace po
{
/// Up to 16 projected occluders, in the layout of vector instructions. Unused places hold spheres
/// at infinity, which hide nothing.
struct OccluderChunk
{
  static constexpr std::size_t Size = 16;

  std::array<float, Size> x, y, z, radius;
  unsigned count;
  int next; ///< chunk of earlier ones, or OccluderList::Empty
};

/// A linked list of chunks; the latest occluder, the nearest in depth, is in the first of them.
struct OccluderList
{
  static constexpr int Empty = -1;

  const OccluderChunk* chunks;
  int first;
};
}

#endif
