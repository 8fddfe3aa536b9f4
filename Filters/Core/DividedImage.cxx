// SPDX-License-Identifier: BSD-3-Clause
#include "DividedImage.h"

#include "ArrivedTiles.h"
#include "SharedWords.h"

#include <algorithm>
#include <utility>

namespace po
{
namespace
{
DepthImage<float> distancesOf(const ZBuffer& zBuffer, std::vector<float>& distances)
{
  eyeDistances(zBuffer.windowToEye, zBuffer.z, zBuffer.width, zBuffer.height, distances);
  return { distances.data(), zBuffer.width, zBuffer.height };
}

/// A tile of one process.
struct ArrivedTile
{
  int tile;
  const float* z;
};
}

PixelRange ZBuffer::samplesOf(int tile) const
{
  const int columns = depthTiles(widthInPixels()), side = DepthTileSize * samples;
  const int x = tile % columns * side, y = tile / columns * side;
  return intersect({ 0, 0, width, height }, { x, y, x + side, y + side });
}

DividedImage::DividedImage(const ZBuffer& own, std::vector<float>& distances)
  : own_(own)
  , distances_(distances)
  , depth_(distancesOf(own, distances), own.samples)
{
}

std::size_t DividedImage::samplesIn(int tile) const
{
  const PixelRange samples = own_.samplesOf(tile);
  return static_cast<std::size_t>(samples.x1 - samples.x0) * (samples.y1 - samples.y0);
}

void DividedImage::appendOwn(const std::vector<int>& tiles, const std::vector<DepthRange>& ranges,
  ProcessGroup::Words& words) const
{
  std::vector<float> z;
  for (const int tile : tiles)
  {
    const DepthRange& own = depth_.ranges()[static_cast<std::size_t>(tile)];
    if (!own.hasGeometry() || own.nearest > ranges[static_cast<std::size_t>(tile)].farthest)
    {
      continue;
    }
    z.clear();
    const PixelRange samples = own_.samplesOf(tile);
    for (int j = samples.y0; j < samples.y1; ++j)
    {
      const auto row = own_.z.begin() + static_cast<std::ptrdiff_t>(j) * own_.width;
      z.insert(z.end(), row + samples.x0, row + samples.x1);
    }
    words.push_back(static_cast<std::uint64_t>(tile));
    appendValues(z, words);
  }
}

void DividedImage::assemble(const ProcessGroup::Words& words, std::vector<DepthRange> ranges)
{
  ranges_ = std::move(ranges);
  std::vector<ArrivedTile> arrived;
  for (std::size_t at = 0; at < words.size();)
  {
    const auto tile = static_cast<int>(words[at]);
    arrived.push_back({ tile, reinterpret_cast<const float*>(&words[at] + 1) });
    at += 1 + wordsFor(samplesIn(tile) * sizeof(float));
  }
  isEmpty_ = arrived.empty();
  forEachTileOf(arrived,
    [&](const ArrivedTile* first, const ArrivedTile* last)
    {
      std::for_each(first, last, [&](const ArrivedTile& one) { takeTile(one.tile, one.z); });
      measureTile(first->tile);
    });
}

/// Puts the samples of another process into this one's, as far as they are nearer.
void DividedImage::takeTile(int tile, const float* z)
{
  const PixelRange samples = own_.samplesOf(tile);
  for (int j = samples.y0; j < samples.y1; ++j)
  {
    float* row = own_.z.data() + static_cast<std::ptrdiff_t>(j) * own_.width;
    for (int i = samples.x0; i < samples.x1; ++i)
    {
      row[i] = std::min(row[i], *z++);
    }
  }
}

/// Finds the depths of a tile, and their range.
void DividedImage::measureTile(int tile)
{
  eyeDistances(own_.windowToEye, own_.z, own_.width, own_.height, own_.samplesOf(tile), distances_);
  const int columns = depthTiles(width());
  ranges_[static_cast<std::size_t>(tile)] = depth_.findRange(tile % columns, tile / columns);
}

void DividedImage::findLines(const SilhouetteRule& rule, SilhouetteImage& image) const
{
  findSilhouettes(*this, rule, image, { true, true });
}

/// That of its nearest sample.
float DividedImage::windowDepth(int pixel) const
{
  const int x = pixel % width() * own_.samples, y = pixel / width() * own_.samples;
  float nearest = 1;
  for (int j = y; j < y + own_.samples; ++j)
  {
    const auto row = own_.z.begin() + static_cast<std::ptrdiff_t>(j) * own_.width + x;
    nearest = std::min(nearest, *std::min_element(row, row + own_.samples));
  }
  return nearest;
}
}
