// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RimGeometry_h
#define po_RimGeometry_h

#include "Camera.h"

#include <array>

/// Where the rims of spheres lie in a small part of a picture.
namespace po
{
/// c + x X + y Y + xx X^2 + xy X Y + yy Y^2.
struct Quadratic
{
  float c, x, y, xx, xy, yy;
};

/// The rays around one place of a picture: at the offset (X, Y) in pixels from it they have the
/// direction d = d0 + X dx + Y dy and, in parallel projection, origins that move with it.
///
/// A ray has the distance h = |m| / |d| from the centre c of a sphere, with m = (c - origin) x d.
/// In perspective, with c - origin = w d0 + u dx + v dy,
///   m = (w X - u) d0 x dx + (w Y - v) d0 x dy + (u Y - v X) dx x dy:
/// d is d0 + X dx + Y dy too, so that only these three numbers are needed of a sphere. In parallel
/// projection dx and dy are what the origin moves by, w is 1, and the last term is none.
struct RayPatch
{
  bool perspective;
  Vec3d origin;                  ///< of the ray in the middle
  Vec3d depth, column, row;      ///< dot products with c - origin: w, u, v (w too if parallel)
  std::array<float, 6> products; ///< of the three vectors above: 11, 12, 22, 13, 23, 33
  Quadratic squaredLength;       ///< of a direction, 1 in the middle
  double worldPerLocal;          ///< of lengths along rays
};

[[nodiscard]] RayPatch makeRayPatch(const RayPencil& rays);
}

#endif
