// SPDX-License-Identifier: BSD-3-Clause
#include "SharedDepth.h"

#include "ArrivedTiles.h"
#include "SharedTiles.h"
#include "SphereDistances.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace po
{
namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Pixels of a tile.
struct TilePixels
{
  int x, y, columns, rows;

  TilePixels(int tile, int width, int height)
    : x(tile % depthTiles(width) * DepthTileSize)
    , y(tile / depthTiles(width) * DepthTileSize)
    , columns(std::min(DepthTileSize, width - x))
    , rows(std::min(DepthTileSize, height - y))
  {
  }

  template <typename Function>
  void forEachRow(int width, const Function& f) const
  {
    for (int j = y; j < y + rows; ++j)
    {
      f(static_cast<std::ptrdiff_t>(j) * width + x);
    }
  }
};

PrimaryRays raysFor(const Camera& camera, const Matrix4& localToWorld)
{
  const auto rays = PrimaryRays::make(camera, localToWorld);
  if (!rays)
  {
    throw std::runtime_error("Another process has spheres whose placement is singular.");
  }
  return *rays;
}
}

void SharedDepth::clear(int width, int height)
{
  if (frame_.width != width || frame_.height != height)
  {
    const auto pixels = static_cast<std::size_t>(width) * height;
    frame_.width = width;
    frame_.height = height;
    frame_.t.assign(pixels, Infinity);
    frame_.sphere.assign(pixels, SphereScene::None);
    filled_.clear();
  }
  for (const int tile : filled_)
  {
    const TilePixels pixels(tile, width, height);
    pixels.forEachRow(width,
      [&](std::ptrdiff_t first)
      {
        std::fill_n(frame_.t.begin() + first, pixels.columns, Infinity);
        std::fill_n(frame_.sphere.begin() + first, pixels.columns, SphereScene::None);
      });
  }
  filled_.clear();
  rays_.clear();
}

void SharedDepth::assemble(
  const Camera& camera, const ProcessGroup::Words& words, std::vector<DepthRange> ranges)
{
  clear(camera.width, camera.height);
  frame_.tiles = std::move(ranges);
  SharedTiles arrived = readTiles(words);
  for (const Matrix4& placement : arrived.localToWorld)
  {
    rays_.push_back(raysFor(camera, placement));
  }
  // Of pixels with the same depth the first process has its way.
  forEachTileOf(arrived.tiles,
    [&](const SharedTile* first, const SharedTile* last) { setTile(arrived, first, last); });
  std::transform(arrived.tiles.begin(), arrived.tiles.end(), std::back_inserter(filled_),
    [](const SharedTile& tile) { return tile.tile; });
  filled_.erase(std::unique(filled_.begin(), filled_.end()), filled_.end());
  firstSpheres_ = std::move(arrived.firstSphere);
  processes_ = std::move(arrived.processes);
  spheres_ = std::move(arrived.spheres);
  if (!rays_.empty())
  {
    merged_.emplace(std::vector<TracedLayer>{ { frame_, rays_.front(), spheres_ } });
  }
}

void SharedDepth::setTile(
  const SharedTiles& arrived, const SharedTile* first, const SharedTile* last)
{
  const TilePixels pixels(first->tile, frame_.width, frame_.height);
  std::for_each(first, last, [&](const SharedTile& tile) { addTo(arrived, tile); });
  DepthRange range;
  pixels.forEachRow(frame_.width,
    [&](std::ptrdiff_t start)
    {
      for (int i = 0; i < pixels.columns; ++i)
      {
        range.add(frame_.t[static_cast<std::size_t>(start + i)]);
      }
    });
  frame_.tiles[static_cast<std::size_t>(first->tile)] = range;
}

void SharedDepth::addTo(const SharedTiles& arrived, const SharedTile& tile)
{
  const TilePixels pixels(tile.tile, frame_.width, frame_.height);
  const PrimaryRayFunctions& rays = rays_[tile.layer].functions();
  const std::uint32_t firstSphere = arrived.firstSphere[tile.layer];
  const std::uint8_t* run = tile.runs;
  for (int begin = 0; begin < pixels.columns * pixels.rows; run += 2)
  {
    const int end = begin + run[1] + 1;
    for (int k = begin; k < end && tile.showsSphere(run[0]);)
    {
      const int i = k % pixels.columns, count = std::min(end - k, pixels.columns - i);
      const std::uint32_t number = firstSphere + tile.spheres[run[0]];
      addRow(
        arrived.spheres[number], number, rays, pixels.x + i, pixels.y + k / pixels.columns, count);
      k += count;
    }
    begin = end;
  }
}

/// Puts a sphere into some pixels of a row, as far as it is the nearest.
void SharedDepth::addRow(const Sphere& sphere, std::uint32_t number,
  const PrimaryRayFunctions& rays, int x, int y, int count)
{
  std::array<double, DepthTileSize + 8> distances;
  distancesTo(sphere, rays, x, y, count, distances.data());
  const auto first = static_cast<std::size_t>(y) * frame_.width + x;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
  {
    if (distances[i] < frame_.t[first + i])
    {
      frame_.t[first + i] = distances[i];
      frame_.sphere[first + i] = number;
    }
  }
}

SphereLayer SharedDepth::layer(std::size_t index) const
{
  const std::size_t end =
    index + 1 < firstSpheres_.size() ? firstSpheres_[index + 1] : spheres_.size();
  const std::uint32_t first = firstSpheres_[index];
  return { spheres_.data() + first, first, static_cast<std::uint32_t>(end) - first, &rays_[index] };
}

float SharedDepth::windowDepth(int pixel) const
{
  const double t = frame_.t[static_cast<std::size_t>(pixel)];
  if (t == Infinity)
  {
    return 2;
  }
  const int x = pixel % frame_.width, y = pixel / frame_.width;
  const PrimaryRay ray = rays_.front().at(x + 0.5, y + 0.5);
  return static_cast<float>(ray.windowDepth(t / ray.worldPerLocal));
}

int SharedDepth::processOf(int pixel) const
{
  const std::uint32_t sphere = frame_.sphere[static_cast<std::size_t>(pixel)];
  const auto next = std::upper_bound(firstSpheres_.begin(), firstSpheres_.end(), sphere);
  return sphere == SphereScene::None ? 0 : processes_[next - firstSpheres_.begin() - 1];
}
}
