// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouettePixels.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

// Highway compiles this file once for each instruction set and chooses when it runs. There are no
// fused multiply-adds: the bits are the same.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "SilhouettePixels.cxx"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#ifndef po_SilhouettePixels_cxx
#define po_SilhouettePixels_cxx
namespace po
{
/// What lines are coloured with, and where to.
struct Coloring
{
  const SilhouetteImage& lines;
  const SilhouetteStyle& style;
  const SilhouetteSurroundings& surroundings;
  SilhouettePixels& pixels;
};
}
#endif

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 8>;
using IntegerTag = hn::RebindToSigned<Tag>;
using Floats = hn::Vec<Tag>;
using Integers = hn::Vec<IntegerTag>;
using Lanes = hn::Mask<Tag>;

inline Floats number(float value)
{
  return hn::Set(Tag(), value);
}

/// From 0 to 1 to a byte.
inline Integers toByte(Floats value)
{
  const Floats inside = hn::Min(hn::Max(value, number(0)), number(1));
  return hn::ConvertTo(IntegerTag(), hn::Add(hn::Mul(number(255), inside), number(0.5F)));
}

constexpr int MostLanes = 8;

// Beyond the end of a row are pixels of others, which other threads may write.
template <typename T>
inline auto load(const T* from, int count)
{
  const hn::Rebind<T, Tag> d;
  if (count == static_cast<int>(hn::Lanes(d)))
  {
    return hn::LoadU(d, from);
  }
  T part[MostLanes] = {};
  std::copy(from, from + count, part);
  return hn::LoadU(d, part);
}

template <typename Vector, typename T>
inline void store(Vector values, T* to, int count)
{
  const hn::Rebind<T, Tag> d;
  if (count == static_cast<int>(hn::Lanes(d)))
  {
    hn::StoreU(values, d, to);
    return;
  }
  T part[MostLanes];
  hn::StoreU(values, d, part);
  std::copy(part, part + count, to);
}

class Colorer
{
public:
  explicit Colorer(const Coloring& all)
    : lines_(all.lines)
    , style_(all.style)
    , surroundings_(all.surroundings)
    , pixels_(all.pixels)
  {
  }

  /// @param rows of the tile that are to be written, one bit each
  void colorTile(int tileX, int tileY, std::uint32_t rows) const
  {
    const int x = tileX * DepthTileSize, y = tileY * DepthTileSize;
    const int columns = std::min(DepthTileSize, lines_.width - x);
    const int lanes = static_cast<int>(hn::Lanes(Tag()));
    fetchRows(x, y, rows);
    for (; rows != 0; rows &= rows - 1)
    {
      const auto j = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(rows));
      const std::size_t first = static_cast<std::size_t>(y + j) * lines_.width + x;
      for (int i = 0; i < columns; i += lanes)
      {
        colorPixels(first + i, std::min(lanes, columns - i));
      }
    }
  }

