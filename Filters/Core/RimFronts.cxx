// SPDX-License-Identifier: BSD-3-Clause
#include "RimFronts.h"

#include "SilhouetteEdges.h"

#include <algorithm>
#include <limits>

// Highway compiles this file once for each instruction set and chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "RimFronts.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 8>;
using IntegerTag = hn::RebindToSigned<Tag>;
using Integers = hn::Vec<IntegerTag>;
using Lanes = hn::Mask<Tag>;

inline Integers number(std::int32_t value)
{
  return hn::Set(IntegerTag(), value);
}

/// Finds the pixels in front of lines.
class FrontFinder
{
public:
  FrontFinder(const RimTile& tile, int reach, RimLines& painted)
    : tile_(tile)
    , reach_(reach)
    , painted_(painted)
  {
  }

  std::uint32_t find()
  {
    std::uint32_t rows = 0;
    for (int j = 0; j < tile_.rows; ++j)
    {
      bool any = false;
      for (int i = 0; i < tile_.columns; i += static_cast<int>(hn::Lanes(Tag())))
      {
        any |= findSome(i, j);
      }
      rows |= static_cast<std::uint32_t>(any) << static_cast<unsigned>(j);
    }
    return rows;
  }

private:
  /// Of pixels side by side; false if there is no line.
  bool findSome(int i, int j)
  {
    const Tag d;
    const IntegerTag integers;
    const auto at = static_cast<std::size_t>(TileLines::indexOf(i, j));
    const Lanes isLine = hn::Gt(hn::LoadU(d, painted_.lines.strength.data() + at), hn::Zero(d));
    if (hn::AllFalse(d, isLine))
    {
      return false;
    }
    const Integers steps = hn::IfThenElse(hn::RebindMask(integers, isLine),
      hn::LoadU(integers, painted_.steps.data() + at), number(RimLines::NoStep));
    const Integers di = hn::Sub(hn::And(steps, number(RimLines::Row - 1)), number(RimLines::Most));
    const Integers dj = hn::Sub(hn::ShiftRight<RimLines::RowBits>(steps), number(RimLines::Most));
    const Integers x = hn::Add(di, hn::Add(hn::Iota(integers, 0), number(i))),
                   y = hn::Add(dj, number(j));
    hn::StoreU(pixelOf(x, y), integers, painted_.lines.front.data() + at);
    // Where there is no line, any pixel of the block.
    const Integers row = hn::Add(hn::Mul(y, number(tile_.pitch)), number(tile_.first));
    const Integers place = hn::IfThenElseZero(hn::RebindMask(integers, isLine), hn::Add(row, x));
    const auto* shown = reinterpret_cast<const std::int32_t*>(tile_.shown);
    const Integers front = hn::GatherIndex(integers, shown, place);
    const auto* wanted = reinterpret_cast<const std::int32_t*>(painted_.shown.data());
    const auto isFound = hn::Eq(front, hn::LoadU(integers, wanted + at));
    const Lanes isOpen = hn::AndNot(hn::RebindMask(d, isFound), isLine);
    if (!hn::AllFalse(d, isOpen))
    {
      findAround(i, j, isOpen);
    }
    return true;
  }

  /// Pixel of the picture at (i, j) of the tile; beyond the picture its border is repeated.
  [[nodiscard]] Integers pixelOf(Integers i, Integers j) const
  {
    const auto inside = [](Integers place, int first, int size)
    { return hn::Min(hn::Max(hn::Add(place, number(first)), number(0)), number(size - 1)); };
    const Integers x = inside(i, tile_.x, tile_.width), y = inside(j, tile_.y, tile_.height);
    return hn::Add(hn::Mul(y, number(tile_.width)), x);
  }

  void findAround(int i, int j, Lanes which)
  {
    std::uint8_t bits[8] = {}; // Highway may write that many
    hn::StoreMaskBits(Tag(), which, bits);
    for (std::uint32_t left = bits[0]; left != 0; left &= left - 1)
    {
      findAround(i + static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(left)), j);
    }
  }

  /// The nearest pixel that an edge around has in front.
  void findAround(int i, int j)
  {
    const auto pixel = static_cast<std::size_t>(TileLines::indexOf(i, j));
    const std::uint32_t sphere = painted_.shown[pixel];
    float nearest = std::numeric_limits<float>::infinity();
    for (int y = j - reach_; y <= j + reach_; ++y)
    {
      for (int x = i - reach_; x <= i + reach_; ++x)
      {
        const int edge = tile_.first + y * tile_.pitch + x;
        if (tile_.fronts[edge] == sphere)
        {
          const int frontX = x + columnsToFront(tile_.toFront[edge]);
          const int frontY = y + rowsToFront(tile_.toFront[edge]);
          const float depth = tile_.depth[tile_.first + frontY * tile_.pitch + frontX];
          if (depth < nearest)
          {
            nearest = depth;
            const int column = std::clamp(tile_.x + frontX, 0, tile_.width - 1);
            const int row = std::clamp(tile_.y + frontY, 0, tile_.height - 1);
            painted_.lines.front[pixel] = row * tile_.width + column;
          }
        }
      }
    }
  }

  const RimTile& tile_;
  int reach_;
  RimLines& painted_;
};

std::uint32_t findFronts(const RimTile& tile, int reach, RimLines& painted)
{
  return FrontFinder(tile, reach, painted).find();
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(findFronts);

std::uint32_t setFronts(const RimTile& tile, int reach, RimLines& painted)
{
  return HWY_DYNAMIC_DISPATCH(findFronts)(tile, reach, painted);
}
}
#endif
