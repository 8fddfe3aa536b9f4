// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouettePixels.h"

#include <hwy/base.h>
#include <hwy/cache_control.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace po
{
namespace
{
constexpr float NoLine = 2;

std::uint8_t toByte(float value)
{
  return static_cast<std::uint8_t>(255.0F * std::clamp(value, 0.0F, 1.0F) + 0.5F);
}

class Colorer
{
public:
  Colorer(const SilhouetteImage& lines, const SilhouetteStyle& style,
    const SilhouetteSurroundings& surroundings, SilhouettePixels& pixels)
    : lines_(lines)
    , style_(style)
    , surroundings_(surroundings)
    , pixels_(pixels)
  {
  }

  void colorTile(int tileX, int tileY) const
  {
    fetchTile(tileX, tileY);
    const int x = tileX * DepthTileSize, y = tileY * DepthTileSize;
    const int columns = std::min(DepthTileSize, lines_.width - x);
    for (int j = y; j < std::min(y + DepthTileSize, lines_.height); ++j)
    {
      const std::size_t first = static_cast<std::size_t>(j) * lines_.width + x;
      // Lengths that the compiler knows make these loops fast.
      columns == DepthTileSize ? colorRow(first, DepthTileSize) : colorRow(first, columns);
    }
  }

private:
  /// Asks for what is read in a tile before it is needed.
  void fetchTile(int tileX, int tileY) const
  {
    const int x = tileX * DepthTileSize, y = tileY * DepthTileSize;
    for (int j = y; j < std::min(y + DepthTileSize, lines_.height); ++j)
    {
      const std::size_t first = static_cast<std::size_t>(j) * lines_.width + x;
      const auto fetch = [first](const auto* from, std::size_t size)
      {
        if (from)
        {
          hwy::Prefetch(from + size * first);
        }
      };
      fetch(lines_.strength.data(), 1);
      fetch(lines_.front.data(), 1);
      fetch(surroundings_.windowDepth, 1);
      fetch(surroundings_.lineDepth, 1);
      fetch(surroundings_.rgba, 4);
    }
  }

  void colorRow(std::size_t first, int columns) const
  {
    const float* strength = &lines_.strength[first];
    std::fill_n(&pixels_.depth[first], columns, NoLine);
    std::fill_n(&pixels_.rgba[4 * first], 4 * columns, std::uint8_t(0));
    unsigned covered = 0;
    for (int i = 0; i < columns; ++i)
    {
      covered |= static_cast<unsigned>(strength[i] > 0) << static_cast<unsigned>(i);
    }
    for (; covered != 0; covered &= covered - 1)
    {
      colorPixel(first + hwy::Num0BitsBelowLS1Bit_Nonzero32(covered));
    }
  }

  void colorPixel(std::size_t pixel) const
  {
    const float strength = lines_.strength[pixel];
    const float inside = surroundings_.rgba && !lines_.inside.empty() ? lines_.inside[pixel] : 0;
    const float covered = strength + inside, part = 1 / covered;
    std::uint8_t* rgba = &pixels_.rgba[4 * pixel];
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      rgba[channel] =
        toByte(part * (strength * lineColor(pixel, channel) + inside * frontColor(pixel, channel)));
    }
    rgba[3] = toByte(covered * style_.opacity);
    pixels_.depth[pixel] = depthAt(pixel);
  }

  /// Colour of what is in front of a line; 0 where it is not known.
  [[nodiscard]] float frontColor(std::size_t pixel, std::size_t channel) const
  {
    return surroundings_.rgba
      ? surroundings_.rgba[4 * static_cast<std::size_t>(lines_.front[pixel]) + channel] / 255.0F
      : 0;
  }

  [[nodiscard]] float lineColor(std::size_t pixel, std::size_t channel) const
  {
    return style_.darken && surroundings_.rgba ? SilhouetteDarkness * frontColor(pixel, channel)
                                               : style_.color[channel];
  }

  [[nodiscard]] float depthAt(std::size_t pixel) const
  {
    if (surroundings_.lineDepth)
    {
      return surroundings_.lineDepth[pixel];
    }
    const float* depth = surroundings_.windowDepth;
    // A line also covers parts of pixels that show what is in front of it.
    return depth ? std::min(depth[lines_.front[pixel]], depth[pixel]) : 0;
  }

  const SilhouetteImage& lines_;
  const SilhouetteStyle& style_;
  const SilhouetteSurroundings& surroundings_;
  SilhouettePixels& pixels_;
};
}

void colorSilhouettes(const SilhouetteImage& lines, const SilhouetteStyle& style,
  const SilhouetteSurroundings& surroundings, SilhouettePixels& pixels)
{
  const std::size_t count = lines.strength.size();
  if (pixels.depth.size() != count || pixels.tileHasLines.size() != lines.tileHasLines.size())
  {
    pixels.rgba.assign(4 * count, 0);
    pixels.depth.assign(count, NoLine);
    pixels.tileHasLines.assign(lines.tileHasLines.size(), 0);
  }
  const Colorer colorer(lines, style, surroundings, pixels);
  const int columns = depthTiles(lines.width);
  tbb::parallel_for(tbb::blocked_range<int>(0, static_cast<int>(lines.tileHasLines.size()), 64),
    [&](const tbb::blocked_range<int>& tiles)
    {
      for (int tile = tiles.begin(); tile < tiles.end(); ++tile)
      {
        const auto at = static_cast<std::size_t>(tile);
        if (lines.tileHasLines[at] != 0 || pixels.tileHasLines[at] != 0)
        {
          colorer.colorTile(tile % columns, tile / columns);
        }
        pixels.tileHasLines[at] = lines.tileHasLines[at];
      }
    });
}
}
