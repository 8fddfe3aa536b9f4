// SPDX-License-Identifier: BSD-3-Clause
#include "BrickTracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace po
{
namespace
{
constexpr int PacketSide = PrimaryPacket::Side;

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

std::size_t laneOf(const PixelRange& range, int x, int y)
{
  return static_cast<std::size_t>((y - range.y0) * PacketSide + x - range.x0);
}

/// Calls f(x, y, lane) for all pixels of a packet.
template <typename Function>
void forEachLane(const PixelRange& range, const Function& f)
{
  for (int y = range.y0; y < range.y1; ++y)
  {
    for (int x = range.x0; x < range.x1; ++x)
    {
      f(x, y, laneOf(range, x, y));
    }
  }
}
}

BrickTracer::BrickTracer(const SphereScene& scene, std::size_t brick, const PrimaryRays& rays,
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

void BrickTracer::traceTile(const PixelRange& tile, TraceCounters& counters) const
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

void BrickTracer::traceBehind(
  int x, int y, const TracedFrame& inFront, TraceCounters& counters) const
{
  const std::size_t pixel = pixelOf(x, y);
  PrimaryRay ray = rayAt(x, y);
  const double s = inFront.t[pixel] / ray.worldPerLocal;
  const double radius = scene_.spheres()[inFront.sphere[pixel]].radius;
  // Beyond the rounding of t, so that the same front is not met again.
  ray.nearest = std::max(ray.nearest, s + 1e-12 * std::max(std::abs(s), radius));
  store(pixel, ray, find(ray, std::max(start_, s), counters), counters);
}

void BrickTracer::clearFirst(const PixelRange& range) const
{
  if (isFirst())
  {
    frame_.clear(range);
  }
}

/// Is what the pixel has nearer than t, from a brick before this one?
bool BrickTracer::isBehind(std::size_t pixel, double t) const
{
  return !isFirst() && !(t < frame_.t[pixel]);
}

PrimaryRay BrickTracer::rayAt(int x, int y) const
{
  PrimaryRay ray = rays_.at(x + settings_.sampleX, y + settings_.sampleY);
  ray.origin = ray.origin - brick_.origin;
  return ray;
}

Front BrickTracer::find(const PrimaryRay& ray, double start, TraceCounters& counters) const
{
  return findFront(scene_, number_, settings_.hidden, ray, start, counters.rays);
}

std::size_t BrickTracer::pixelOf(int x, int y) const
{
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_.width) +
    static_cast<std::size_t>(x);
}

void BrickTracer::tracePacket(const PixelRange& range, TraceCounters& counters) const
{
  PrimaryPacket packet;
  alignas(64) RTCRayHit16 query;
  makeRays(functions_, range.x0, range.y0, settings_.sampleX, settings_.sampleY, start_, isCut_,
    packet, query);
  counters.rays += static_cast<std::size_t>((range.x1 - range.x0) * (range.y1 - range.y0));
  if (!findCandidates(range, query, packet))
  {
    clearFirst(range);
    return;
  }
  const std::size_t doubtful =
    meetFronts(functions_, range.x0, range.y0, settings_.sampleX, settings_.sampleY, packet);
  isFirst() ? copyPacket(range, packet, counters) : mergePacket(range, packet, counters);
  if (doubtful > 0)
  {
    traceDoubtful(range, packet, counters);
  }
}

/// What Embree finds; false if it finds nothing.
bool BrickTracer::findCandidates(
  const PixelRange& range, RTCRayHit16& query, PrimaryPacket& packet) const
{
  alignas(64) int valid[PrimaryPacket::Size] = {};
  forEachLane(range, [&valid](int, int, std::size_t lane) { valid[lane] = -1; });
  FrontQuery context;
  initRayQueryContext(context.embree, true);
  context.hidden = settings_.hidden;
  context.brick = &brick_;
  context.ray = nullptr;
  intersect16(
    valid, scene_.handle(number_), context.embree, query, settings_.hidden ? passSpheres : nullptr);
  bool any = false;
  for (std::size_t lane = 0; lane < PrimaryPacket::Size; ++lane)
  {
    const bool hit = query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
    any |= hit;
    const unsigned place = query.hit.primID[lane];
    const Sphere sphere = hit ? brick_.spheres[place] : Sphere{ 0, 0, 0, 0 };
    packet.sphere[0][lane] = sphere.x;
    packet.sphere[1][lane] = sphere.y;
    packet.sphere[2][lane] = sphere.z;
    packet.sphere[3][lane] = sphere.radius;
    packet.id[lane] = hit ? brick_.id(place) : SphereScene::None;
  }
  return any;
}

/// Writes all pixels, found or not.
void BrickTracer::copyPacket(
  const PixelRange& range, const PrimaryPacket& packet, TraceCounters& counters) const
{
  for (std::size_t lane = 0; lane < PrimaryPacket::Size; ++lane)
  {
    counters.hits += packet.id[lane] != SphereScene::None && packet.isDoubtful[lane] == 0;
  }
  const auto copyRow = [&](int y, auto columns)
  {
    const std::size_t pixel = pixelOf(range.x0, y);
    const std::size_t first = laneOf(range, range.x0, y);
    std::copy_n(packet.t + first, columns, &frame_.t[pixel]);
    std::copy_n(packet.id + first, columns, &frame_.sphere[pixel]);
    std::copy_n(packet.windowDepth + first, columns, &frame_.windowDepth[pixel]);
    for (std::size_t i = 0; i < static_cast<std::size_t>(columns); ++i)
    {
      const std::size_t lane = first + i;
      frame_.normal[pixel + i] = { packet.normalX[lane], packet.normalY[lane],
        packet.normalZ[lane] };
    }
  };
  const int columns = range.x1 - range.x0;
  for (int y = range.y0; y < range.y1; ++y)
  {
    // Mostly of a length that the compiler knows.
    columns == PacketSide ? copyRow(y, std::integral_constant<int, PacketSide>())
                          : copyRow(y, columns);
  }
}

/// Writes those pixels where the packet has something nearer.
void BrickTracer::mergePacket(
  const PixelRange& range, const PrimaryPacket& packet, TraceCounters& counters) const
{
  forEachLane(range,
    [&](int x, int y, std::size_t lane)
    {
      const std::size_t pixel = pixelOf(x, y);
      if (packet.isDoubtful[lane] > 0 || isBehind(pixel, packet.t[lane]))
      {
        return;
      }
      countHit(pixel, counters);
      frame_.t[pixel] = packet.t[lane];
      frame_.sphere[pixel] = packet.id[lane];
      frame_.normal[pixel] = { packet.normalX[lane], packet.normalY[lane], packet.normalZ[lane] };
      frame_.windowDepth[pixel] = packet.windowDepth[lane];
    });
}

void BrickTracer::traceDoubtful(
  const PixelRange& range, const PrimaryPacket& packet, TraceCounters& counters) const
{
  forEachLane(range,
    [&](int x, int y, std::size_t lane)
    {
      if (packet.isDoubtful[lane] > 0)
      {
        const PrimaryRay ray = rayAt(x, y);
        store(pixelOf(x, y), ray, find(ray, packet.start[lane], counters), counters);
      }
    });
}

/// Once a pixel, whichever bricks it shows.
void BrickTracer::countHit(std::size_t pixel, TraceCounters& counters) const
{
  counters.hits += isFirst() || frame_.sphere[pixel] == SphereScene::None;
}

void BrickTracer::storeNothing(std::size_t pixel) const
{
  if (!isFirst())
  {
    return; // others may have found something
  }
  frame_.t[pixel] = std::numeric_limits<double>::infinity();
  frame_.sphere[pixel] = SphereScene::None;
  frame_.normal[pixel] = {};
  frame_.windowDepth[pixel] = TracedFrame::NoDepth;
}

void BrickTracer::store(
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
}
