// SPDX-License-Identifier: BSD-3-Clause
#include "RimGeometry.h"

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
/// |a + x b + y c|^2 times a factor.
Quadratic squareOf(const WindowFunction<Vec3d>& f, double factor)
{
  const auto product = [factor](double scale, const Vec3d& a, const Vec3d& b)
  { return static_cast<float>(factor * scale * dot(a, b)); };
  return { product(1, f.base, f.base), product(2, f.base, f.dx), product(2, f.base, f.dy),
    product(1, f.dx, f.dx), product(2, f.dx, f.dy), product(1, f.dy, f.dy) };
}
}

RayPatch makeRayPatch(const RayPencil& rays)
{
  const double scale = 1 / length(rays.localDirection.base);
  return { rays, scale, squareOf(rays.localDirection, scale * scale) };
}

Quadratic squaredMoment(const RayPatch& patch, const Sphere& sphere)
{
  const WindowFunction<Vec3d>& d = patch.rays.localDirection;
  const WindowFunction<Vec3d>& origin = patch.rays.localOrigin;
  const Vec3d toCenter = sphere.center().as<double>() - origin.base;
  const WindowFunction<Vec3d> moment{ cross(toCenter, d.base),
    cross(toCenter, d.dx) - cross(origin.dx, d.base),
    cross(toCenter, d.dy) - cross(origin.dy, d.base) };
  const double scale = patch.scale / sphere.radius;
  return squareOf(moment, scale * scale);
}

double rimDepth(const RayPatch& patch, const Sphere& sphere)
{
  const RayPencil& rays = patch.rays;
  const Vec3d toCenter = sphere.center().as<double>() - rays.localOrigin.base;
  const Vec3d& growth = rays.localOrigin.dx;
  const double radius = sphere.radius;
  const double local = dot(growth, growth) > 0
    ? patch.scale * dot(toCenter, rays.localDirection.base)
    : std::sqrt(std::max(0.0, dot(toCenter, toCenter) - radius * radius));
  return local * patch.scale * length(rays.worldDirection.base);
}
}
