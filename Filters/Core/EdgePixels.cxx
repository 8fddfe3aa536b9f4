// SPDX-License-Identifier: BSD-3-Clause
#include "EdgePixels.h"

#include <algorithm>
#include <array>
#include <cstdint>

// Highway compiles this file once for each instruction set and chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "EdgePixels.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#include "LineRows-inl.h" // after foreach_target.h

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
using IntegerTag = hn::CappedTag<std::int32_t, EdgeGroup::Size>;
using Tag = hn::Rebind<float, IntegerTag>;
using Integers = hn::Vec<IntegerTag>;

static_assert(DepthTileSize % EdgeGroup::Size == 0, "groups lie in one tile each");

inline Integers number(std::int32_t value)
{
  return hn::Set(IntegerTag(), value);
}

/// Writes the edges of some tiles.
class EdgeWriter
{
public:
  EdgeWriter(const EdgeFinder& finder, const SearchedTiles& tiles, SilhouetteImage& image)
    : block_(finder.block())
    , groups_(finder.groups())
    , tiles_(tiles)
    , image_(image)
  {
  }

  void write()
  {
    clearRows();
    for (const EdgeGroup& group : groups_)
    {
      writeGroup(group);
    }
  }

private:
  /// Groups are whole rows of tiles.
  static constexpr bool IsWholeRow = hn::MaxLanes(Tag()) == DepthTileSize;

  /// Notes the rows that have lines, and clears those that had some, and those that groups are only
  /// parts of.
  void clearRows()
  {
    std::array<std::uint32_t, SearchedTiles::Most> rows{};
    for (const EdgeGroup& group : groups_)
    {
      const int column = (block_.x + group.i) / DepthTileSize - tiles_.x;
      const int row = block_.y + group.j - tiles_.y * DepthTileSize;
      rows[static_cast<std::size_t>(column)] |= 1U << static_cast<unsigned>(row);
    }
    for (int k = 0; k < tiles_.count; ++k)
    {
      const std::uint32_t found = rows[static_cast<std::size_t>(k)];
      std::uint16_t& kept = image_.tileRows[static_cast<std::size_t>(tiles_.y) *
          static_cast<std::size_t>(depthTiles(image_.width)) +
        static_cast<std::size_t>(tiles_.x + k)];
      clearStrength(tiles_.x + k, tiles_.y, IsWholeRow ? kept & ~found : kept | found, image_);
      kept = static_cast<std::uint16_t>(found);
    }
  }

  void writeGroup(const EdgeGroup& group)
  {
    const Tag d;
    const std::uint8_t bits[8] = { static_cast<std::uint8_t>(group.edges),
      static_cast<std::uint8_t>(group.edges >> 8U) };
    const auto strength = hn::IfThenElseZero(hn::LoadMaskBits(d, bits), hn::Set(d, 1.0F));
    const int x = block_.x + group.i, y = block_.y + group.j;
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(y) * image_.width + x;
    const int count = image_.width - x;
    store(strength, count, image_.strength.data() + first);
    if (!image_.front.empty())
    {
      store(frontsOf(group, x, y), count, image_.front.data() + first);
    }
  }

  /// Pixels of the picture in front. Beyond the picture its border is repeated.
  [[nodiscard]] Integers frontsOf(const EdgeGroup& group, int x, int y) const
  {
    const IntegerTag integers;
    const auto inside = [](Integers place, int size)
    { return hn::Min(hn::Max(place, number(0)), number(size - 1)); };
    const Integers front = hn::LoadU(integers, group.fronts);
    const Integers di = hn::Add(hn::And(front, number(3)), hn::Iota(integers, 0));
    const Integers column = hn::Add(di, number(x - 1));
    const Integers row = hn::Add(hn::ShiftRight<2>(front), number(y - 1));
    return hn::Add(
      hn::Mul(inside(row, image_.height), number(image_.width)), inside(column, image_.width));
  }

  /// So many numbers at most: what is behind them is another row's.
  template <typename Vector, typename T>
  static void store(Vector values, int count, T* to)
  {
    const hn::Rebind<T, Tag> d;
    if (count >= static_cast<int>(hn::Lanes(d)))
    {
      writePart(values, d, IsWholeRow && isOneLine(to), to);
      return;
    }
    T part[EdgeGroup::Size];
    hn::StoreU(values, d, part);
    std::copy_n(part, count, to);
  }

  const SampleBlock& block_;
  EdgeGroups groups_;
  const SearchedTiles& tiles_;
  SilhouetteImage& image_;
};

void writeEdgesOf(const EdgeFinder& finder, const SearchedTiles& tiles, SilhouetteImage& image)
{
  EdgeWriter(finder, tiles, image).write();
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(writeEdgesOf);

void writeEdges(const EdgeFinder& finder, const SearchedTiles& tiles, SilhouetteImage& image)
{
  HWY_DYNAMIC_DISPATCH(writeEdgesOf)(finder, tiles, image);
}
}
#endif
