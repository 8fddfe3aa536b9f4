// SPDX-License-Identifier: BSD-3-Clause
#include "SharedLines.h"

#include "SharedWords.h"
#include "SilhouetteTiles.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace po
{
namespace
{
using Words = ProcessGroup::Words;

constexpr float Steps = 16383;

/// In window depth: rounding shall not hide a line behind what it lies in front of.
constexpr float DepthTolerance = 5e-7F;

/// The line in one pixel of a tile.
struct LinePixel
{
  unsigned place;     ///< in the tile, rows of DepthTileSize
  int frontX, frontY; ///< from the pixel to one in front, -16 to 15
  unsigned strength, inside;
  unsigned process;
};

unsigned stepsOf(float share)
{
  return static_cast<unsigned>(std::lround(Steps * std::clamp(share, 0.0F, 1.0F)));
}

std::uint64_t wordOf(const LinePixel& pixel)
{
  std::uint64_t word = pixel.process;
  word = word << 14U | pixel.inside;
  word = word << 14U | pixel.strength;
  word = word << 5U | static_cast<unsigned>(pixel.frontY + 16);
  word = word << 5U | static_cast<unsigned>(pixel.frontX + 16);
  return word << 8U | pixel.place;
}

LinePixel pixelOf(std::uint64_t word)
{
  const auto take = [&word](unsigned bits)
  {
    const auto value = static_cast<unsigned>(word & ((1U << bits) - 1));
    word >>= bits;
    return value;
  };
  LinePixel pixel{};
  pixel.place = take(8);
  pixel.frontX = static_cast<int>(take(5)) - 16;
  pixel.frontY = static_cast<int>(take(5)) - 16;
  pixel.strength = take(14);
  pixel.inside = take(14);
  pixel.process = take(16);
  return pixel;
}

void appendTile(const SilhouetteImage& image, int tile, const DividedDepth& depth, bool placed,
  Words& words, std::vector<float>& depths)
{
  const int columns = depthTiles(image.width);
  const int x = tile % columns * DepthTileSize, y = tile / columns * DepthTileSize;
  const std::size_t head = words.size();
  words.push_back(0);
  depths.clear();
  for (int j = y; j < std::min(y + DepthTileSize, image.height); ++j)
  {
    for (int i = x; i < std::min(x + DepthTileSize, image.width); ++i)
    {
      const int at = j * image.width + i;
      const float strength = image.strength[static_cast<std::size_t>(at)];
      if (strength > 0)
      {
        const int front = image.front[static_cast<std::size_t>(at)];
        const float inside = image.inside.empty() ? 0 : image.inside[static_cast<std::size_t>(at)];
        words.push_back(wordOf({ static_cast<unsigned>((j - y) * DepthTileSize + i - x),
          front % image.width - i, front / image.width - j, std::max(1U, stepsOf(strength)),
          stepsOf(inside), static_cast<unsigned>(depth.processOf(front)) }));
        if (placed)
        {
          depths.push_back(
            std::min(depth.windowDepth(at), depth.windowDepth(front)) - DepthTolerance);
        }
      }
    }
  }
  words[head] = static_cast<std::uint64_t>(tile) | std::uint64_t(words.size() - head - 1) << 32U;
  appendValues(depths, words);
}

void resize(int width, int height, PlacedLines& lines)
{
  SilhouetteImage& image = lines.image;
  const auto pixels = static_cast<std::size_t>(width) * height;
  if (image.width != width || image.height != height)
  {
    image.width = width;
    image.height = height;
    image.strength.assign(pixels, 0);
    image.front.assign(pixels, 0);
    image.inside.assign(pixels, 0);
    image.tileRows.assign(static_cast<std::size_t>(depthTiles(width)) * depthTiles(height), 0);
    lines.windowDepth.assign(pixels, NoLineDepth);
    lines.process.assign(pixels, 0);
  }
}

void clear(PlacedLines& lines)
{
  SilhouetteImage& image = lines.image;
  const int columns = depthTiles(image.width);
  for (std::size_t tile = 0; tile < image.tileRows.size(); ++tile)
  {
    clearTile(static_cast<int>(tile) % columns, static_cast<int>(tile) / columns, image);
  }
}
}

void appendLines(const SilhouetteImage& image, int firstRow, int endRow, const DividedDepth& depth,
  bool placed, Words& words)
{
  const int columns = depthTiles(image.width);
  std::vector<float> depths;
  for (int tile = firstRow * columns; tile < endRow * columns; ++tile)
  {
    if (image.tileRows[static_cast<std::size_t>(tile)] != 0)
    {
      appendTile(image, tile, depth, placed, words, depths);
    }
  }
}

void readLines(const Words& words, int width, int height, bool placed, PlacedLines& lines)
{
  resize(width, height, lines);
  clear(lines);
  SilhouetteImage& image = lines.image;
  const int columns = depthTiles(width);
  for (auto at = words.begin(); at != words.end();)
  {
    const auto tile = static_cast<int>(*at & 0xFFFFFFFFU);
    const auto count = static_cast<std::ptrdiff_t>(*at++ >> 32U);
    const int x = tile % columns * DepthTileSize, y = tile / columns * DepthTileSize;
    std::vector<float> depths(static_cast<std::size_t>(count), NoLineDepth);
    if (count > 0 && placed)
    {
      std::memcpy(depths.data(), &*(at + count), depths.size() * sizeof(float));
    }
    for (std::ptrdiff_t i = 0; i < count; ++i)
    {
      const LinePixel pixel = pixelOf(at[i]);
      const int row = static_cast<int>(pixel.place) / DepthTileSize;
      const int place = (y + row) * width + x + static_cast<int>(pixel.place) % DepthTileSize;
      const auto to = static_cast<std::size_t>(place);
      image.tileRows[static_cast<std::size_t>(tile)] |= static_cast<std::uint16_t>(1U << row);
      image.strength[to] = static_cast<float>(pixel.strength) / Steps;
      image.inside[to] = static_cast<float>(pixel.inside) / Steps;
      image.front[to] = place + pixel.frontY * width + pixel.frontX;
      lines.process[to] = static_cast<std::uint16_t>(pixel.process);
      lines.windowDepth[to] = depths[static_cast<std::size_t>(i)];
    }
    at += count + (placed ? (count + 1) / 2 : 0);
  }
}
}
