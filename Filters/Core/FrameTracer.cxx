// SPDX-License-Identifier: BSD-3-Clause
#include "FrameTracer.h"

#include "FrontFinder.h"
#include "PrimaryPacket.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
constexpr int TileSize = DepthTileSize; // a tile is the unit of parallel work and of skipping
constexpr int PacketSide = PrimaryPacket::Side;
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr float NoDepth = 2;

struct Box
{
  Vec3d low, high;
};

/// Where a brick's spheres lie relative to its origin, a little enlarged so that rounding cannot
/// cut anything off.
Box boundsOf(const SphereScene& scene, std::size_t brick)
{
  RTCBounds b;
  rtcGetSceneBounds(scene.handle(brick), &b);
  const Vec3d low{ b.lower_x, b.lower_y, b.lower_z };
  const Vec3d high{ b.upper_x, b.upper_y, b.upper_z };
  const double margin = 1e-5 * length(high - low);
  const Vec3d grow{ margin, margin, margin };
  return { low - grow, high + grow };
}

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

void clear(TracedFrame& frame, const PixelRange& range)
{
  const int count = range.x1 - range.x0;
  for (int y = range.y0; y < range.y1; ++y)
  {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(y) * frame.width + range.x0;
    std::fill_n(frame.t.begin() + first, count, Infinity);
    std::fill_n(frame.sphere.begin() + first, count, SphereScene::None);
    std::fill_n(frame.normal.begin() + first, count, Vec3f{});
    std::fill_n(frame.windowDepth.begin() + first, count, NoDepth);
  }
}

/// Traces one brick of a scene. All its work is relative to the brick's origin, which moves the
/// origins of rays and leaves lengths as they are. The first brick's tracer writes every pixel;
/// those of others, which follow it in each tile, write where they find something nearer.
class BrickTracer
{
public:
  BrickTracer(const SphereScene& scene, std::size_t brick, const PrimaryRays& rays,
    const FrameSettings& settings, TracedFrame& frame)
    : scene_(scene)
    , number_(brick)
    , brick_(scene.set().bricks()[brick])
    , rays_(rays)
    , functions_(rays.functions())
    , settings_(settings)
    , frame_(frame)
  {
    functions_.localOrigin.base = functions_.localOrigin.base - brick_.origin;
    const Box box = boundsOf(scene, brick);
    const Vec3d low = brick_.origin + box.low, high = brick_.origin + box.high;
    seen_ = rays.pixelsOfBox(low, high);
    start_ = rays.startOfBox(low, high);
    isCut_ = rays.isCutByNearPlane(low, high);
  }

  [[nodiscard]] bool maySee(const PixelRange& tile) const
  {
    return !intersect(tile, seen_).empty();
  }

  void traceTile(const PixelRange& tile, TraceCounters& counters) const
  {
    if (!maySee(tile))
    {
      clearFirst(tile);
      return;
    }
    for (int y = tile.y0; y < tile.y1; y += PacketSide)
    {
      for (int x = tile.x0; x < tile.x1; x += PacketSide)
      {
        const PixelRange packet = intersect(tile, { x, y, x + PacketSide, y + PacketSide });
        maySee(packet) ? tracePacket(packet, counters) : clearFirst(packet);
      }
    }
  }

  /// What is behind the front that a pixel shows.
  void traceBehind(int x, int y, const TracedFrame& inFront, TraceCounters& counters) const
  {
    const std::size_t pixel = pixelOf(x, y);
    PrimaryRay ray = rayAt(x, y);
    const double s = inFront.t[pixel] / ray.worldPerLocal;
    const double radius = scene_.spheres()[inFront.sphere[pixel]].radius;
    // Beyond the rounding of t, so that the same front is not met again.
    ray.nearest = std::max(ray.nearest, s + 1e-12 * std::max(std::abs(s), radius));
    store(pixel, ray, find(ray, std::max(start_, s), counters), counters);
  }

private:
  void clearFirst(const PixelRange& range) const
  {
    if (number_ == 0)
    {
      clear(frame_, range);
    }
  }

