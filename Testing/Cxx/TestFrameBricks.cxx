// SPDX-License-Identifier: BSD-3-Clause
/// Frames of sets in bricks against those of the same spheres in one.

#include "FrameTracer.h"
#include "Shading.h"
#include "TestViews.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace
{
using namespace po;

/// Three loose clusters, one behind the other and 12000 apart, on places that floats tell exactly
/// whatever the origin.
std::vector<Sphere> clusters()
{
  std::mt19937 random(11);
  std::uniform_int_distribution<int> place(-5 * 64, 5 * 64), size(20, 50);
  std::vector<Sphere> spheres;
  for (int i = 0; i < 75; ++i)
  {
    const auto coordinate = [&] { return static_cast<float>(place(random)) / 64; };
    spheres.push_back({ coordinate(), coordinate(),
      coordinate() - 12000 * static_cast<float>(i % 3), static_cast<float>(size(random)) / 64 });
  }
  return spheres;
}

SphereSet inBricks(const std::vector<Sphere>& spheres)
{
  std::vector<Vec3d> centers;
  for (const Sphere& s : spheres)
  {
    centers.push_back(s.center().as<double>());
  }
  return SphereSet(spheres, centers);
}

class FrameOfBricks : public testing::TestWithParam<bool>
{
protected:
  FrameOfBricks()
  {
    for (std::size_t i = 0; GetParam() && i < spheres_.size(); ++i)
    {
      hidden_.push_back(i % 5 == 0 ? 1 : 0);
    }
    settings_.hidden = hidden_.empty() ? nullptr : hidden_.data();
  }

  /// Parallel, so that all clusters are as large in the window.
  const PrimaryRays rays_ =
    *PrimaryRays::make(lookAtOrigin(false, 100, 6, 200, 200, 1, 40000), Identity);
  const std::vector<Sphere> spheres_ = clusters();
  const SphereScene whole_{ spheres_ };
  const SphereScene bricks_{ inBricks(spheres_) };
  std::vector<std::uint8_t> hidden_;
  FrameSettings settings_;
};

void expectEqual(const TracedFrame& frame, const TracedFrame& expected)
{
  ASSERT_EQ(frame.pixels(), expected.pixels());
  EXPECT_EQ(frame.sphere, expected.sphere);
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel)
  {
    if (expected.sphere[pixel] != SphereScene::None)
    {
      ASSERT_NEAR(frame.t[pixel], expected.t[pixel], 1e-8) << pixel;
      ASSERT_NEAR(frame.windowDepth[pixel], expected.windowDepth[pixel], 1e-6) << pixel;
      ASSERT_LT(length(frame.normal[pixel] - expected.normal[pixel]), 1e-4f) << pixel;
    }
  }
}

TEST_P(FrameOfBricks, ShowsTheNearestOfAll)
{
  ASSERT_GE(bricks_.set().bricks().size(), 3u);
  TracedFrame frame, expected;
  const TraceCounters counters = traceFrame(bricks_, rays_, settings_, frame);
  const TraceCounters all = traceFrame(whole_, rays_, settings_, expected);
  expectEqual(frame, expected);
  EXPECT_EQ(counters.hits, all.hits);
  EXPECT_EQ(counters.tiles, all.tiles);
  std::array<std::size_t, 3> seen{};
  for (const std::uint32_t id : frame.sphere)
  {
    seen[id % 3] += id != SphereScene::None;
    EXPECT_FALSE(id != SphereScene::None && GetParam() && hidden_[id] != 0);
  }
  EXPECT_GT(*std::min_element(seen.begin(), seen.end()), 1000u);
}

TEST_P(FrameOfBricks, ShowsWhatIsBehind)
{
  TracedFrame first, second, expectedFirst, expected;
  (void)traceFrame(bricks_, rays_, settings_, first);
  (void)traceFrame(whole_, rays_, settings_, expectedFirst);
  const std::vector<std::uint8_t> wanted(first.pixels(), 1);
  const TraceCounters counters = traceBehind(bricks_, rays_, settings_, first, wanted, second);
  const TraceCounters all = traceBehind(whole_, rays_, settings_, expectedFirst, wanted, expected);
  expectEqual(second, expected);
  EXPECT_EQ(counters.hits, all.hits);
  EXPECT_GT(counters.hits, 2000u);
}

TEST_P(FrameOfBricks, CastsShadowsFromBrickToBrick)
{
  TracedFrame frame;
  (void)traceFrame(bricks_, rays_, settings_, frame);
  Light light;
  light.positional = false;
  light.direction = { 1e-4, 0, -1 };
  std::vector<std::uint8_t> lit, expected;
  (void)traceShadows(bricks_, settings_.hidden, rays_, frame, light, lit);
  (void)traceShadows(whole_, settings_.hidden, rays_, frame, light, expected);
  std::size_t different = 0, dark = 0;
  for (std::size_t pixel = 0; pixel < lit.size(); ++pixel)
  {
    different += lit[pixel] != expected[pixel];
    dark += frame.sphere[pixel] != SphereScene::None && frame.sphere[pixel] % 3 != 0 &&
      expected[pixel] == 0;
  }
  // In one brick rays start where floats put them, up to 1/1000 off.
  EXPECT_LT(different, 40u);
  EXPECT_GT(dark, 1000u);
}

INSTANTIATE_TEST_SUITE_P(Bricks, FrameOfBricks, testing::Bool(),
  [](const testing::TestParamInfo<bool>& info) { return info.param ? "SomeHidden" : "AllShown"; });
}
