// SPDX-License-Identifier: BSD-3-Clause
#include "RimShares.h"

#include <algorithm>

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs. There are no fused multiply-adds: the bits are the same.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "RimShares.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 16>;
using Floats = hn::Vec<Tag>;
constexpr std::size_t MostLanes = 16;

/// A rim farther than this from an edge, in pixels, is not what the edge is the edge of.
constexpr float FarFromEdge = 1.5F;

inline Floats dot(const Floats a[3], const Floats b[3])
{
  return hn::Add(hn::Add(hn::Mul(a[0], b[0]), hn::Mul(a[1], b[1])), hn::Mul(a[2], b[2]));
}

/// Where pixels lie beside their rims.
struct Place
{
  Floats distance;     ///< beyond the rim, in pixels
  Floats wide, narrow; ///< the larger and the smaller component of the unit normal, without sign
};

/// Rims and patches of the pixels of one vector, as columns.
struct Columns
{
  HWY_ALIGN float m[3][MostLanes];
  HWY_ALIGN float mx[3][MostLanes];
  HWY_ALIGN float my[3][MostLanes];
  HWY_ALIGN float radius[MostLanes];

  void load(const Rim& rim, std::size_t lane)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      m[axis][lane] = rim.m[axis];
      mx[axis][lane] = rim.mx[axis];
      my[axis][lane] = rim.my[axis];
    }
    radius[lane] = rim.radius;
  }
};

/// All pixels of one vector have the rays of one patch.
inline Place placeOf(const Columns& c, const RayPatch& p, Floats x, Floats y)
{
  const Tag d;
  const Floats tiny = hn::Set(d, 1e-30F), one = hn::Set(d, 1.0F), half = hn::Set(d, 0.5F);
  Floats mx[3], my[3], m[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    mx[axis] = hn::Load(d, c.mx[axis]);
    my[axis] = hn::Load(d, c.my[axis]);
    m[axis] = hn::Add(hn::Load(d, c.m[axis]), hn::Add(hn::Mul(x, mx[axis]), hn::Mul(y, my[axis])));
  }
  const Floats mixed = hn::Mul(half, hn::Set(d, p.qxy));
  const Floats px = hn::Set(d, p.qx), py = hn::Set(d, p.qy);
  // Half the gradient of the squared length q of a direction.
  const Floats qx = hn::Add(px, hn::Add(hn::Mul(x, hn::Set(d, p.qxx)), hn::Mul(y, mixed)));
  const Floats qy = hn::Add(py, hn::Add(hn::Mul(y, hn::Set(d, p.qyy)), hn::Mul(x, mixed)));
  const Floats q = hn::Add(one, hn::Add(hn::Mul(x, hn::Add(px, qx)), hn::Mul(y, hn::Add(py, qy))));
  const Floats square = hn::Max(dot(m, m), tiny);
  const Floats h = hn::Sqrt(hn::Div(square, q));
  const Floats perH = hn::Div(one, hn::Mul(h, q));
  const Floats slide = hn::Mul(h, h);
  const Floats gx = hn::Mul(perH, hn::Sub(dot(m, mx), hn::Mul(slide, qx)));
  const Floats gy = hn::Mul(perH, hn::Sub(dot(m, my), hn::Mul(slide, qy)));
  const Floats gradient = hn::Add(hn::Mul(gx, gx), hn::Mul(gy, gy));
  const Floats perLength = hn::Div(one, hn::Sqrt(hn::Max(gradient, tiny)));
  const Floats nx = hn::Mul(hn::Abs(gx), perLength), ny = hn::Mul(hn::Abs(gy), perLength);
  const Floats distance = hn::Mul(hn::Sub(h, hn::Load(d, c.radius)), perLength);
  return { distance, hn::Max(nx, ny), hn::Min(nx, ny) };
}

/// Share of a pixel that lies beyond a straight line at a distance from its centre: the
/// distribution function of the trapezoid that a square shows in the direction of the normal.
inline Floats shareBeyond(Floats distance, const Place& place)
{
  const Tag d;
  const Floats half = hn::Set(d, 0.5F), one = hn::Set(d, 1.0F), two = hn::Set(d, 2.0F);
  const Floats x = hn::Abs(distance);
  const Floats flat = hn::Mul(half, hn::Sub(place.wide, place.narrow));
  const Floats end = hn::Mul(half, hn::Add(place.wide, place.narrow));
  const Floats left = hn::Max(hn::Sub(end, x), hn::Zero(d));
  const Floats area = hn::Max(hn::Mul(two, hn::Mul(place.wide, place.narrow)), hn::Set(d, 1e-9F));
  const Floats bent = hn::Sub(one, hn::Div(hn::Mul(left, left), area));
  const Floats straight = hn::Add(half, hn::Div(x, place.wide));
  const Floats share = hn::IfThenElse(hn::Le(x, flat), straight, bent);
  return hn::IfThenElse(hn::Lt(distance, hn::Zero(d)), hn::Sub(one, share), share);
}

