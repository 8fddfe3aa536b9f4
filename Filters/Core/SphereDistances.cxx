// SPDX-License-Identifier: BSD-3-Clause
#include "SphereDistances.h"

// Highway compiles this file once for each instruction set and chooses when it runs. There are no
// fused multiply-adds: the bits are the same.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "SphereDistances.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 8>;
using Doubles = hn::Vec<Tag>;

struct Vectors
{
  Doubles x, y, z;
};

/// base + i step.
inline Vectors linear(Vec3d base, Vec3d step, Doubles i)
{
  const Tag d;
  const auto at = [&](double b, double s)
  { return hn::Add(hn::Set(d, b), hn::Mul(i, hn::Set(d, s))); };
  return { at(base.x, step.x), at(base.y, step.y), at(base.z, step.z) };
}

inline Doubles dotOf(const Vectors& a, const Vectors& b)
{
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// With c from the ray's origin to the centre and d along the ray, the ray passes the centre at the
/// distance |c x d| / |d|; c x d loses no digits however far the eye is.
void distances(
  const Sphere& sphere, const PrimaryRayFunctions& rays, int x, int y, int count, double* result)
{
  const Tag d;
  const double clipX = rays.clipX(x + 0.5), clipY = rays.clipY(y + 0.5), pixel = 2.0 / rays.width;
  const Vec3d direction = rays.localDirection.at(clipX, clipY);
  const Vec3d turn = pixel * rays.localDirection.dx, move = pixel * rays.localOrigin.dx;
  const Vec3d center = sphere.center().as<double>() - rays.localOrigin.at(clipX, clipY);
  // Either all rays have one origin or one direction: the product is linear too.
  const Vec3d moment = cross(center, direction);
  const Vec3d momentStep = cross(center, turn) - cross(move, direction);
  const Doubles squaredRadius = hn::Set(d, double(sphere.radius) * sphere.radius);
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d)))
  {
    const Doubles at = hn::Iota(d, i);
    const Vectors along = linear(direction, turn, at);
    const Vectors beside = linear(moment, momentStep, at);
    const Doubles square = dotOf(along, along);
    const Doubles depth = dotOf(linear(center, -1.0 * move, at), along);
    const Doubles left = hn::Sub(hn::Mul(squaredRadius, square), dotOf(beside, beside));
    const Doubles share = hn::Div(hn::Sub(depth, hn::Sqrt(hn::Max(left, hn::Zero(d)))), square);
    const Vectors inWorld =
      linear(rays.worldDirection.at(clipX, clipY), pixel * rays.worldDirection.dx, at);
    const Doubles worldLength = rays.worldPerLocal > 0
      ? hn::Mul(hn::Set(d, rays.worldPerLocal), hn::Sqrt(square))
      : hn::Sqrt(dotOf(inWorld, inWorld));
    hn::StoreU(hn::Mul(share, worldLength), d, result + i);
  }
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(distances);

void distancesTo(
  const Sphere& sphere, const PrimaryRayFunctions& rays, int x, int y, int count, double* result)
{
  HWY_DYNAMIC_DISPATCH(distances)(sphere, rays, x, y, count, result);
}
}
#endif
