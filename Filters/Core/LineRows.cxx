// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteTiles.h"

#include <algorithm>

// Highway compiles this file once for each instruction set and chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "LineRows.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#include "LineRows-inl.h" // after foreach_target.h

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
/// Writes one row of a tile, or what of it lies in the picture.
template <typename T>
inline void writeRow(const T* from, int count, T* to)
{
  if (count < DepthTileSize)
  {
    std::copy_n(from, count, to);
    return;
  }
  const hn::CappedTag<T, DepthTileSize> d;
  const bool isLine = isOneLine(to);
  for (int i = 0; i < DepthTileSize; i += static_cast<int>(hn::Lanes(d)))
  {
    writePart(hn::LoadU(d, from + i), d, isLine, to + i);
  }
}

/// Writes some rows of a tile to an image that may be empty.
template <typename T>
void writeRowsTo(LinePixels<T>& image, int width, int tileX, int tileY, std::uint32_t rows,
  const TileLines::Pixels<T>& from)
{
  const int x = tileX * DepthTileSize, count = std::min(DepthTileSize, width - x);
  for (; rows != 0 && !image.empty(); rows &= rows - 1)
  {
    const auto j = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(rows));
    const std::ptrdiff_t y = tileY * DepthTileSize + j;
    writeRow(from.data() + TileLines::indexOf(0, j), count, image.data() + y * width + x);
  }
}

void writeLines(
  const TileLines& lines, std::uint32_t rows, int tileX, int tileY, SilhouetteImage& image)
{
  writeRowsTo(image.strength, image.width, tileX, tileY, rows, lines.strength);
  writeRowsTo(image.front, image.width, tileX, tileY, rows, lines.front);
  writeRowsTo(image.inside, image.width, tileX, tileY, rows, lines.inside);
}

void clearLines(int tileX, int tileY, std::uint32_t rows, SilhouetteImage& image)
{
  static constexpr TileLines::Pixels<float> Nothing{};
  writeRowsTo(image.strength, image.width, tileX, tileY, rows, Nothing);
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(writeLines);
HWY_EXPORT(clearLines);

void clearStrength(int tileX, int tileY, std::uint32_t rows, SilhouetteImage& image)
{
  if (rows != 0)
  {
    HWY_DYNAMIC_DISPATCH(clearLines)(tileX, tileY, rows, image);
  }
}

void writeRows(
  const TileLines& lines, std::uint32_t rows, int tileX, int tileY, SilhouetteImage& image)
{
  std::uint16_t& had =
    image.tileRows[static_cast<std::size_t>(tileY) * depthTiles(image.width) + tileX];
  clearStrength(tileX, tileY, had & ~rows, image);
  had = static_cast<std::uint16_t>(rows);
  if (rows != 0)
  {
    HWY_DYNAMIC_DISPATCH(writeLines)(lines, rows, tileX, tileY, image);
  }
}
}
#endif
