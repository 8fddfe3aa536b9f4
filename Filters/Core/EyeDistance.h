// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_EyeDistance_h
#define po_EyeDistance_h

#include "Camera.h"
#include "Matrix4.h"

#include <vector>

/// From OpenGL's z-buffer to distance in world units.
namespace po
{
/// Takes (x, y, 1 - z, 1) to homogeneous eye coordinates: x and y in [-1, 1] across the viewport,
/// z in [0, 1] as the z-buffer has it.
struct WindowToEye
{
  Matrix4 matrix;
  /// Rays meet in the eye; otherwise they are parallel.
  bool perspective;
};

/// From the inverse of the OpenGL projection (eye to clip coordinates, depth range [-1, 1]).
///
/// The matrix works on 1 - z and not on z: far away, z is close to 1 and 1 - z is exact, so that
/// nothing cancels, even in single precision.
[[nodiscard]] WindowToEye makeWindowToEye(const Matrix4& inverseProjection);

/// Distance along the normalised eye ray (perspective) or along the view direction (parallel);
/// +infinity for background (z >= 1) and for NaN.
[[nodiscard]] double eyeDistance(const WindowToEye& windowToEye, double x, double y, double z);

/// The distances of all pixels of a z-buffer, row by row from the bottom, in parallel.
void eyeDistances(const WindowToEye& windowToEye, const std::vector<float>& zBuffer, int width,
  int height, std::vector<float>& distances);

/// Those of some pixels, on this thread; `distances` has the size of the z-buffer.
void eyeDistances(const WindowToEye& windowToEye, const std::vector<float>& zBuffer, int width,
  int height, const PixelRange& pixels, std::vector<float>& distances);

/// Centre of pixel i of `count` pixels, in [-1, 1].
[[nodiscard]] inline double pixelCenter(int i, int count)
{
  return (2.0 * i + 1.0) / count - 1.0;
}
}

#endif