private:
  /// Asks for memory before it is needed.
  void fetchRows(int x, int y, std::uint32_t rows) const
  {
    for (; rows != 0; rows &= rows - 1)
    {
      const auto j = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(rows));
      const std::size_t first = static_cast<std::size_t>(y + j) * lines_.width + x;
      const auto fetch = [first](const auto* from, std::size_t size)
      {
        if (from)
        {
          hwy::Prefetch(from + size * first);
        }
      };
      fetch(lines_.strength.data(), 1);
      fetch(lines_.front.data(), 1);
      fetch(lines_.inside.data(), 1);
      fetch(pixels_.depth.data(), 1);
      fetch(pixels_.rgba.data(), 4);
      fetch(surroundings_.windowDepth, 1);
      fetch(surroundings_.lineDepth, 1);
      fetch(surroundings_.rgba, 4);
    }
  }

  /// So many pixels side by side, as many as there are in a vector or less.
  void colorPixels(std::size_t first, int count) const
  {
    const IntegerTag integers;
    const Floats strength = load(lines_.strength.data() + first, count);
    const Lanes isLine = hn::Gt(strength, number(0));
    auto* rgba = reinterpret_cast<std::int32_t*>(pixels_.rgba.data()) + first;
    float* depth = pixels_.depth.data() + first;
    if (hn::AllFalse(Tag(), isLine))
    {
      store(hn::Zero(integers), rgba, count);
      store(number(NoLineDepth), depth, count);
      return;
    }
    // Other pixels have any front: they take the first pixel's.
    const Integers front = lines_.front.empty()
      ? hn::Zero(integers)
      : hn::IfThenElseZero(
          hn::RebindMask(integers, isLine), load(lines_.front.data() + first, count));
    const Integers color = colorOf(first, count, strength, front);
    store(hn::IfThenElseZero(hn::RebindMask(integers, isLine), color), rgba, count);
    store(hn::IfThenElse(isLine, depthOf(first, count, front), number(NoLineDepth)), depth, count);
  }

  [[nodiscard]] Integers colorOf(
    std::size_t first, int count, Floats strength, Integers front) const
  {
    const IntegerTag integers;
    const bool hasInside = surroundings_.rgba && !lines_.inside.empty();
    const Floats inside = hasInside ? load(lines_.inside.data() + first, count) : number(0);
    const Floats covered = hn::Add(strength, inside), part = hn::Div(number(1), covered);
    const auto* colors = reinterpret_cast<const std::int32_t*>(surroundings_.rgba);
    const Integers before = colors ? hn::GatherIndex(integers, colors, front) : hn::Zero(integers);
    const auto channelOf = [&](Integers shifted, float lineColor)
    {
      const Integers byte = hn::And(shifted, hn::Set(integers, 255));
      const Floats frontColor = hn::Div(hn::ConvertTo(Tag(), byte), number(255));
      const Floats line = style_.darken && colors ? hn::Mul(number(SilhouetteDarkness), frontColor)
                                                  : number(lineColor);
      const Floats sum = hn::Add(hn::Mul(strength, line), hn::Mul(inside, frontColor));
      return toByte(hn::Mul(part, sum));
    };
    const Integers red = channelOf(before, style_.color[0]);
    const Integers green = channelOf(hn::ShiftRight<8>(before), style_.color[1]);
    const Integers blue = channelOf(hn::ShiftRight<16>(before), style_.color[2]);
    const Integers alpha = toByte(hn::Mul(covered, number(style_.opacity)));
    return hn::Or(hn::Or(red, hn::ShiftLeft<8>(green)),
      hn::Or(hn::ShiftLeft<16>(blue), hn::ShiftLeft<24>(alpha)));
  }

  [[nodiscard]] Floats depthOf(std::size_t first, int count, Integers front) const
  {
    if (surroundings_.lineDepth)
    {
      return load(surroundings_.lineDepth + first, count);
    }
    const float* depth = surroundings_.windowDepth;
    // A line also covers parts of pixels that show what is in front of it.
    return depth ? hn::Min(hn::GatherIndex(Tag(), depth, front), load(depth + first, count))
                 : number(0);
  }

  const SilhouetteImage& lines_;
  const SilhouetteStyle& style_;
  const SilhouetteSurroundings& surroundings_;
  SilhouettePixels& pixels_;
};

void colorTile(const Coloring& all, int tileX, int tileY, std::uint32_t rows)
{
  Colorer(all).colorTile(tileX, tileY, rows);
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(colorTile);

void colorSilhouettes(const SilhouetteImage& lines, const SilhouetteStyle& style,
  const SilhouetteSurroundings& surroundings, SilhouettePixels& pixels)
{
  const std::size_t count = lines.strength.size();
  if (pixels.depth.size() != count || pixels.tileRows.size() != lines.tileRows.size())
  {
    pixels.rgba.assign(4 * count, 0);
    pixels.depth.assign(count, NoLineDepth);
    pixels.tileRows.assign(lines.tileRows.size(), 0);
  }
  const Coloring all{ lines, style, surroundings, pixels };
  const int columns = depthTiles(lines.width);
  tbb::parallel_for(tbb::blocked_range<int>(0, static_cast<int>(lines.tileRows.size()), 64),
    [&](const tbb::blocked_range<int>& tiles)
    {
      for (int tile = tiles.begin(); tile < tiles.end(); ++tile)
      {
        const auto at = static_cast<std::size_t>(tile);
        const std::uint32_t rows = lines.tileRows[at] | pixels.tileRows[at];
        if (rows != 0)
        {
          HWY_DYNAMIC_DISPATCH(colorTile)(all, tile % columns, tile / columns, rows);
        }
        pixels.tileRows[at] = lines.tileRows[at];
      }
    });
}
}
#endif
