// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_DepthOrder_h
#define po_DepthOrder_h

#include "DepthTiles.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace po
{
/// The spheres of a tile in the order of their depth, from either end.
///
/// They are dealt into slabs of equal depth, and a slab is sorted when it is first asked for, once
/// for both directions.
class DepthOrder
{
public:
  void begin(const DepthTile& tile);

  [[nodiscard]] std::size_t slabs() const { return starts_.size() - 1; }

  /// A slab's spheres, sorted by z upward and then by place in the tile. Slabs are numbered upward
  /// too.
  struct Slab
  {
    const TileSphere* first;
    const TileSphere* last;
  };
  [[nodiscard]] Slab slab(std::size_t index);

private:
  void sort(std::size_t slab);

  const TileSphere* spheres_ = nullptr;
  std::vector<TileSphere> ordered_; ///< of the slabs that are sorted
  std::vector<std::uint64_t> keys_; ///< height above, place in the tile below
  std::vector<std::uint32_t> slabOf_;
  std::vector<std::uint32_t> starts_{ 0 };
  std::vector<std::uint32_t> next_;
  std::vector<std::uint8_t> sorted_;
};
}

#endif
