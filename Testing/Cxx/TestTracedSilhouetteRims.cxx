// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouettePixels.h"
#include "TracedSilhouetteTestScene.h"

#include <cmath>

using namespace traced_silhouettes;

/// One sphere, or one before another: position, width and grey against the filter of 8 x 8 traced
/// samples a pixel, and of that against 64 x 64 points in TestSilhouettes.
TEST(TracedSilhouettes, AntialiasedRimsAreWithinATenthOfAPixelOfSupersampling)
{
  const std::vector<std::vector<std::array<double, 4>>> scenes{ { { 0.3, -0.2, 0, 6 } },
    { { 0.1, 0.3, 0, 0.6 } }, { { -2, 0.5, 4, 3 }, { 2, -0.4, -9, 6 } } };
  for (const bool perspective : { true, false })
  {
    const Camera camera = lookAtOrigin(perspective, 30, 9, 120, 90, 1, 200);
    for (const auto& spheres : scenes)
    {
      for (const double width : { 1.0, 2.5 })
      {
        SilhouetteParameters parameters = threshold(6, 8);
        parameters.width = width;
        const auto ours = Traced(spheres, camera).lines(parameters).strength;
        const auto truth = filtered(spheres, camera, parameters);
        double area = 0, trueArea = 0, square = 0;
        std::array<double, 2> middle{}, trueMiddle{};
        for (std::size_t pixel = 0; pixel < ours.size(); ++pixel)
        {
          const double x = static_cast<double>(pixel % 120), y = static_cast<double>(pixel / 120);
          area += ours[pixel];
          trueArea += truth[pixel];
          middle[0] += x * ours[pixel];
          middle[1] += y * ours[pixel];
          trueMiddle[0] += x * truth[pixel];
          trueMiddle[1] += y * truth[pixel];
          square += std::pow(ours[pixel] - truth[pixel], 2);
        }
        EXPECT_NEAR(middle[0] / area, trueMiddle[0] / trueArea, 0.1);
        EXPECT_NEAR(middle[1] / area, trueMiddle[1] / trueArea, 0.1);
        EXPECT_NEAR(area / trueArea * width, width, 0.1) << spheres.size() << ' ' << width;
        EXPECT_LT(std::sqrt(square / trueArea), 0.1) << spheres.size() << ' ' << width;
      }
    }
  }
}

/// A line takes part of a pixel and the sphere another, of a pixel that shows what is behind:
/// shares against 8 x 8 rays a pixel.
TEST(TracedSilhouettes, WhatLiesWithinARimIsKnown)
{
  const Camera camera = lookAtOrigin(true, 30, 9, 120, 90, 1, 200);
  const std::vector<std::array<double, 4>> spheres{ { 0.3, -0.2, 0, 6 } };
  const Traced traced(spheres, camera);
  const SilhouetteImage lines = traced.lines(threshold(6, 8), { true, true });
  ASSERT_EQ(lines.inside.size(), lines.strength.size());
  EXPECT_TRUE(traced.lines(threshold(6, 1), { true, true }).inside.empty());

  Camera fine = camera;
  fine.width *= 8;
  fine.height *= 8;
  const Traced samples(spheres, fine);
  int rims = 0;
  for (int pixel = 0; pixel < camera.width * camera.height; ++pixel)
  {
    const auto at = static_cast<std::size_t>(pixel);
    if (!(lines.strength[at] > 0))
    {
      continue;
    }
    int hits = 0;
    for (int sample = 0; sample < 64; ++sample)
    {
      const int x = pixel % camera.width * 8 + sample % 8,
                y = pixel / camera.width * 8 + sample / 8;
      hits += samples.layer().frame.sphere[static_cast<std::size_t>(y) * fine.width + x] !=
        SphereScene::None;
    }
    const bool isInside = traced.layer().frame.sphere[at] != SphereScene::None;
    EXPECT_NEAR(lines.inside[at], isInside ? 0 : hits / 64.0, 1 / 16.0);
    rims += lines.inside[at] > 0.1F;
  }
  EXPECT_GT(rims, 30);
}

