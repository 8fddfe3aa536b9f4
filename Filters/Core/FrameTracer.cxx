// SPDX-License-Identifier: BSD-3-Clause
#include "FrameTracer.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
constexpr int TileSize = 16;  // pixels; a tile is the unit of parallel work and of skipping
constexpr int PacketSide = 4; // a packet is 4 x 4 rays
constexpr int PacketSize = PacketSide * PacketSide;
constexpr float InfinityF = std::numeric_limits<float>::infinity();
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// A single-precision hit this many radii from its start may be out of order with its neighbours;
/// 2^-24 * 4096 is some 1/4000 of a radius.
constexpr double ReliableRadii = 4096;

struct Box
{
  Vec3d low, high;
};

struct Hit
{
  double s = Infinity; ///< local length from the ray's origin
  std::uint32_t sphere = SphereScene::None;
  Vec3d normal;
};

/// A ray as Embree gets it: it starts near the spheres, at s = start.
struct PreparedRay
{
  PrimaryRay ray;
  double start = 0;
  float end = -1; ///< length from the start; negative: nothing can be hit
};

/// Where the spheres lie, a little enlarged so that rounding cannot cut anything off.
Box boundsOf(const Brick& brick)
{
  const double margin = 1e-5 * length(brick.high - brick.low);
  const Vec3d grow{ margin, margin, margin };
  return { brick.low - grow, brick.high + grow };
}

/// Clips [enter, leave] to one slab.
void clipSlab(
  double origin, double direction, double low, double high, double& enter, double& leave)
{
  if (direction == 0)
  {
    leave = origin < low || origin > high ? -Infinity : leave;
    return;
  }
  const double a = (low - origin) / direction;
  const double b = (high - origin) / direction;
  enter = std::max(enter, std::min(a, b));
  leave = std::min(leave, std::max(a, b));
}

PreparedRay prepare(const PrimaryRay& ray, const Box& box)
{
  double enter = ray.nearest, leave = ray.farthest;
  clipSlab(ray.origin.x, ray.direction.x, box.low.x, box.high.x, enter, leave);
  clipSlab(ray.origin.y, ray.direction.y, box.low.y, box.high.y, enter, leave);
  clipSlab(ray.origin.z, ray.direction.z, box.low.z, box.high.z, enter, leave);
  PreparedRay prepared{ ray, enter, -1 };
  if (enter <= leave)
  {
    // Behind the box there is nothing, so only the far plane needs care: it cuts in double.
    prepared.end = InfinityF;
  }
  return prepared;
}

/// Intersects the front of one sphere in double precision; the perpendicular form keeps its digits
/// for an origin far away. False if the ray misses, or the front lies before the near or behind the
/// far plane.
bool intersectExactly(const PrimaryRay& ray, const SphereSet& spheres, std::uint32_t id, Hit& hit)
{
  const Vec3d fromCenter = ray.origin - spheres.center(id);
  const double toNearest = -dot(fromCenter, ray.direction);
  const Vec3d nearest = fromCenter + toNearest * ray.direction;
  const double radius = spheres.spheres()[id].radius;
  const double squared = radius * radius - dot(nearest, nearest);
  if (!(squared >= 0))
  {
    return false;
  }
  const double half = std::sqrt(squared);
  const double s = toNearest - half;
  if (s < ray.nearest || s > ray.farthest)
  {
    return false;
  }
  hit = { s, id, (1 / radius) * (nearest - half * ray.direction) };
  return true;
}

/// Not a denormal number, which Embree may take for zero and hit the same sphere forever.
float justBehind(float t)
{
  return std::max(std::nextafter(t, InfinityF), std::numeric_limits<float>::min());
}

