// SPDX-License-Identifier: BSD-3-Clause
// Silhouettes of z-buffers that several processes share, played by threads.
#include "DividedImage.h"
#include "SharedSilhouettes.h"
#include "ThreadGroup.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{
using namespace po;

constexpr int Width = 203, Height = 117; // no multiples of a tile
constexpr double Near = 1, Far = 200;

/// Of a frustum with half-width and half-height 1 at distance 1.
WindowToEye frustum()
{
  constexpr double Scale = 1 / (2 * Far * Near);
  return makeWindowToEye(
    { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, -1, 0, 0, (Near - Far) * Scale, (Near + Far) * Scale });
}

/// A tilted disc, in pixels of the picture.
struct Disc
{
  double x, y, radius;
  double depth, slope; ///< along the view direction, in world units and units a pixel

  [[nodiscard]] float zAt(double px, double py) const
  {
    const double dx = px - x, dy = py - y;
    const double at = depth + slope * dx;
    return dx * dx + dy * dy < radius * radius
      ? static_cast<float>(Far * (at - Near) / (at * (Far - Near)))
      : 1.0F;
  }
};

/// Small ones that cut each other, and a large one far behind, with a fixed seed.
std::vector<Disc> discs()
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> across(0, 1), depth(8, 12), slope(-0.3, 0.3);
  std::vector<Disc> all{ { 0.6 * Width, 0.5 * Height, 45, 90, 0.1 } };
  for (int i = 0; i < 40; ++i)
  {
    const double x = across(random) * 0.7 * Width, y = across(random) * Height;
    all.push_back({ x, y, 4 + 10 * across(random), depth(random), slope(random) });
  }
  return all;
}

/// Which process has a disc.
using Owner = std::function<int(std::size_t)>;

/// What a process draws.
std::vector<float> draw(int samples, const std::function<bool(std::size_t)>& isOwn)
{
  const std::vector<Disc> all = discs();
  std::vector<float> z(static_cast<std::size_t>(Width * samples) * Height * samples, 1.0F);
  for (std::size_t k = 0; k < all.size(); ++k)
  {
    for (std::size_t at = 0; isOwn(k) && at < z.size(); ++at)
    {
      const auto i = static_cast<int>(at) % (Width * samples);
      const auto j = static_cast<int>(at) / (Width * samples);
      z[at] = std::min(z[at], all[k].zAt((i + 0.5) / samples, (j + 0.5) / samples));
    }
  }
  return z;
}

ZBuffer bufferOf(std::vector<float>& z, int samples)
{
  return { z, Width * samples, Height * samples, samples, frustum() };
}

/// The lines of one process that has drawn all, and its nearest window depths.
struct Alone
{
  std::vector<float> z;
  SilhouetteImage lines;

  Alone(const SilhouetteParameters& parameters, const SilhouetteScale& scale)
    : z(draw(parameters.samples, [](std::size_t) { return true; }))
  {
    std::vector<float> distances;
    const ZBuffer buffer = bufferOf(z, parameters.samples);
    eyeDistances(frustum(), z, buffer.width, buffer.height, distances);
    const ImageDepth<float> depth(
      DepthImage<float>{ distances.data(), buffer.width, buffer.height }, parameters.samples);
    findSilhouettes(depth, resolve(parameters, scale), lines, { true, true });
  }
};

/// The shared lines are those of one process.
void expectLinesOfOne(const SilhouetteParameters& parameters, int processes, const Owner& owner)
{
  const SilhouetteScale scale{ 0, 50 };
  const Alone alone(parameters, scale);
  inParallel(processes,
    [&](const ProcessGroup& group)
    {
      std::vector<float> z =
        draw(parameters.samples, [&](std::size_t k) { return owner(k) == group.rank(); });
      std::vector<float> distances;
      DividedImage image(bufferOf(z, parameters.samples), distances);
      SharedSilhouettes silhouettes;
      silhouettes.find(image, resolve(parameters, scale), group, 0, true);
      if (group.rank() != 0)
      {
        return;
      }
      const PlacedLines& shared = silhouettes.lines();
      std::size_t lines = 0;
      for (std::size_t i = 0; i < alone.lines.strength.size(); ++i)
      {
        ASSERT_NEAR(shared.image.strength[i], alone.lines.strength[i], 1.0 / 16383) << i;
        if (alone.lines.strength[i] > 0)
        {
          ++lines;
          EXPECT_EQ(shared.image.front[i], alone.lines.front[i]);
          EXPECT_LT(shared.windowDepth[i], 1);
          if (!alone.lines.inside.empty())
          {
            EXPECT_NEAR(shared.image.inside[i], alone.lines.inside[i], 1.0 / 16383);
          }
        }
      }
      EXPECT_GT(lines, 500U);
    });
}