  /// Is what the pixel has nearer than t, from a brick before this one?
  [[nodiscard]] bool isBehind(std::size_t pixel, double t) const
  {
    return number_ != 0 && !(t < frame_.t[pixel]);
  }

  [[nodiscard]] PrimaryRay rayAt(int x, int y) const
  {
    PrimaryRay ray = rays_.at(x + settings_.sampleX, y + settings_.sampleY);
    ray.origin = ray.origin - brick_.origin;
    return ray;
  }

  [[nodiscard]] Front find(const PrimaryRay& ray, double start, TraceCounters& counters) const
  {
    return findFront(scene_, number_, settings_.hidden, ray, start, counters.rays);
  }

  [[nodiscard]] std::size_t pixelOf(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_.width) +
      static_cast<std::size_t>(x);
  }

  void tracePacket(const PixelRange& range, TraceCounters& counters) const
  {
    PrimaryPacket packet;
    alignas(64) RTCRayHit16 query;
    makeRays(functions_, range.x0, range.y0, settings_.sampleX, settings_.sampleY, start_, isCut_,
      packet, query);
    alignas(64) int valid[PrimaryPacket::Size];
    for (int lane = 0; lane < static_cast<int>(PrimaryPacket::Size); ++lane)
    {
      const bool inside =
        range.x0 + lane % PacketSide < range.x1 && range.y0 + lane / PacketSide < range.y1;
      valid[lane] = inside ? -1 : 0;
    }
    FrontQuery context;
    initRayQueryContext(context.embree, true);
    context.hidden = settings_.hidden;
    context.brick = &brick_;
    context.ray = nullptr;
    intersect16(valid, scene_.handle(number_), context.embree, query,
      settings_.hidden ? passSpheres : nullptr);
    loadCandidates(query, packet);
    meetFronts(functions_, range.x0, range.y0, settings_.sampleX, settings_.sampleY, packet);
    storePacket(range, query, packet, counters);
  }

  void loadCandidates(const RTCRayHit16& query, PrimaryPacket& packet) const
  {
    for (std::size_t lane = 0; lane < PrimaryPacket::Size; ++lane)
    {
      const bool hit = query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
      const Sphere sphere = brick_.spheres[hit ? query.hit.primID[lane] : 0];
      packet.sphere[0][lane] = sphere.x;
      packet.sphere[1][lane] = sphere.y;
      packet.sphere[2][lane] = sphere.z;
      packet.sphere[3][lane] = sphere.radius;
    }
  }

  void storePacket(const PixelRange& range, const RTCRayHit16& query, const PrimaryPacket& packet,
    TraceCounters& counters) const
  {
    for (int y = range.y0; y < range.y1; ++y)
    {
      for (int x = range.x0; x < range.x1; ++x)
      {
        const auto lane = static_cast<std::size_t>((y - range.y0) * PacketSide + x - range.x0);
        ++counters.rays;
        storeLane(x, y, lane, query, packet, counters);
      }
    }
  }

  void storeLane(int x, int y, std::size_t lane, const RTCRayHit16& query,
    const PrimaryPacket& packet, TraceCounters& counters) const
  {
    const std::size_t pixel = pixelOf(x, y);
    if (query.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID)
    {
      storeNothing(pixel);
      return;
    }
    const double s = packet.s[lane];
    const bool sure =
      packet.isFront[lane] > 0 && !isDoubtful(s - packet.start[lane], packet.sphere[3][lane]);
    const double worldPerLocal = functions_.worldPerLocal;
    if (!sure || worldPerLocal == 0)
    {
      const PrimaryRay ray = rayAt(x, y);
      store(pixel, ray, find(ray, packet.start[lane], counters), counters);
      return;
    }
    const double t = s * worldPerLocal;
    if (isBehind(pixel, t))
    {
      return;
    }
    countHit(pixel, counters);
    frame_.t[pixel] = t;
    frame_.sphere[pixel] = brick_.id(query.hit.primID[lane]);
    frame_.normal[pixel] = { packet.normalX[lane], packet.normalY[lane], packet.normalZ[lane] };
    frame_.windowDepth[pixel] = packet.windowDepth[lane];
  }

  /// Once a pixel, whichever bricks it shows.
  void countHit(std::size_t pixel, TraceCounters& counters) const
  {
    counters.hits += number_ == 0 || frame_.sphere[pixel] == SphereScene::None;
  }

  void storeNothing(std::size_t pixel) const
  {
    if (number_ != 0)
    {
      return; // others may have found something
    }
    frame_.t[pixel] = Infinity;
    frame_.sphere[pixel] = SphereScene::None;
    frame_.normal[pixel] = {};
    frame_.windowDepth[pixel] = NoDepth;
  }

  void store(
    std::size_t pixel, const PrimaryRay& ray, const Front& front, TraceCounters& counters) const
  {
    if (front.sphere == SphereScene::None)
    {
      storeNothing(pixel);
      return;
    }
    const double t = front.s * ray.worldPerLocal;
    if (isBehind(pixel, t))
    {
      return;
    }
    countHit(pixel, counters);
    frame_.t[pixel] = t;
    frame_.sphere[pixel] = front.sphere;
    frame_.normal[pixel] = front.normal.as<float>();
    frame_.windowDepth[pixel] = static_cast<float>(std::clamp(ray.windowDepth(front.s), 0.0, 1.0));
  }

  const SphereScene& scene_;
  std::size_t number_;
  const Brick& brick_;
  const PrimaryRays& rays_;
  PrimaryRayFunctions functions_; ///< relative to the brick
  const FrameSettings& settings_;
  TracedFrame& frame_;
  PixelRange seen_; ///< nothing is to be seen outside
  double start_;    ///< no ray meets a sphere before
  bool isCut_;      ///< the near plane may be behind some fronts
};

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

