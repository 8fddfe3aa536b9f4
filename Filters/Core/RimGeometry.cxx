// SPDX-License-Identifier: BSD-3-Clause
#include "RimGeometry.h"

#include <cmath>

namespace po
{
namespace
{
/// |a + x b + y c|^2
Quadratic squareOf(const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
  const auto product = [](double factor, const Vec3d& u, const Vec3d& v)
  { return static_cast<float>(factor * dot(u, v)); };
  return { product(1, a, a), product(2, a, b), product(2, a, c), product(1, b, b), product(2, b, c),
    product(1, c, c) };
}

std::array<float, 6> productsOf(const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
  const auto product = [](const Vec3d& u, const Vec3d& v) { return static_cast<float>(dot(u, v)); };
  return { product(a, a), product(a, b), product(b, b), product(a, c), product(b, c),
    product(c, c) };
}
}

RayPatch makeRayPatch(const RayPencil& rays)
{
  const double scale = 1 / length(rays.localDirection.base);
  const Vec3d d = scale * rays.localDirection.base;
  const bool perspective = !(dot(rays.localOrigin.dx, rays.localOrigin.dx) > 0);
  const Vec3d dx = perspective ? scale * rays.localDirection.dx : rays.localOrigin.dx;
  const Vec3d dy = perspective ? scale * rays.localDirection.dy : rays.localOrigin.dy;
  const Vec3d none{ 0, 0, 0 }, across = cross(dx, dy);
  const double perVolume = 1 / dot(d, across);
  RayPatch patch;
  patch.perspective = perspective;
  patch.origin = rays.localOrigin.base;
  patch.depth = perVolume * across;
  patch.column = perVolume * cross(dy, d);
  patch.row = perVolume * cross(d, dx);
  patch.products = productsOf(cross(d, dx), cross(d, dy), perspective ? across : none);
  patch.squaredLength = squareOf(d, perspective ? dx : none, perspective ? dy : none);
  patch.worldPerLocal = scale * length(rays.worldDirection.base);
  return patch;
}
}
