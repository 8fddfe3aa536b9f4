// SPDX-License-Identifier: BSD-3-Clause
// Silhouettes of spheres that several processes share, played by threads.
#include "SharedSilhouettes.h"
#include "SilhouetteRims.h"
#include "SphereRenderer.h"
#include "TestViews.h"
#include "ThreadGroup.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

namespace
{
using namespace po;

/// Which process has a sphere.
using Owner = std::function<int(std::size_t)>;

constexpr std::size_t Count = 600;

/// Spheres of radii 0.5 to 1.5 in a box of 20, fixed seed.
SphereCloud heap()
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-10, 10), radius(0.5, 1.5);
  std::vector<Vec3d> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < Count; ++i)
  {
    const double x = place(random), y = place(random), z = place(random);
    centers.push_back({ x, y, z });
    radii.push_back(radius(random));
  }
  return makeSphereCloud(
    Count, [&](std::size_t i) { return centers[i]; }, [&](std::size_t i) { return radii[i]; });
}

/// What a process has traced of its own spheres, in the coordinates of all.
struct Part
{
  SphereRenderer renderer;

  Part(const Camera& camera, const std::function<bool(std::size_t)>& isOwn)
  {
    renderer.setCloud(heap());
    std::vector<std::uint8_t> hidden(renderer.cloud().spheres.size());
    for (std::size_t i = 0; i < hidden.size(); ++i)
    {
      hidden[i] = isOwn(i) ? 0 : 1;
    }
    renderer.setHidden(hidden);
    EXPECT_TRUE(renderer.trace(camera, Identity));
  }

  [[nodiscard]] TracedLayer layer() const
  {
    return { renderer.frame(), renderer.rays(), renderer.cloud().spheres };
  }
};

/// The lines of a group of processes at the first of them, and the bytes that all have sent.
struct Shared
{
  PlacedLines lines;
  std::vector<SharedBytes> bytes;
};

Shared shared(const Camera& camera, const SilhouetteRule& rule, int processes, const Owner& owner)
{
  Shared result;
  result.bytes.resize(static_cast<std::size_t>(processes));
  inParallel(processes,
    [&](const ProcessGroup& group)
    {
      const Part part(camera, [&](std::size_t i) { return owner(i) == group.rank(); });
      SharedSilhouettes silhouettes;
      silhouettes.find({ part.layer() }, camera, rule, group, 0, true);
      result.bytes[static_cast<std::size_t>(group.rank())] = silhouettes.bytes();
      if (group.rank() == 0)
      {
        result.lines = silhouettes.lines();
      }
      else
      {
        EXPECT_EQ(std::count_if(silhouettes.lines().image.strength.begin(),
                    silhouettes.lines().image.strength.end(), [](float s) { return s > 0; }),
          0);
      }
    });
  return result;
}

SilhouetteRule ruleOf(const SilhouetteParameters& parameters)
{
  return resolve(parameters, { 1, 20 });
}

/// The shared lines are those of one process: the same pixels, the same grey, the same fronts.
void expectLinesOfOne(
  const Camera& camera, const SilhouetteParameters& parameters, int processes, const Owner& owner)
{
  const Part whole(camera, [](std::size_t) { return true; });
  const TracedFrame& frame = whole.renderer.frame();
  SilhouetteImage one;
  findTracedSilhouettes(TracedDepth({ whole.layer() }), ruleOf(parameters), one, { true, true });
  const Shared all = shared(camera, ruleOf(parameters), processes, owner);
  ASSERT_EQ(all.lines.image.strength.size(), one.strength.size());
  std::size_t lines = 0, samePixels = 0;
  for (std::size_t i = 0; i < one.strength.size(); ++i)
  {
    ASSERT_NEAR(all.lines.image.strength[i], one.strength[i], 1.0 / 16383) << i;
    if (one.strength[i] > 0)
    {
      const auto front = static_cast<std::size_t>(all.lines.image.front[i]);
      ++lines;
      samePixels += all.lines.image.front[i] == one.front[i] ? 1 : 0;
      EXPECT_EQ(frame.sphere[front], frame.sphere[static_cast<std::size_t>(one.front[i])]);
      EXPECT_NEAR(
        all.lines.windowDepth[i], std::min(frame.windowDepth[front], frame.windowDepth[i]), 1e-6);
      if (!one.inside.empty())
      {
        EXPECT_NEAR(all.lines.image.inside[i], one.inside[i], 1.0 / 16383);
      }
    }
  }
  EXPECT_GT(lines, 500U);
  // Of several pixels that show the sphere in front, another one may be noted.
  EXPECT_GT(samePixels, 0.99 * static_cast<double>(lines));
}