/// @param home origin of the brick that the ray is traced in
RTCRayHit makeRay(const PrimaryRay& ray, double start, float tnear, Vec3d home)
{
  const Vec3f origin = (ray.origin + start * ray.direction - home).as<float>();
  RTCRayHit query;
  query.ray.org_x = origin.x;
  query.ray.org_y = origin.y;
  query.ray.org_z = origin.z;
  query.ray.tnear = tnear;
  query.ray.dir_x = static_cast<float>(ray.direction.x);
  query.ray.dir_y = static_cast<float>(ray.direction.y);
  query.ray.dir_z = static_cast<float>(ray.direction.z);
  query.ray.time = 0;
  query.ray.tfar = InfinityF;
  query.ray.mask = 0xFFFFFFFFu;
  query.ray.id = 0;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

/// Makes room; the pixels keep what they had until their tile is traced.
void resize(TracedFrame& frame, int width, int height)
{
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  frame.width = width;
  frame.height = height;
  frame.t.resize(pixels);
  frame.sphere.resize(pixels);
  frame.normal.resize(pixels);
  frame.windowDepth.resize(pixels);
}

/// Pixels [x0, x1) x [y0, y1) see nothing.
void clear(TracedFrame& frame, int x0, int y0, int x1, int y1)
{
  constexpr float Nothing = 2;
  for (int y = y0; y < y1; ++y)
  {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(y) * frame.width + x0;
    std::fill_n(frame.t.begin() + first, x1 - x0, Infinity);
    std::fill_n(frame.sphere.begin() + first, x1 - x0, SphereScene::None);
    std::fill_n(frame.normal.begin() + first, x1 - x0, Vec3f{});
    std::fill_n(frame.windowDepth.begin() + first, x1 - x0, Nothing);
  }
}

/// Traces what one brick holds; of several bricks the nearest hit stays.
class Tracer
{
public:
  Tracer(const SphereScene& scene, std::size_t brick, const PrimaryRays& rays, TracedFrame& frame)
    : set_(scene.set())
    , brick_(set_.bricks()[brick])
    , handle_(scene.handle(brick))
    , rays_(rays)
    , frame_(frame)
    , box_(boundsOf(brick_))
  {
  }

  [[nodiscard]] bool mayShow(int x0, int y0, int x1, int y1) const
  {
    return rays_.mayShowBox(box_.low, box_.high, x0, y0, x1, y1);
  }

  /// Pixels [x0, x1) x [y0, y1).
  void traceTile(int x0, int y0, int x1, int y1, TraceCounters& counters) const
  {
    for (int y = y0; y < y1; y += PacketSide)
    {
      for (int x = x0; x < x1; x += PacketSide)
      {
        tracePacket(x, y, counters);
      }
    }
  }

private:
  void tracePacket(int x0, int y0, TraceCounters& counters) const
  {
    PreparedRay prepared[PacketSize];
    alignas(64) int valid[PacketSize];
    alignas(64) RTCRayHit16 query;
    std::size_t active = 0;
    for (int lane = 0; lane < PacketSize; ++lane)
    {
      const int x = x0 + lane % PacketSide, y = y0 + lane / PacketSide;
      if (x < frame_.width && y < frame_.height)
      {
        prepared[lane] = prepare(rays_.at(x + 0.5, y + 0.5), box_);
      }
      const bool traced = prepared[lane].end > 0;
      valid[lane] = traced ? -1 : 0;
      active += traced;
      fill(query, lane, prepared[lane]);
    }
    if (active == 0)
    {
      return;
    }
    counters.rays += active;
    RayQueryContext context;
    initRayQueryContext(context, true);
    intersect16(valid, handle_, context, query);
    for (int lane = 0; lane < PacketSize; ++lane)
    {
      if (valid[lane] != 0 && query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID)
      {
        const Hit hit =
          settle(prepared[lane], brick_.id(query.hit.primID[lane]), query.ray.tfar[lane], counters);
        store(x0 + lane % PacketSide, y0 + lane / PacketSide, prepared[lane].ray, hit, counters);
      }
    }
  }

  void fill(RTCRayHit16& query, int lane, const PreparedRay& prepared) const
  {
    const RTCRayHit one = makeRay(prepared.ray, prepared.start, 0, brick_.origin);
    query.ray.org_x[lane] = one.ray.org_x;
    query.ray.org_y[lane] = one.ray.org_y;
    query.ray.org_z[lane] = one.ray.org_z;
    query.ray.tnear[lane] = 0;
    query.ray.dir_x[lane] = one.ray.dir_x;
    query.ray.dir_y[lane] = one.ray.dir_y;
    query.ray.dir_z[lane] = one.ray.dir_z;
    query.ray.time[lane] = 0;
    query.ray.tfar[lane] = InfinityF;
    query.ray.mask[lane] = 0xFFFFFFFFu;
    query.ray.id[lane] = 0;
    query.ray.flags[lane] = 0;
    query.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }

  /// From Embree's first candidate to the exact first hit.
  Hit settle(const PreparedRay& prepared, unsigned id, float tfar, TraceCounters& counters) const
  {
    Hit hit = goOn(prepared.ray, prepared.start, id, tfar, counters);
    const double radius = hit.sphere == SphereScene::None ? 0 : set_.spheres()[hit.sphere].radius;
    const double way = hit.s - prepared.start;
    if (hit.sphere != SphereScene::None && way > ReliableRadii * radius)
    {
      // Once more from close by, where floats can tell neighbours apart.
      const double start = std::max(prepared.start, hit.s - std::max(4 * radius, 1e-5 * way));
      const Hit closer = traceFrom(prepared.ray, start, counters);
      return closer.s < Infinity ? closer : hit;
    }
    return hit;
  }

  Hit traceFrom(const PrimaryRay& ray, double start, TraceCounters& counters) const
  {
    RTCRayHit query = makeRay(ray, start, 0, brick_.origin);
    return findNext(query, counters)
      ? goOn(ray, start, brick_.id(query.hit.primID), query.ray.tfar, counters)
      : Hit{};
  }

  /// Passes candidates that are no hit in truth: fronts before the near plane, grazed spheres.
  Hit goOn(
    const PrimaryRay& ray, double start, unsigned id, float tfar, TraceCounters& counters) const
  {
    Hit hit;
    while (!intersectExactly(ray, set_, id, hit))
    {
      if (start + tfar > ray.farthest + set_.spheres()[id].radius)
      {
        return {};
      }
      RTCRayHit query = makeRay(ray, start, justBehind(tfar), brick_.origin);
      if (!findNext(query, counters))
      {
        return {};
      }
      id = brick_.id(query.hit.primID);
      tfar = query.ray.tfar;
    }
    return hit;
  }

  bool findNext(RTCRayHit& query, TraceCounters& counters) const
  {
    ++counters.rays;
    RayQueryContext context;
    initRayQueryContext(context, false);
    intersect1(handle_, context, query);
    return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }

  void store(int x, int y, const PrimaryRay& ray, const Hit& hit, TraceCounters& counters) const
  {
    const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_.width) +
      static_cast<std::size_t>(x);
    const double t = hit.s * ray.worldPerLocal;
    if (hit.sphere == SphereScene::None || !(t < frame_.t[pixel]))
    {
      return;
    }
    counters.hits += frame_.sphere[pixel] == SphereScene::None;
    frame_.t[pixel] = t;
    frame_.sphere[pixel] = hit.sphere;
    frame_.normal[pixel] = hit.normal.as<float>();
    frame_.windowDepth[pixel] = static_cast<float>(std::clamp(ray.windowDepth(hit.s), 0.0, 1.0));
  }

  const SphereSet& set_;
  const Brick& brick_;
  RTCScene handle_;
  const PrimaryRays& rays_;
  TracedFrame& frame_;
  Box box_;
};

