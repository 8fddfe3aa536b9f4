// SPDX-License-Identifier: BSD-3-Clause
// How rows of tiles are written, for sources that Highway compiles once for each instruction set:
// included by each of them anew, hence no plain include guard.
#if defined(po_LineRows_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef po_LineRows_inl_h
#undef po_LineRows_inl_h
#else
#define po_LineRows_inl_h
#endif

#include "DepthSource.h"

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

/// Does memory for a row of a tile, DepthTileSize numbers of four bytes, lie in one cache line?
inline bool isOneLine(const void* row)
{
  static_assert(DepthTileSize * sizeof(float) == 64);
  return reinterpret_cast<std::uintptr_t>(row) % 64 == 0;
}

/// Writes part of a row. What is one cache line goes past the caches, since nothing of what was
/// there is needed: to read it first takes as long as to find the line. All of the row must be
/// written so, one part after the other, and hwy::FlushStream() called in the end.
template <typename Tag, typename Vector>
inline void writePart(Vector values, Tag d, bool isLine, hn::TFromD<Tag>* to)
{
  if (isLine)
  {
    hn::Stream(values, d, to);
  }
  else
  {
    hn::StoreU(values, d, to);
  }
}
}
HWY_AFTER_NAMESPACE();

#endif