const Owner Interleaved = [](std::size_t i) { return static_cast<int>(i % 3); };

Camera view(bool perspective, int width = 301, int height = 215)
{
  return lookAtOrigin(perspective, 50, 12, width, height, 1, 200);
}
}

TEST(SharedSilhouettes, AreThoseOfOneProcessHoweverSpheresAreDivided)
{
  const SphereCloud cloud = heap();
  const std::vector<Owner> owners{ Interleaved,
    [&](std::size_t i)
    { return std::clamp(static_cast<int>((cloud.toWorld(cloud.center(i)).x + 10) / 7), 0, 2); },
    [&](std::size_t i)
    { return std::clamp(static_cast<int>((cloud.toWorld(cloud.center(i)).z + 10) / 7), 0, 2); },
    [](std::size_t) { return 1; } };
  for (const bool perspective : { true, false })
  {
    for (const Owner& owner : owners)
    {
      expectLinesOfOne(view(perspective), {}, 3, owner);
    }
  }
}

TEST(SharedSilhouettes, HaveWidthAndGreyByJump)
{
  SilhouetteParameters parameters;
  parameters.greyByJump = true;
  parameters.widthByJump = true;
  parameters.maximumWidth = 5;
  for (const int samples : { 1, 4 })
  {
    parameters.samples = samples;
    expectLinesOfOne(view(true), parameters, 3, Interleaved);
  }
}

TEST(SharedSilhouettes, OfNarrowPicturesAndMoreProcessesThanRows)
{
  expectLinesOfOne(
    view(true, 400, 40), {}, 5, [](std::size_t i) { return static_cast<int>(i % 5); });
  expectLinesOfOne(view(true, 60, 300), {}, 3, Interleaved);
}

TEST(SharedSilhouettes, ReplaceThoseOfThePictureBefore)
{
  inParallel(2,
    [&](const ProcessGroup& group)
    {
      SharedSilhouettes kept, fresh;
      for (const int width : { 300, 300, 120 })
      {
        const Camera camera = lookAtOrigin(true, 40 + width, 12, width, 215, 1, 500);
        const Part part(
          camera, [&](std::size_t i) { return static_cast<int>(i % 2) == group.rank(); });
        const SilhouetteRule rule = ruleOf({});
        kept.find({ part.layer() }, camera, rule, group, -1, false);
        fresh = SharedSilhouettes();
        fresh.find({ part.layer() }, camera, rule, group, -1, false);
        EXPECT_EQ(kept.lines().image.strength, fresh.lines().image.strength);
        kept.find({}, camera, rule, group, -1, false);
        const auto& rows = kept.lines().image.tileRows;
        EXPECT_EQ(std::count(rows.begin(), rows.end(), 0), std::ptrdiff_t(rows.size()));
      }
    });
}

TEST(SharedSilhouettes, WhatAnotherProcessHidesIsNotSent)
{
  // A wall of spheres, and the heap far behind it.
  std::vector<Vec3d> wall;
  for (int j = -30; j <= 30; ++j)
  {
    for (int i = -30; i <= 30; ++i)
    {
      wall.push_back({ i * 0.9, j * 0.9, 20 });
    }
  }
  const Camera camera = view(false);
  std::vector<SharedBytes> bytes(2);
  inParallel(2,
    [&](const ProcessGroup& group)
    {
      SphereRenderer front;
      front.setCloud(makeSphereCloud(
        wall.size(), [&](std::size_t i) { return wall[i]; }, [](std::size_t) { return 1.0; }));
      EXPECT_TRUE(front.trace(camera, Identity));
      const Part behind(camera, [](std::size_t) { return true; });
      SilhouetteParameters parameters;
      parameters.threshold = 0.01;
      SharedSilhouettes silhouettes;
      silhouettes.find(
        { group.rank() == 0 ? TracedLayer{ front.frame(), front.rays(), front.cloud().spheres }
                            : behind.layer() },
        camera, ruleOf(parameters), group, 0, false);
      bytes[static_cast<std::size_t>(group.rank())] = silhouettes.bytes();
    });
  EXPECT_GT(bytes[0].depths, 1000U);
  EXPECT_EQ(bytes[1].depths, 0U);
}