namespace
{
/// A red sphere on white, and the pixels of its black lines: no white is left where the line and
/// the sphere cover all of a pixel.
void expectNoWhiteAtRims(const TracedFrame& frame, const SilhouetteImage& lines)
{
  std::vector<std::uint8_t> picture(4 * frame.pixels(), 255);
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel)
  {
    const bool isSphere = frame.sphere[pixel] != SphereScene::None;
    picture[4 * pixel + 1] = picture[4 * pixel + 2] = isSphere ? 0 : 255;
  }
  SilhouettePixels pixels;
  colorSilhouettes(lines, SilhouetteStyle(), { picture.data(), nullptr }, pixels);
  int rims = 0;
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel)
  {
    if (lines.strength[pixel] > 0 && lines.inside[pixel] > 0)
    {
      const std::uint8_t* line = &pixels.rgba[4 * pixel];
      EXPECT_GE(line[3], 254);
      EXPECT_NEAR(line[0], 255 * lines.inside[pixel], 2); // red, and black
      EXPECT_EQ(line[1], 0);
      ++rims;
    }
  }
  EXPECT_GT(rims, 50);
}
}

TEST(TracedSilhouettes, BackgroundDoesNotShineThroughBetweenSphereAndLine)
{
  const std::vector<std::array<double, 4>> sphere{ { 0.3, -0.2, 0, 6 } };
  Camera camera = lookAtOrigin(true, 30, 9, 120, 90, 1, 200);
  const Traced traced(sphere, camera);
  SilhouetteParameters parameters = threshold(6, 4);
  parameters.width = 1.5; // no pixel on a rim reaches beyond the line
  expectNoWhiteAtRims(traced.renderer.frame(), traced.lines(parameters, { true, true }));
  // Of a depth image likewise, as of meshes.
  camera.width *= parameters.samples;
  camera.height *= parameters.samples;
  const Traced fine(sphere, camera);
  const TracedFrame& samples = fine.renderer.frame();
  const ImageDepth<double> source(
    DepthImage<double>{ samples.t.data(), samples.width, samples.height }, parameters.samples);
  SilhouetteImage lines;
  findSilhouettes(
    source, resolve(parameters, { fine.renderer.cloud().scale, 20 }), lines, { true, true });
  expectNoWhiteAtRims(traced.renderer.frame(), lines);
}

namespace
{
/// A sphere before another one, which covers half of what is behind its rim, and before a large one
/// far behind.
constexpr double FrontRadius = 3, FrontZ = 4;
const std::vector<std::array<double, 4>> BeforeTwo{ { 0, 0, FrontZ, FrontRadius },
  { 2.5, 0.3, -9, 2.8 }, { 0, 0, -60, 40 } };

SilhouetteParameters byJump(bool grey)
{
  SilhouetteParameters parameters = threshold(3, 4);
  parameters.greyByJump = grey;
  parameters.jumpFrom = 4;
  parameters.jumpTo = 60;
  return parameters;
}

/// The largest jump from the front sphere's rim to the edges at a pixel or around it; 0: none.
double largestJumpAround(
  const TracedFrame& frame, const LinePixels<float>& edges, double rim, int x, int y)
{
  double largest = 0;
  for (int j = y - 1; j <= y + 1; ++j)
  {
    for (int i = x - 1; i <= x + 1; ++i)
    {
      const std::size_t at = pixelAt(frame, i, j);
      largest =
        edges[at] > 0 && frame.sphere[at] != 0 ? std::max(largest, frame.t[at] - rim) : largest;
    }
  }
  return largest;
}

/// Do pixels around one show both of the spheres behind?
bool bordersOnBoth(const TracedFrame& frame, int x, int y)
{
  bool second = false, third = false;
  for (int k = 0; k < 9; ++k)
  {
    const std::uint32_t sphere = frame.sphere[pixelAt(frame, x + k % 3 - 1, y + k / 3 - 1)];
    second = second || sphere == 1;
    third = third || sphere == 2;
  }
  return second && third;
}
}

/// Where one rim borders on two jumps, a pixel that shows the sphere in front takes the larger one;
/// a pixel that shows what is behind takes its own.
TEST(TracedSilhouettes, OfTwoJumpsAtARimTheLargerCountsInFront)
{
  constexpr int distance = 50;
  const Traced traced(BeforeTwo, lookAtOrigin(false, distance, 9, 240, 180, 1, 200));
  const TracedFrame& frame = traced.renderer.frame();
  const auto edges = traced.lines(threshold(3, 1)).strength;
  const auto plain = traced.lines(byJump(false)).strength,
             grey = traced.lines(byJump(true)).strength;
  const double rim = distance - FrontZ;
  const JumpRamp ramp{ 4, 60 };
  int inFront = 0, behind = 0, both = 0;
  for (int y = 2; y < frame.height - 2; ++y)
  {
    for (int x = 2; x < frame.width - 2; ++x)
    {
      const std::size_t at = pixelAt(frame, x, y);
      // Of what is behind, pixels at the left, where no other rim is near.
      const bool isFront = frame.sphere[at] == 0, isLeft = x < 110;
      const double around = largestJumpAround(frame, edges, rim, x, y);
      if (plain[at] < 0.05F || around == 0 || (!isFront && !isLeft))
      {
        continue;
      }
      const double jump = isFront ? around : frame.t[at] - rim;
      // Another of the edges around may tell how far the rim is.
      const double expected = plain[at] * ramp.at(static_cast<float>(jump));
      EXPECT_NEAR(grey[at], expected, 3e-3) << x << ", " << y;
      inFront += isFront && jump > 0;
      behind += !isFront;
      both += isFront && bordersOnBoth(frame, x, y);
    }
  }
  EXPECT_GT(inFront, 50);
  EXPECT_GT(behind, 30);
  EXPECT_GE(both, 2); // where the second sphere's rim meets that of the first
}

