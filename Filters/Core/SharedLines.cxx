// SPDX-License-Identifier: BSD-3-Clause
#include "SharedLines.h"

#include "SilhouetteTiles.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace po
{
namespace
{
using Words = ProcessGroup::Words;

constexpr float Steps = 65535;
constexpr float NoLine = 2;

/// The line in one pixel of a tile.
struct LinePixel
{
  std::uint8_t place;         ///< in the tile, rows of DepthTileSize
  std::int8_t frontX, frontY; ///< from the pixel to one in front
  std::uint8_t unused;
  std::uint16_t strength, inside;
};
static_assert(sizeof(LinePixel) == sizeof(std::uint64_t));

std::uint16_t stepsOf(float share)
{
  return static_cast<std::uint16_t>(std::lround(Steps * std::clamp(share, 0.0F, 1.0F)));
}

std::uint64_t wordOf(const LinePixel& pixel)
{
  std::uint64_t word = 0;
  std::memcpy(&word, &pixel, sizeof(word));
  return word;
}

LinePixel pixelOf(std::uint64_t word)
{
  LinePixel pixel{};
  std::memcpy(&pixel, &word, sizeof(pixel));
  return pixel;
}

/// Two floats a word.
void append(const std::vector<float>& values, Words& words)
{
  const std::size_t end = words.size();
  words.resize(end + (values.size() + 1) / 2);
  std::memcpy(words.data() + end, values.data(), values.size() * sizeof(float));
}

void appendTile(const SilhouetteImage& image, int tile, const std::function<float(int)>& depthOf,
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
        words.push_back(wordOf({ static_cast<std::uint8_t>((j - y) * DepthTileSize + i - x),
          static_cast<std::int8_t>(front % image.width - i),
          static_cast<std::int8_t>(front / image.width - j), 0,
          std::max<std::uint16_t>(1, stepsOf(strength)), stepsOf(inside) }));
        depths.push_back(std::min(depthOf(at), depthOf(front)));
      }
    }
  }
  words[head] = static_cast<std::uint64_t>(tile) | std::uint64_t(depths.size()) << 32U;
  append(depths, words);
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
    image.tileHasLines.assign(static_cast<std::size_t>(depthTiles(width)) * depthTiles(height), 0);
    lines.windowDepth.assign(pixels, NoLine);
  }
}

void clear(PlacedLines& lines)
{
  SilhouetteImage& image = lines.image;
  const int columns = depthTiles(image.width);
  for (std::size_t tile = 0; tile < image.tileHasLines.size(); ++tile)
  {
    if (image.tileHasLines[tile] != 0)
    {
      clearTile(image, static_cast<int>(tile) % columns, static_cast<int>(tile) / columns);
      image.tileHasLines[tile] = 0;
    }
  }
}
}

void appendLines(const SilhouetteImage& image, int firstRow, int endRow,
  const std::function<float(int)>& depthOf, Words& words)
{
  const int columns = depthTiles(image.width);
  std::vector<float> depths;
  for (int tile = firstRow * columns; tile < endRow * columns; ++tile)
  {
    if (image.tileHasLines[static_cast<std::size_t>(tile)] != 0)
    {
      appendTile(image, tile, depthOf, words, depths);
    }
  }
}

void readLines(const Words& words, int width, int height, PlacedLines& lines)
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
    image.tileHasLines[static_cast<std::size_t>(tile)] = 1;
    std::vector<float> depths(static_cast<std::size_t>(count));
    if (count > 0)
    {
      std::memcpy(depths.data(), &*(at + count), depths.size() * sizeof(float));
    }
    for (std::ptrdiff_t i = 0; i < count; ++i)
    {
      const LinePixel pixel = pixelOf(at[i]);
      const int place = (y + pixel.place / DepthTileSize) * width + x + pixel.place % DepthTileSize;
      const auto to = static_cast<std::size_t>(place);
      image.strength[to] = static_cast<float>(pixel.strength) / Steps;
      image.inside[to] = static_cast<float>(pixel.inside) / Steps;
      image.front[to] = place + pixel.frontY * width + pixel.frontX;
      lines.windowDepth[to] = depths[static_cast<std::size_t>(i)];
    }
    at += count + (count + 1) / 2;
  }
}
}
