// SPDX-License-Identifier: BSD-3-Clause
#include "EyeDistance.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace po
{
WindowToEye makeWindowToEye(const Matrix4& inverseProjection)
{
  // With s = 1 - z the clip depth is 2 z - 1 = 1 - 2 s: substitute it into the third column.
  WindowToEye result{ inverseProjection, false };
  for (int row = 0; row < 4; ++row)
  {
    const double depthColumn = inverseProjection[4 * row + 2];
    result.matrix[4 * row + 2] = -2.0 * depthColumn;
    result.matrix[4 * row + 3] += depthColumn;
  }
  result.perspective = inverseProjection[4 * 3 + 2] != 0.0;
  return result;
}

double eyeDistance(const WindowToEye& windowToEye, double x, double y, double z)
{
  if (!(z < 1.0))
  {
    return std::numeric_limits<double>::infinity();
  }
  const auto& m = windowToEye.matrix;
  std::array<double, 4> eye{};
  for (int row = 0; row < 4; ++row)
  {
    eye[row] = m[4 * row] * x + m[4 * row + 1] * y + m[4 * row + 2] * (1.0 - z) + m[4 * row + 3];
  }
  // The eye looks along -z.
  return windowToEye.perspective
    ? std::sqrt(eye[0] * eye[0] + eye[1] * eye[1] + eye[2] * eye[2]) / std::abs(eye[3])
    : -eye[2] / eye[3];
}

void eyeDistances(const WindowToEye& windowToEye, const std::vector<float>& zBuffer, int width,
  int height, std::vector<float>& distances)
{
  distances.resize(zBuffer.size());
  tbb::parallel_for(tbb::blocked_range<int>(0, height),
    [&](const tbb::blocked_range<int>& rows)
    {
      const PixelRange pixels{ 0, rows.begin(), width, rows.end() };
      eyeDistances(windowToEye, zBuffer, width, height, pixels, distances);
    });
}

void eyeDistances(const WindowToEye& windowToEye, const std::vector<float>& zBuffer, int width,
  int height, const PixelRange& pixels, std::vector<float>& distances)
{
  for (int j = pixels.y0; j < pixels.y1; ++j)
  {
    const double y = pixelCenter(j, height);
    for (int i = pixels.x0; i < pixels.x1; ++i)
    {
      const std::size_t pixel = static_cast<std::size_t>(j) * width + i;
      distances[pixel] =
        static_cast<float>(eyeDistance(windowToEye, pixelCenter(i, width), y, zBuffer[pixel]));
    }
  }
}
}