/// Strengths and insides of the pixels of one vector.
inline void storeShares(const Place& place, RimWork& work, std::size_t i)
{
  const Tag d;
  const Floats one = hn::Set(d, 1.0F), zero = hn::Zero(d);
  const Floats outer = hn::Sub(place.distance, hn::LoadU(d, work.widths.data() + i));
  const Floats beyond = shareBeyond(place.distance, place);
  const Floats share = hn::Sub(beyond, shareBeyond(outer, place));
  const auto isEdge = hn::Gt(hn::LoadU(d, work.isEdge.data() + i), zero);
  const auto isFar = hn::Gt(hn::Abs(place.distance), hn::Set(d, FarFromEdge));
  const Floats covered = hn::IfThenElse(hn::And(isEdge, isFar), one, share);
  const Floats inside = hn::IfThenElseZero(hn::Ge(place.distance, zero), hn::Sub(one, beyond));
  const Floats weights = hn::LoadU(d, work.weights.data() + i);
  hn::StoreU(hn::Mul(covered, weights), d, work.strengths.data() + i);
  hn::StoreU(hn::Mul(inside, weights), d, work.insides.data() + i);
}

/// All vectors have room for whole lanes at their ends; one patch.
void findSharesOf(const RayPatch& patch, const Rim* rims, RimWork& work)
{
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  Columns columns;
  for (std::size_t i = 0; i < work.count; i += lanes)
  {
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      columns.load(rims[static_cast<std::size_t>(work.rims[i + lane])], lane);
    }
    const Place place =
      placeOf(columns, patch, hn::LoadU(d, work.x.data() + i), hn::LoadU(d, work.y.data() + i));
    storeShares(place, work, i);
  }
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(findSharesOf);

RayPatch makeRayPatch(const RayPencil& rays)
{
  const auto& d = rays.localDirection;
  const double scale = 1 / length(d.base), square = scale * scale;
  return { rays, scale, static_cast<float>(square * dot(d.base, d.dx)),
    static_cast<float>(square * dot(d.base, d.dy)), static_cast<float>(square * dot(d.dx, d.dx)),
    static_cast<float>(2 * square * dot(d.dx, d.dy)),
    static_cast<float>(square * dot(d.dy, d.dy)) };
}

Rim makeRim(const RayPatch& patch, const Sphere& sphere)
{
  const RayPencil& rays = patch.rays;
  const Vec3d toCenter = sphere.center().as<double>() - rays.localOrigin.base;
  Rim rim{ &sphere, sphere.radius, {}, {}, {} };
  const auto store = [&](Vec3d originStep, Vec3d directionStep, float(&to)[3])
  {
    const Vec3d m =
      patch.scale * (cross(toCenter, directionStep) - cross(originStep, rays.localDirection.base));
    to[0] = static_cast<float>(m.x);
    to[1] = static_cast<float>(m.y);
    to[2] = static_cast<float>(m.z);
  };
  store({}, rays.localDirection.base, rim.m);
  store(rays.localOrigin.dx, rays.localDirection.dx, rim.mx);
  store(rays.localOrigin.dy, rays.localDirection.dy, rim.my);
  return rim;
}

void RimWork::add(const RimPixel& pixel)
{
  constexpr std::size_t LargestVector = 16;
  if (count + LargestVector >= rims.size())
  {
    const std::size_t size = 2 * rims.size() + 4 * LargestVector;
    for (auto* integers : { &rims, &pixels, &frontPixels })
    {
      integers->resize(size);
    }
    for (auto* floats : { &x, &y, &widths, &weights, &isEdge, &strengths, &insides })
    {
      floats->resize(size);
    }
  }
  rims[count] = pixel.rim;
  pixels[count] = pixel.pixel;
  x[count] = pixel.x;
  y[count] = pixel.y;
  widths[count] = pixel.width;
  weights[count] = pixel.weight;
  isEdge[count] = pixel.isEdge ? 1 : 0;
  frontPixels[count] = pixel.frontPixel;
  ++count;
}

void findShares(const RayPatch& patch, const std::vector<Rim>& allRims, RimWork& work)
{
  if (work.count > 0)
  {
    // What lies beyond the last pixel is computed and never used.
    std::fill_n(work.rims.begin() + static_cast<std::ptrdiff_t>(work.count), 16, 0);
    HWY_DYNAMIC_DISPATCH(findSharesOf)(patch, allRims.data(), work);
  }
}
}
#endif
