// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SurfaceRay_h
#define po_SurfaceRay_h

#include "Sphere.h"

#include <algorithm>
#include <optional>

namespace po
{
/// The longest start, in radii of the sphere.
constexpr float LongestRayStart = 1e-3f;

/// Where a ray from the surface of a sphere can begin (Embree's tnear) so that Embree, which
/// computes in floats, never reports that sphere; what is hit farther on, it reports. None if that
/// would be more than LongestRayStart, or the ray does not point out of the sphere.
///
/// Let v be the vector from the origin to the centre, q = -v.d > 0 and e = v.v - R^2. The sphere
/// ends at t = -q + sqrt(q^2 - e) <= max(0, -e) / (2 q). Embree finds the root by way of the
/// distance between ray and centre (kernels/geometry/sphere_intersector.h). With u = 2^-24, the
/// rounding of a float, it takes -q to 9 u q + 3 u |v|; -e, in the square root, to 8 u R^2; and the
/// root to 5.5 u q. The errors of q and e here are 3 u |v| and 4 u R^2. They add up to
///
///     t <= 25 u R + max(0, 12 u R^2 - e) / (2 (q - 3 u R)),
///
/// with or without fused operations, for any estimate of 1 / d.d that is as good as Embree's of
/// SSE. |v| is at most sqrt(2) R here: from farther away no ray outwards comes near the sphere.
/// v is a difference of the same floats in both places, so that how far these are from the origin
/// of coordinates counts by e alone.
///
/// @param own as Embree knows it
/// @param direction unit vector, but for rounding
[[nodiscard]] inline std::optional<float> rayStart(const Sphere& own, Vec3f origin, Vec3f direction)
{
  constexpr float SmallestRadius = 0x1p-50f; // its square still has all its bits
  const float radius = own.radius;
  const Vec3f toCenter = own.center() - origin;
  const float outwards = -dot(toCenter, direction) - 0x1p-22f * radius;
  const float depth = 0x1p-20f * (radius * radius) - (dot(toCenter, toCenter) - radius * radius);
  const float start = 0x1p-19f * radius + std::max(depth, 0.0f) / (2 * outwards);
  if (outwards > 0 && radius >= SmallestRadius && start <= LongestRayStart * radius)
  {
    return start;
  }
  return {};
}

/// An occlusion ray: from the surface of a sphere outwards.
struct SurfaceRay
{
  Vec3f origin;               ///< local, relative to the sphere's brick (see SphereSet)
  std::optional<float> start; ///< see rayStart()
  Vec3f direction;            ///< unit vector
};

[[nodiscard]] inline SurfaceRay makeSurfaceRay(const Sphere& own, Vec3f origin, Vec3f direction)
{
  return { origin, rayStart(own, origin, direction), direction };
}
}

#endif