DepthRange rangeOf(const TracedFrame& frame, const PixelRange& tile)
{
  DepthRange range;
  for (int y = tile.y0; y < tile.y1; ++y)
  {
    const double* t = frame.t.data() + static_cast<std::ptrdiff_t>(y) * frame.width;
    std::for_each(t + tile.x0, t + tile.x1, [&range](double depth) { range.add(depth); });
  }
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
TraceCounters forEachTile(const TracedFrame& frame, const Function& f)
{
  const int columns = depthTiles(frame.width);
  const int rows = depthTiles(frame.height);
  tbb::enumerable_thread_specific<TraceCounters> counters;
  tbb::parallel_for(tbb::blocked_range<int>(0, columns * rows),
    [&](const tbb::blocked_range<int>& tiles)
    {
      TraceCounters& mine = counters.local();
      for (int tile = tiles.begin(); tile < tiles.end(); ++tile)
      {
        const int x = tile % columns * TileSize, y = tile / columns * TileSize;
        f(intersect({ 0, 0, frame.width, frame.height }, { x, y, x + TileSize, y + TileSize }),
          mine);
      }
    });
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

TraceCounters traceFrame(const SphereScene& scene, const PrimaryRays& rays,
  const FrameSettings& settings, TracedFrame& frame)
{
  prepare(frame, rays, settings);
  if (scene.spheres().empty())
  {
    clear(frame, { 0, 0, frame.width, frame.height });
    return {};
  }
  const std::vector<BrickTracer> tracers = tracersOf(scene, rays, settings, frame);
  return forEachTile(frame,
    [&](const PixelRange& tile, TraceCounters& counters)
    { traceTile(tracers, tile, frame, counters); });
}

TraceCounters traceBehind(const SphereScene& scene, const PrimaryRays& rays,
  const FrameSettings& settings, const TracedFrame& inFront,
  const std::vector<std::uint8_t>& wanted, TracedFrame& frame)
{
  prepare(frame, rays, settings);
  const std::vector<BrickTracer> tracers = tracersOf(scene, rays, settings, frame);
  return forEachTile(frame,
    [&](const PixelRange& tile, TraceCounters& counters)
    {
      ++counters.tiles;
      clear(frame, tile);
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
