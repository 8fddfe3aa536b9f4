// SPDX-License-Identifier: BSD-3-Clause
#include "PrimaryPacket.h"

#include "FrameTracer.h"
#include "FrontFinder.h"

#include <algorithm>
#include <limits>

// Highway compiles this file once for each instruction set and chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "PrimaryPacket.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, PrimaryPacket::Size>;
using Floats = hn::Rebind<float, Doubles>;
using Vector = hn::Vec<Doubles>;

/// A window function along lanes.
inline Vector at(const WindowFunction<double>& f, Vector x, Vector y)
{
  const Doubles d;
  return hn::MulAdd(x, hn::Set(d, f.dx), hn::MulAdd(y, hn::Set(d, f.dy), hn::Set(d, f.base)));
}

struct Vectors3
{
  Vector x, y, z;
};

inline Vectors3 at(const WindowFunction<Vec3d>& f, Vector x, Vector y)
{
  return { at(WindowFunction<double>{ f.base.x, f.dx.x, f.dy.x }, x, y),
    at(WindowFunction<double>{ f.base.y, f.dx.y, f.dy.y }, x, y),
    at(WindowFunction<double>{ f.base.z, f.dx.z, f.dy.z }, x, y) };
}

inline Vector dot(const Vectors3& a, const Vectors3& b)
{
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

/// Positions in the window, in [-1, 1], of the lanes from `lane` on.
struct WindowPositions
{
  Vector x, y;

  WindowPositions(const PrimaryRayFunctions& rays, int x0, int y0, double sampleX, double sampleY,
    std::size_t lane)
  {
    HWY_ALIGN static constexpr double Columns[] = { 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2,
      3 };
    HWY_ALIGN static constexpr double Rows[] = { 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3 };
    const Doubles d;
    const auto toClip = [&](const double* offsets, double first, int size)
    {
      return hn::Sub(
        hn::Mul(hn::Add(hn::LoadU(d, offsets + lane), hn::Set(d, first)), hn::Set(d, 2.0 / size)),
        hn::Set(d, 1.0));
    };
    x = toClip(Columns, x0 + sampleX, rays.width);
    y = toClip(Rows, y0 + sampleY, rays.height);
  }
};

void storeFloats(Vector v, float* to)
{
  hn::StoreU(hn::DemoteTo(Floats(), v), Floats(), to);
}

/// s of the near plane where z = -w, which is linear along the ray.
inline Vector nearPlane(const PrimaryRayFunctions& rays, const WindowPositions& p, Vector length)
{
  const Vector origin = hn::Add(at(rays.originZ, p.x, p.y), at(rays.originW, p.x, p.y));
  const Vector growth = hn::Add(at(rays.directionZ, p.x, p.y), at(rays.directionW, p.x, p.y));
  return hn::Div(hn::Mul(hn::Neg(origin), length), growth);
}

void makeRays(const PrimaryRayFunctions& rays, int x0, int y0, double sampleX, double sampleY,
  double start, bool clipStart, PrimaryPacket& packet, RTCRayHit16& query)
{
  const Doubles d;
  for (std::size_t lane = 0; lane < PrimaryPacket::Size; lane += hn::Lanes(d))
  {
    const WindowPositions p(rays, x0, y0, sampleX, sampleY, lane);
    Vectors3 direction = at(rays.localDirection, p.x, p.y);
    const Vector length = hn::Sqrt(dot(direction, direction));
    const Vector inverse = hn::Div(hn::Set(d, 1.0), length);
    direction = { hn::Mul(direction.x, inverse), hn::Mul(direction.y, inverse),
      hn::Mul(direction.z, inverse) };
    const Vectors3 origin = at(rays.localOrigin, p.x, p.y);
    Vector first = hn::Set(d, start);
    if (clipStart)
    {
      first = hn::Max(first, nearPlane(rays, p, length));
    }
    hn::Store(direction.x, d, packet.directionX + lane);
    hn::Store(direction.y, d, packet.directionY + lane);
    hn::Store(direction.z, d, packet.directionZ + lane);
    hn::Store(origin.x, d, packet.originX + lane);
    hn::Store(origin.y, d, packet.originY + lane);
    hn::Store(origin.z, d, packet.originZ + lane);
    hn::Store(inverse, d, packet.inverseLength + lane);
    hn::Store(first, d, packet.start + lane);
    storeFloats(direction.x, query.ray.dir_x + lane);
    storeFloats(direction.y, query.ray.dir_y + lane);
    storeFloats(direction.z, query.ray.dir_z + lane);
    storeFloats(hn::MulAdd(first, direction.x, origin.x), query.ray.org_x + lane);
    storeFloats(hn::MulAdd(first, direction.y, origin.y), query.ray.org_y + lane);
    storeFloats(hn::MulAdd(first, direction.z, origin.z), query.ray.org_z + lane);
  }
}

inline Vector loadFloats(const float* from)
{
  return hn::PromoteTo(Doubles(), hn::LoadU(Floats(), from));
}

/// The perpendicular form keeps its digits for an origin far away.
std::size_t meetFronts(const PrimaryRayFunctions& rays, int x0, int y0, double sampleX,
  double sampleY, PrimaryPacket& packet)
{
  const Doubles d;
  const Vector zero = hn::Zero(d), half = hn::Set(d, 0.5), one = hn::Set(d, 1.0),
               nowhere = hn::Set(d, std::numeric_limits<double>::infinity()),
               noDepth = hn::Set(d, TracedFrame::NoDepth);
  const bool isEven = rays.worldPerLocal > 0;
  std::size_t doubtful = 0;
  for (std::size_t lane = 0; lane < PrimaryPacket::Size; lane += hn::Lanes(d))
  {
    const WindowPositions p(rays, x0, y0, sampleX, sampleY, lane);
    const Vectors3 direction{ hn::Load(d, packet.directionX + lane),
      hn::Load(d, packet.directionY + lane), hn::Load(d, packet.directionZ + lane) };
    const Vectors3 fromCenter{ hn::Sub(hn::Load(d, packet.originX + lane),
                                 loadFloats(packet.sphere[0] + lane)),
      hn::Sub(hn::Load(d, packet.originY + lane), loadFloats(packet.sphere[1] + lane)),
      hn::Sub(hn::Load(d, packet.originZ + lane), loadFloats(packet.sphere[2] + lane)) };
    const Vector radius = loadFloats(packet.sphere[3] + lane);
    const Vector toNearest = hn::Neg(dot(fromCenter, direction));
    const Vectors3 nearest{ hn::MulAdd(toNearest, direction.x, fromCenter.x),
      hn::MulAdd(toNearest, direction.y, fromCenter.y),
      hn::MulAdd(toNearest, direction.z, fromCenter.z) };
    const Vector squared = hn::Sub(hn::Mul(radius, radius), dot(nearest, nearest));
    const Vector chord = hn::Sqrt(hn::Max(squared, zero));
    const Vector s = hn::Sub(toNearest, chord);
    const Vector scale = hn::Div(one, radius);

    const Vector inverse = hn::Load(d, packet.inverseLength + lane);
    const Vector z =
      hn::MulAdd(s, hn::Mul(at(rays.directionZ, p.x, p.y), inverse), at(rays.originZ, p.x, p.y));
    const Vector w =
      hn::MulAdd(s, hn::Mul(at(rays.directionW, p.x, p.y), inverse), at(rays.originW, p.x, p.y));
    const Vector depth = hn::Min(hn::Max(hn::MulAdd(hn::Div(z, w), half, half), zero), one);
    const auto candidate = hn::Gt(radius, zero);
    const Vector way = hn::Sub(s, hn::Load(d, packet.start + lane));
    const auto front = hn::And(hn::And(hn::Ge(squared, zero), hn::Le(hn::Abs(z), w)),
      hn::Le(way, hn::Mul(hn::Set(d, ReliableRadii), radius)));
    const auto unsure = isEven ? hn::AndNot(front, candidate) : candidate;
    doubtful += hn::CountTrue(d, unsure);

    const Vector t = hn::Mul(s, hn::Set(d, rays.worldPerLocal));
    hn::Store(hn::IfThenElse(candidate, t, nowhere), d, packet.t + lane);
    const auto normal = [&](Vector foot, Vector along)
    { return hn::IfThenElseZero(candidate, hn::Mul(scale, hn::NegMulAdd(chord, along, foot))); };
    storeFloats(normal(nearest.x, direction.x), packet.normalX + lane);
    storeFloats(normal(nearest.y, direction.y), packet.normalY + lane);
    storeFloats(normal(nearest.z, direction.z), packet.normalZ + lane);
    storeFloats(hn::IfThenElse(candidate, depth, noDepth), packet.windowDepth + lane);
    storeFloats(hn::IfThenElseZero(unsure, one), packet.isDoubtful + lane);
  }
  return doubtful;
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(makeRays);
HWY_EXPORT(meetFronts);

namespace
{
/// What is the same for all rays: array by array, in vector code.
void fillConstants(RTCRayHit16& query)
{
  constexpr std::size_t Size = PrimaryPacket::Size;
  std::fill_n(query.ray.tnear, Size, 0.0f);
  std::fill_n(query.ray.time, Size, 0.0f);
  std::fill_n(query.ray.tfar, Size, std::numeric_limits<float>::infinity());
  std::fill_n(query.ray.mask, Size, 0xFFFFFFFFu);
  std::fill_n(query.ray.flags, Size, 0u);
  std::fill_n(query.hit.geomID, Size, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(query.hit.instID[0], Size, RTC_INVALID_GEOMETRY_ID);
}
}

void makeRays(const PrimaryRayFunctions& rays, int x0, int y0, double sampleX, double sampleY,
  double start, bool clipStart, PrimaryPacket& packet, RTCRayHit16& query)
{
  fillConstants(query);
  HWY_DYNAMIC_DISPATCH(makeRays)
  (rays, x0, y0, sampleX, sampleY, start, clipStart, packet, query);
}

std::size_t meetFronts(const PrimaryRayFunctions& rays, int x0, int y0, double sampleX,
  double sampleY, PrimaryPacket& packet)
{
  return HWY_DYNAMIC_DISPATCH(meetFronts)(rays, x0, y0, sampleX, sampleY, packet);
}
}
#endif
