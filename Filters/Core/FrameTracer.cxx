// SPDX-License-Identifier: BSD-3-Clause
#include "FrameTracer.h"

#include "BrickTracer.h"
#include "ForEachTile.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <limits>

namespace po
{
namespace
{
constexpr int TileSize = DepthTileSize; // a tile is the unit of parallel work and of skipping
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Makes room; the pixels keep what they had until they are traced.
void prepare(TracedFrame& frame, const PrimaryRays& rays, const FrameSettings& settings)
{
  const auto pixels =
    static_cast<std::size_t>(rays.width()) * static_cast<std::size_t>(rays.height());
  frame.width = rays.width();
  frame.height = rays.height();
  frame.sampleX = settings.sampleX;
  frame.sampleY = settings.sampleY;
  frame.t.resize(pixels);
  frame.sphere.resize(pixels);
  frame.normal.resize(pixels);
  frame.windowDepth.resize(pixels);
  DepthRange nothing;
  nothing.background = true;
  frame.tiles.assign(
    static_cast<std::size_t>(depthTiles(frame.width)) * depthTiles(frame.height), nothing);
}

std::vector<BrickTracer> tracersOf(const SphereScene& scene, const PrimaryRays& rays,
  const FrameSettings& settings, TracedFrame& frame)
{
  std::vector<BrickTracer> tracers;
  for (std::size_t brick = 0; brick < scene.set().bricks().size(); ++brick)
  {
    tracers.emplace_back(scene, brick, rays, settings, frame);
  }
  return tracers;
}

/// Column by column, which compilers turn into vector code.
DepthRange rangeOf(const TracedFrame& frame, const PixelRange& tile)
{
  std::array<double, TileSize> nearest, farthest, largest;
  nearest.fill(Infinity);
  farthest.fill(-Infinity);
  largest.fill(-Infinity);
  const auto addRow = [&](const double* t, std::size_t columns)
  {
    for (std::size_t i = 0; i < columns; ++i)
    {
      const double finite = t[i] < Infinity ? t[i] : -Infinity;
      nearest[i] = t[i] < nearest[i] ? t[i] : nearest[i];
      farthest[i] = finite > farthest[i] ? finite : farthest[i];
      largest[i] = t[i] > largest[i] ? t[i] : largest[i];
    }
  };
  const auto columns = static_cast<std::size_t>(tile.x1 - tile.x0);
  for (int y = tile.y0; y < tile.y1; ++y)
  {
    const double* t = frame.t.data() + static_cast<std::ptrdiff_t>(y) * frame.width + tile.x0;
    columns == TileSize ? addRow(t, TileSize) : addRow(t, columns);
  }
  DepthRange range;
  range.nearest = *std::min_element(nearest.begin(), nearest.end());
  range.farthest = *std::max_element(farthest.begin(), farthest.end());
  range.background = *std::max_element(largest.begin(), largest.end()) == Infinity;
  return range;
}

void traceTile(const std::vector<BrickTracer>& tracers, const PixelRange& tile, TracedFrame& frame,
  TraceCounters& counters)
{
  bool seen = false;
  for (const BrickTracer& tracer : tracers)
  {
    seen |= tracer.maySee(tile);
    tracer.traceTile(tile, counters);
  }
  if (seen)
  {
    frame.tiles[static_cast<std::size_t>(tile.y0 / TileSize) * depthTiles(frame.width) +
      tile.x0 / TileSize] = rangeOf(frame, tile);
  }
  ++counters.tiles;
  counters.tilesSkipped += !seen;
}

/// Calls f(tile, counters) for all tiles in parallel and adds up the counters.
template <typename Function>
TraceCounters countTiles(const TracedFrame& frame, const Function& f)
{
  tbb::enumerable_thread_specific<TraceCounters> counters;
  forEachTile(
    frame.width, frame.height, [&](const PixelRange& tile) { f(tile, counters.local()); });
  TraceCounters total;
  for (const TraceCounters& part : counters)
  {
    total.rays += part.rays;
    total.hits += part.hits;
    total.tiles += part.tiles;
    total.tilesSkipped += part.tilesSkipped;
  }
  return total;
}
}

void TracedFrame::clear(const PixelRange& range)
{
  const int count = range.x1 - range.x0;
  for (int y = range.y0; y < range.y1; ++y)
  {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(y) * width + range.x0;
    std::fill_n(t.begin() + first, count, Infinity);
    std::fill_n(sphere.begin() + first, count, SphereScene::None);
    std::fill_n(normal.begin() + first, count, Vec3f{});
    std::fill_n(windowDepth.begin() + first, count, NoDepth);
  }
}

TraceCounters traceFrame(const SphereScene& scene, const PrimaryRays& rays,
  const FrameSettings& settings, TracedFrame& frame)
{
  prepare(frame, rays, settings);
  if (scene.spheres().empty())
  {
    frame.clear({ 0, 0, frame.width, frame.height });
    return {};
  }
  const std::vector<BrickTracer> tracers = tracersOf(scene, rays, settings, frame);
  return countTiles(frame,
    [&](const PixelRange& tile, TraceCounters& counters)
    { traceTile(tracers, tile, frame, counters); });
}

TraceCounters traceBehind(const SphereScene& scene, const PrimaryRays& rays,
  const FrameSettings& settings, const TracedFrame& inFront,
  const std::vector<std::uint8_t>& wanted, TracedFrame& frame)
{
  prepare(frame, rays, settings);
  const std::vector<BrickTracer> tracers = tracersOf(scene, rays, settings, frame);
  return countTiles(frame,
    [&](const PixelRange& tile, TraceCounters& counters)
    {
      ++counters.tiles;
      frame.clear(tile);
      for (int y = tile.y0; y < tile.y1; ++y)
      {
        for (int x = tile.x0; x < tile.x1; ++x)
        {
          const std::size_t pixel =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
            static_cast<std::size_t>(x);
          if (wanted[pixel] != 0 && inFront.sphere[pixel] != SphereScene::None)
          {
            for (const BrickTracer& tracer : tracers)
            {
              tracer.traceBehind(x, y, inFront, counters);
            }
          }
        }
      }
    });
}
}
