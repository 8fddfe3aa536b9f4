// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RimGeometry_h
#define po_RimGeometry_h

#include "Camera.h"
#include "Sphere.h"

/// Where the rims of spheres lie in a small part of a picture.
namespace po
{
/// c + x X + y Y + xx X^2 + xy X Y + yy Y^2.
struct Quadratic
{
  float c, x, y, xx, xy, yy;
};

/// The rays of a tile, as functions of the offset in pixels from the middle of the tile.
struct RayPatch
{
  RayPencil rays;
  double scale;            ///< 1 / length of the direction in the middle
  Quadratic squaredLength; ///< of a direction, 1 in the middle
};

[[nodiscard]] RayPatch makeRayPatch(const RayPencil& rays);

/// |m|^2 over the squared radius of a sphere. The ray at (x, y) from the middle of a patch has the
/// distance h = |m| / |d| from the sphere's centre, with m = (centre - origin) x d linear in (x,
/// y): in perspective all rays have one origin, in parallel projection one direction.
[[nodiscard]] Quadratic squaredMoment(const RayPatch& patch, const Sphere& sphere);

/// Depth at which rays touch a sphere, in world units: the same along all of its rim.
[[nodiscard]] double rimDepth(const RayPatch& patch, const Sphere& sphere);
}

#endif