void traceTile(const std::vector<Tracer>& tracers, int tileX, int tileY, TracedFrame& frame,
  TraceCounters& counters)
{
  const int x0 = tileX * TileSize, x1 = std::min(x0 + TileSize, frame.width);
  const int y0 = tileY * TileSize, y1 = std::min(y0 + TileSize, frame.height);
  clear(frame, x0, y0, x1, y1);
  bool skipped = true;
  for (const Tracer& tracer : tracers)
  {
    if (tracer.mayShow(x0, y0, x1, y1))
    {
      tracer.traceTile(x0, y0, x1, y1, counters);
      skipped = false;
    }
  }
  ++counters.tiles;
  counters.tilesSkipped += skipped;
}
}

TraceCounters traceFrame(const SphereScene& scene, const PrimaryRays& rays, TracedFrame& frame)
{
  resize(frame, rays.width(), rays.height());
  if (scene.spheres().empty())
  {
    clear(frame, 0, 0, frame.width, frame.height);
    return {};
  }
  std::vector<Tracer> tracers;
  for (std::size_t brick = 0; brick < scene.set().bricks().size(); ++brick)
  {
    tracers.emplace_back(scene, brick, rays, frame);
  }
  const int columns = (frame.width + TileSize - 1) / TileSize;
  const int rows = (frame.height + TileSize - 1) / TileSize;
  tbb::enumerable_thread_specific<TraceCounters> counters;
  tbb::parallel_for(tbb::blocked_range<int>(0, columns * rows),
    [&](const tbb::blocked_range<int>& tiles)
    {
      TraceCounters& mine = counters.local();
      for (int tile = tiles.begin(); tile < tiles.end(); ++tile)
      {
        traceTile(tracers, tile % columns, tile / columns, frame, mine);
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
