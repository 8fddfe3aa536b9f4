// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_FrontFinder_h
#define po_FrontFinder_h

#include "Camera.h"
#include "SphereScene.h"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace po
{
/// Where a ray enters a sphere.
struct Front
{
  double s = std::numeric_limits<double>::infinity(); ///< local length from the ray's origin
  std::uint32_t sphere = SphereScene::None;
  Vec3d normal; ///< local outward unit vector
};

/// Embree's context of a ray or packet for which some spheres do not count.
struct FrontQuery
{
  RayQueryContext embree;     ///< first, so that the filter can cast back
  const std::uint8_t* hidden; ///< of each sphere: not 0 if rays pass it; null: they pass none
  const Brick* brick;         ///< whose scene is traced
  /// Relative to the brick; only fronts between its nearest and farthest count; null: any hit.
  const PrimaryRay* ray;
};

/// For Embree: rejects what the query's rays pass.
void passSpheres(const RTCFilterFunctionNArguments* arguments);

/// Intersects the front of one sphere in double precision; the perpendicular form keeps its digits
/// for an origin far away. False if the ray misses, or the front lies before the near or behind the
/// far plane.
[[nodiscard]] bool intersectExactly(
  const PrimaryRay& ray, const Sphere& sphere, std::uint32_t id, Front& front);

/// The first front in one brick on the ray from s = start on, one ray at a time. Fronts before the
/// ray's nearest point are passed, and so are hidden spheres.
///
/// Embree looks in single precision; far from the start it may confuse neighbours. Then it looks
/// once more from close by.
/// @param brick its number in the scene's set
/// @param ray relative to the brick's origin
/// @param rays is increased by the number of Embree's rays
[[nodiscard]] Front findFront(const SphereScene& scene, std::size_t brick,
  const std::uint8_t* hidden, const PrimaryRay& ray, double start, std::size_t& rays);

/// A single-precision hit this many radii from its start may be out of order with its neighbours:
/// Embree's choice of the front may be wrong. 2^-24 * 4096 is some 1/4000 of a radius.
inline constexpr double ReliableRadii = 4096;
}

#endif
