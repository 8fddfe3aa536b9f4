// SPDX-License-Identifier: BSD-3-Clause
#include "EyeDistance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
/// Inverse of the OpenGL frustum matrix with half-width and half-height 1 at distance 1.
po::Matrix4 inverseFrustum(double near, double far)
{
  const double scale = 1.0 / (2.0 * far * near);
  return { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, -1, 0, 0, (near - far) * scale, (near + far) * scale };
}

/// Inverse of the OpenGL orthographic matrix with half-width and half-height 1.
po::Matrix4 inverseOrthographic(double near, double far)
{
  return { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, (near - far) / 2.0, -(near + far) / 2.0, 0, 0, 0, 1 };
}

/// z in the z-buffer at distance `depth` along the view direction.
double zOfFrustum(double near, double far, double depth)
{
  return far * (depth - near) / (depth * (far - near));
}
}

TEST(EyeDistance, PerspectiveIsTheLengthOfTheRay)
{
  for (const double scale : { 1e-9, 1.0, 1e22 })
  {
    const double near = 0.5 * scale;
    const double far = 200.0 * scale;
    const auto matrix = po::makeWindowToEye(inverseFrustum(near, far));
    ASSERT_TRUE(matrix.perspective);
    for (const double depth : { 0.5, 1.0, 7.0, 150.0 })
    {
      const double z = zOfFrustum(near, far, depth * scale);
      for (const double x : { -1.0, 0.0, 0.3 })
      {
        const double expected = depth * scale * std::sqrt(1.0 + x * x + 0.25);
        EXPECT_NEAR(po::eyeDistance(matrix, x, 0.5, z), expected, 1e-12 * expected);
      }
    }
  }
}

TEST(EyeDistance, ParallelIsTheDistanceAlongTheView)
{
  const auto matrix = po::makeWindowToEye(inverseOrthographic(2.0, 12.0));
  ASSERT_FALSE(matrix.perspective);
  for (const double z : { 0.0, 0.25, 0.999 })
  {
    EXPECT_NEAR(po::eyeDistance(matrix, 0.9, -0.7, z), 2.0 + 10.0 * z, 1e-12);
  }
}

TEST(EyeDistance, BackgroundIsInfinite)
{
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& inverse : { inverseFrustum(1.0, 10.0), inverseOrthographic(1.0, 10.0) })
  {
    const auto matrix = po::makeWindowToEye(inverse);
    EXPECT_EQ(po::eyeDistance(matrix, 0.1, 0.2, 1.0), infinity);
    EXPECT_EQ(po::eyeDistance(matrix, 0.1, 0.2, nan), infinity);
  }
}

TEST(EyeDistance, PixelCentres)
{
  EXPECT_DOUBLE_EQ(po::pixelCenter(0, 1), 0.0);
  EXPECT_DOUBLE_EQ(po::pixelCenter(0, 4), -0.75);
  EXPECT_DOUBLE_EQ(po::pixelCenter(3, 4), 0.75);
}
