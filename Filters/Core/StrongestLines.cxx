// SPDX-License-Identifier: BSD-3-Clause
#include "StrongestLines.h"

#include <algorithm>

// Highway compiles this file once for each instruction set and chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "StrongestLines.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#ifndef po_StrongestLines_cxx
#define po_StrongestLines_cxx
namespace po
{
/// Pixels of a row of a picture.
struct PictureRow
{
  int x, y;
  int width, height; ///< of the picture
};
}
#endif

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using IntegerTag = hn::CappedTag<std::int32_t, DepthTileSize>;
using NumberTag = hn::RebindToUnsigned<IntegerTag>;
using Tag = hn::RebindToFloat<IntegerTag>;
using Integers = hn::Vec<IntegerTag>;

inline Integers number(std::int32_t value)
{
  return hn::Set(IntegerTag(), value);
}

/// Pixels of the picture in front; beyond the picture its border is repeated.
inline Integers frontsOf(Integers codes, const PictureRow& row)
{
  const auto step = [](Integers bits)
  {
    const Integers low = hn::And(bits, number(LineCode::StepMask));
    const auto isHere = hn::Eq(low, number(LineCode::StepMask));
    return hn::IfThenZeroElse(isHere, hn::Sub(low, number(LineCode::NoStep)));
  };
  const Integers di = step(codes), dj = step(hn::ShiftRight<LineCode::StepBits>(codes));
  const auto inside = [](Integers place, int size)
  { return hn::Min(hn::Max(place, number(0)), number(size - 1)); };
  const Integers x = hn::Add(hn::Add(di, hn::Iota(IntegerTag(), 0)), number(row.x));
  const Integers y = hn::Add(dj, number(row.y));
  return hn::Add(hn::Mul(inside(y, row.height), number(row.width)), inside(x, row.width));
}

bool hasLines(const std::uint32_t* codes)
{
  const NumberTag numbers;
  auto any = hn::Zero(numbers);
  for (int i = 0; i < DepthTileSize; i += static_cast<int>(hn::Lanes(numbers)))
  {
    any = hn::Or(any, hn::LoadU(numbers, codes + i));
  }
  return !hn::AllTrue(numbers, hn::Eq(any, hn::Zero(numbers)));
}

/// Reads one row of a tile; false if it has no line.
bool readRow(const std::uint32_t* codes, const PictureRow& row, std::size_t to, TileLines& lines)
{
  const Tag d;
  const IntegerTag integers;
  const NumberTag numbers;
  if (!hasLines(codes))
  {
    return false;
  }
  for (int i = 0; i < DepthTileSize; i += static_cast<int>(hn::Lanes(d)))
  {
    const auto at = to + static_cast<std::size_t>(i);
    const auto found = hn::LoadU(numbers, codes + i);
    const auto strength = hn::ShiftRight<32 - LineCode::StrengthBits>(found);
    const auto inside = hn::And(hn::ShiftRight<LineCode::FrontBits>(found),
      hn::Set(numbers, (1U << LineCode::InsideBits) - 1));
    const auto store = [&](auto values, float scale, auto& pixels)
    {
      const auto real = hn::ConvertTo(d, hn::BitCast(integers, values));
      hn::StoreU(hn::Mul(real, hn::Set(d, 1 / scale)), d, pixels.data() + at);
    };
    store(strength, LineCode::StrengthScale, lines.strength);
    store(inside, LineCode::InsideScale, lines.inside);
    hn::StoreU(frontsOf(hn::BitCast(integers, found), { row.x + i, row.y, row.width, row.height }),
      integers, lines.front.data() + at);
  }
  return true;
}

std::uint32_t readTile(const std::uint32_t* codes, int stride, const PictureRow& first,
  std::uint32_t rows, TileLines& lines)
{
  std::uint32_t found = 0;
  for (; rows != 0; rows &= rows - 1)
  {
    const auto j = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(rows));
    const PictureRow row{ first.x, first.y + j, first.width, first.height };
    const auto to = static_cast<std::size_t>(TileLines::indexOf(0, j));
    const bool any = readRow(codes + static_cast<std::ptrdiff_t>(j) * stride, row, to, lines);
    found |= static_cast<std::uint32_t>(any) << static_cast<unsigned>(j);
  }
  return found;
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(readTile);

void StrongestLines::resize(int stride, int rows)
{
  // Parts of vectors are read behind the last row.
  const std::size_t size = static_cast<std::size_t>(stride) * rows + DepthTileSize;
  if (codes_.size() < size)
  {
    codes_.resize(size, 0);
  }
  stride_ = stride;
}

std::uint32_t StrongestLines::read(int first, int x, int y, std::uint32_t rows,
  const SilhouetteImage& picture, TileLines& lines) const
{
  if (rows == 0)
  {
    return 0; // there may be no codes at all yet
  }
  return HWY_DYNAMIC_DISPATCH(readTile)(
    codes_.data() + first, stride_, { x, y, picture.width, picture.height }, rows, lines);
}

void StrongestLines::clearRow(int row)
{
  std::fill_n(codes_.begin() + static_cast<std::ptrdiff_t>(row) * stride_, stride_, 0);
}
}
#endif
