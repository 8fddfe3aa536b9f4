// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TestViews_h
#define po_TestViews_h

// Views with known matrices for tests of traced frames.
#include "FrameTracer.h"

namespace po
{
inline const Matrix4 Identity{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

/// OpenGL's frustum; the numbers are the edges of the near plane.
inline Matrix4 frustum(
  double left, double right, double bottom, double top, double zNear, double zFar)
{
  return { 2 * zNear / (right - left), 0, (right + left) / (right - left), 0, 0,
    2 * zNear / (top - bottom), (top + bottom) / (top - bottom), 0, 0, 0,
    -(zFar + zNear) / (zFar - zNear), -2 * zFar * zNear / (zFar - zNear), 0, 0, -1, 0 };
}

inline Matrix4 parallel(
  double left, double right, double bottom, double top, double zNear, double zFar)
{
  return { 2 / (right - left), 0, 0, -(right + left) / (right - left), 0, 2 / (top - bottom), 0,
    -(top + bottom) / (top - bottom), 0, 0, -2 / (zFar - zNear), -(zFar + zNear) / (zFar - zNear),
    0, 0, 0, 1 };
}

inline Matrix4 translation(double x, double y, double z)
{
  return { 1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1 };
}

/// An eye at (0, 0, distance) that looks at the origin; `half` is the half height seen there.
inline Camera lookAtOrigin(
  bool perspective, double distance, double half, int width, int height, double zNear, double zFar)
{
  const double aspect = static_cast<double>(width) / height;
  const double edge = perspective ? half * zNear / distance : half;
  const auto& projection = perspective ? frustum : parallel;
  return { translation(0, 0, -distance),
    projection(-edge * aspect, edge * aspect, -edge, edge, zNear, zFar), width, height };
}

inline std::size_t pixelAt(const TracedFrame& frame, int x, int y)
{
  return static_cast<std::size_t>(y) * frame.width + x;
}
}

#endif