/// Grey that follows the jump, and its sum, against the filter of 8 x 8 traced samples a pixel.
TEST(TracedSilhouettes, GreyByJumpIsThatOfSupersampling)
{
  for (const bool perspective : { true, false })
  {
    const Camera camera = lookAtOrigin(perspective, 50, 9, 240, 180, 1, 200);
    SilhouetteParameters parameters = byJump(true);
    parameters.samples = 8;
    const auto ours = Traced(BeforeTwo, camera).lines(parameters).strength;
    const auto truth = filtered(BeforeTwo, camera, parameters);
    double sum = 0, trueSum = 0, square = 0;
    for (std::size_t pixel = 0; pixel < ours.size(); ++pixel)
    {
      sum += ours[pixel];
      trueSum += truth[pixel];
      square += std::pow(ours[pixel] - truth[pixel], 2);
    }
    // Samples measure from beside the rim, 4 % more of these jumps than from the rim itself.
    EXPECT_NEAR(sum / trueSum, 1, 0.1);
    EXPECT_LT(std::sqrt(square / static_cast<double>(count(truth))), 0.02);
  }
}

/// Rings around particles of radii from 0.7 to 15 pixels, in a wide view and obliquely, against the
/// filter of 8 x 8 traced samples a pixel.
TEST(TracedSilhouettes, RingsOfSmallParticlesAreThoseOfSupersampling)
{
  std::vector<std::array<double, 4>> spheres;
  for (int k = 0; k < 30; ++k)
  {
    // In six columns and five rows, none before another.
    const double radius = 0.07 + 1.43 * k / 29.0;
    spheres.push_back(
      { 3.3 * (k % 6 - 2.5) + 0.013 * k, 3.4 * (k / 6 - 2) + 0.017 * k, 0, radius });
  }
  for (const bool perspective : { true, false })
  {
    for (const double width : { 1.0, 3.0 })
    {
      // Ten pixels a unit in the middle.
      const Camera camera = lookAtOrigin(perspective, 24, 9, 240, 180, 1, 200);
      SilhouetteParameters parameters = threshold(6, 8);
      parameters.width = width;
      const auto ours = Traced(spheres, camera).lines(parameters).strength;
      const auto truth = filtered(spheres, camera, parameters);
      double area = 0, trueArea = 0, square = 0;
      for (std::size_t pixel = 0; pixel < ours.size(); ++pixel)
      {
        area += ours[pixel];
        trueArea += truth[pixel];
        square += std::pow(ours[pixel] - truth[pixel], 2);
      }
      EXPECT_NEAR(area / trueArea * width, width, 0.1) << perspective;
      EXPECT_LT(std::sqrt(square / trueArea), 0.1) << perspective << ' ' << width;
    }
  }
}

/// Of the edges beside a pixel only some are asked how far the rim is, but where lines follow
/// jumps all are: with jumps that make no difference the lines are the same.
TEST(TracedSilhouettes, NoPixelOfALineIsLeftOut)
{
  const Traced traced(heap(), lookAtOrigin(true, 50, 12, 301, 215, 1, 200));
  for (const double width : { 1.0, 3.0, 8.0 })
  {
    SilhouetteParameters parameters = threshold(3, 4);
    parameters.width = width;
    const auto some = traced.lines(parameters).strength;
    parameters.greyByJump = true;
    parameters.jumpFrom = 1e-7;
    parameters.jumpTo = 1e-6;
    const auto all = traced.lines(parameters).strength;
    double square = 0;
    for (std::size_t pixel = 0; pixel < all.size(); ++pixel)
    {
      // They tell distances from the circles that touch the rim at each of them.
      EXPECT_NEAR(some[pixel], all[pixel], width > 3 ? 0.35 : 0.1) << width;
      square += std::pow(some[pixel] - all[pixel], 2);
    }
    EXPECT_LT(std::sqrt(square / static_cast<double>(count(all))), 0.02) << width;
  }
}
