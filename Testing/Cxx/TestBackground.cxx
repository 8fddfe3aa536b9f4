// SPDX-License-Identifier: BSD-3-Clause
#include "Background.h"

#include <gtest/gtest.h>

namespace
{
TEST(Background, UniformIsOneEverywhere)
{
  EXPECT_EQ(po::luminance(po::UniformBackground{}, { 0, 0, -1 }), 1);
}

TEST(Background, GradientIsLinearInHeightForAnyLengthOfUp)
{
  const po::GradientBackground gradient{ { 0, 10, 0 }, 0.25, 2 };
  EXPECT_DOUBLE_EQ(po::luminance(gradient, { 0, 1, 0 }), 2);
  EXPECT_DOUBLE_EQ(po::luminance(gradient, { 0, -1, 0 }), 0.25);
  EXPECT_DOUBLE_EQ(po::luminance(gradient, { 1, 0, 0 }), 1.125);
}

TEST(Background, ImageFollowsTheConventionOfTextures)
{
  // Two rows (+z, -z), four columns from +x towards +y; centres at odd multiples of 45 degrees.
  const po::ImageBackground image{ 4, 2, { 1, 2, 3, 4, 5, 6, 7, 8 } };
  EXPECT_NEAR(po::luminance(image, po::normalized(po::Vec3d{ 1, 1, 1.4142135623730951 })), 1, 1e-6);
  EXPECT_NEAR(
    po::luminance(image, po::normalized(po::Vec3d{ -1, 1, 1.4142135623730951 })), 2, 1e-6);
  EXPECT_NEAR(
    po::luminance(image, po::normalized(po::Vec3d{ 1, -1, -1.4142135623730951 })), 8, 1e-6);
  // On +x the first and last column meet, and the rows on the equator: (1 + 4 + 5 + 8) / 4.
  EXPECT_NEAR(po::luminance(image, { 1, 0, 0 }), 4.5, 1e-6);
}
}
