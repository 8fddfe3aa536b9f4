// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TriangleDistance_h
#define po_TriangleDistance_h

#include "Vec3.h"

#include <algorithm>
#include <cmath>

namespace po
{
/// The point of the segment from a to b that is nearest to p.
[[nodiscard]] inline Vec3f nearestOnSegment(Vec3f p, Vec3f a, Vec3f b)
{
  const Vec3f edge = b - a;
  const float square = dot(edge, edge);
  const float t = square > 0 ? std::clamp(dot(p - a, edge) / square, 0.0f, 1.0f) : 0.0f;
  return a + t * edge;
}

/// Distance from a point to a triangle, which may be degenerate.
[[nodiscard]] inline float triangleDistance(Vec3f p, Vec3f a, Vec3f b, Vec3f c)
{
  const Vec3f normal = cross(b - a, c - a);
  const bool aboveInside = dot(cross(b - a, p - a), normal) > 0 &&
    dot(cross(c - b, p - b), normal) > 0 && dot(cross(a - c, p - c), normal) > 0;
  if (aboveInside)
  {
    return std::abs(dot(p - a, normal)) / length(normal);
  }
  return std::min({ length(p - nearestOnSegment(p, a, b)), length(p - nearestOnSegment(p, b, c)),
    length(p - nearestOnSegment(p, c, a)) });
}
}

#endif