const Owner Interleaved = [](std::size_t k) { return static_cast<int>(k % 3); };
}

TEST(DividedImage, LinesAreThoseOfOneProcessHoweverThingsAreDivided)
{
  const std::vector<Owner> owners{ Interleaved, [](std::size_t k) { return k == 0 ? 2 : 0; },
    [](std::size_t) { return 1; } };
  for (const int samples : { 1, 4 })
  {
    SilhouetteParameters parameters;
    parameters.samples = samples;
    for (const Owner& owner : owners)
    {
      expectLinesOfOne(parameters, 3, owner);
    }
    parameters.greyByJump = parameters.widthByJump = true;
    parameters.maximumWidth = WidestLine;
    expectLinesOfOne(parameters, 2, [](std::size_t k) { return static_cast<int>(k % 2); });
    expectLinesOfOne(parameters, 9, [](std::size_t k) { return static_cast<int>(k % 9); });
  }
}

TEST(DividedImage, NobodyHasAnything)
{
  inParallel(2,
    [](const ProcessGroup& group)
    {
      std::vector<float> z = draw(2, [](std::size_t) { return false; }), distances;
      DividedImage image(bufferOf(z, 2), distances);
      EXPECT_EQ(SharedSilhouettes().depthSpread(image, group), 0);
      SilhouetteParameters parameters;
      parameters.samples = 2;
      SharedSilhouettes silhouettes;
      silhouettes.find(image, resolve(parameters, { 0, 1 }), group, 0, false);
      EXPECT_EQ(silhouettes.bytes().all(), 0U);
      EXPECT_EQ(*std::max_element(silhouettes.lines().image.strength.begin(),
                  silhouettes.lines().image.strength.end()),
        0);
    });
}

TEST(DividedImage, WindowDepthIsThatOfTheNearestSampleOfAll)
{
  constexpr int Samples = 2;
  const std::vector<float> all = draw(Samples, [](std::size_t) { return true; });
  inParallel(2,
    [&](const ProcessGroup& group)
    {
      std::vector<float> distances,
        z = draw(Samples, [&](std::size_t k) { return static_cast<int>(k % 2) == group.rank(); });
      DividedImage image(bufferOf(z, Samples), distances);
      SilhouetteParameters parameters;
      parameters.samples = Samples;
      SharedSilhouettes silhouettes;
      silhouettes.find(image, resolve(parameters, { 0, 50 }), group, 0, true);
      const PlacedLines& lines = silhouettes.lines();
      for (int pixel = 0; group.rank() == 0 && pixel < Width * Height; ++pixel)
      {
        if (lines.image.strength[static_cast<std::size_t>(pixel)] > 0)
        {
          float nearest = 1;
          for (const int at : { pixel, lines.image.front[static_cast<std::size_t>(pixel)] })
          {
            for (int k = 0; k < Samples * Samples; ++k)
            {
              const int i = at % Width * Samples + k % Samples;
              const int j = at / Width * Samples + k / Samples;
              nearest = std::min(nearest, all[static_cast<std::size_t>(j * Width * Samples + i)]);
            }
          }
          EXPECT_NEAR(lines.windowDepth[static_cast<std::size_t>(pixel)], nearest, 1e-6) << pixel;
        }
      }
    });
}

TEST(DividedImage, SpreadOfDepthsIsThatOfOneProcess)
{
  std::vector<float> all = draw(1, [](std::size_t) { return true; }), room;
  const double alone = depthSpread(DividedImage(bufferOf(all, 1), room).ownRanges());
  EXPECT_GT(alone, 70);
  inParallel(3,
    [&](const ProcessGroup& group)
    {
      std::vector<float> distances,
        z = draw(1, [&](std::size_t k) { return Interleaved(k) == group.rank(); });
      DividedImage image(bufferOf(z, 1), distances);
      EXPECT_NEAR(SharedSilhouettes().depthSpread(image, group), alone, 1e-12 * alone);
    });
}
