// SPDX-License-Identifier: BSD-3-Clause
#include "FrameTracer.h"
#include "Shading.h"
#include "TestViews.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace
{
using namespace po;

constexpr double Infinity = std::numeric_limits<double>::infinity();
std::vector<Sphere> randomSpheres(std::size_t count, double extent)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<float> position(-extent, extent), radius(0.3f, 1.0f);
  std::vector<Sphere> spheres(count);
  for (Sphere& s : spheres)
  {
    s = { position(random), position(random), position(random), radius(random) };
  }
  return spheres;
}

/// The nearest front in double precision, by trying all spheres.
double nearestFront(const std::vector<Sphere>& spheres, Vec3d origin, Vec3d direction, double zNear)
{
  double best = Infinity;
  for (const Sphere& s : spheres)
  {
    const Vec3d oc = origin - s.center().as<double>();
    const double b = dot(oc, direction);
    const Vec3d foot = oc - b * direction;
    const double squared = double(s.radius) * s.radius - dot(foot, foot);
    const double t = -b - std::sqrt(std::max(squared, 0.0));
    if (squared >= 0 && t >= zNear)
    {
      best = std::min(best, t);
    }
  }
  return best;
}

struct Shot
{
  TracedFrame frame;
  TraceCounters counters;
};

Shot shoot(const std::vector<Sphere>& spheres, const PrimaryRays& rays)
{
  Shot shot;
  shot.counters = traceFrame(SphereScene(spheres), rays, {}, shot.frame);
  return shot;
}

struct Projection
{
  bool perspective;
  double distance;
};

class FrameOfOneSphere : public testing::TestWithParam<Projection>
{
};

TEST_P(FrameOfOneSphere, DepthAndHitPointAreThoseOfTheAnalyticSphere)
{
  const auto [perspective, distance] = GetParam();
  const Camera camera =
    lookAtOrigin(perspective, distance, 1.2, 65, 47, distance - 2, distance + 2);
  const PrimaryRays rays = *PrimaryRays::make(camera, Identity);
  const TracedFrame frame = shoot({ { 0, 0, 0, 1 } }, rays).frame;
  int hits = 0;
  for (int y = 0; y < 47; ++y)
  {
    for (int x = 0; x < 65; ++x)
    {
      // Independent of the tracer: where the pixel's centre lies on the plane z = 0.
      const Vec3d seen{ 1.2 * 65 / 47 * (2 * (x + 0.5) / 65 - 1), 1.2 * (2 * (y + 0.5) / 47 - 1),
        0 };
      const Vec3d eye = perspective ? Vec3d{ 0, 0, distance } : Vec3d{ seen.x, seen.y, distance };
      const Vec3d direction = normalized(seen - eye);
      const double expected = nearestFront({ { 0, 0, 0, 1 } }, eye, direction, 0);
      const std::size_t pixel = pixelAt(frame, x, y);
      const double radial = length(Vec3d{ seen.x, seen.y, 0 });
      if (std::abs(radial - 1) < 1e-5)
      {
        continue; // the silhouette itself: either answer is right
      }
      ASSERT_EQ(std::isinf(frame.t[pixel]), std::isinf(expected)) << x << ' ' << y;
      ASSERT_EQ(frame.sphere[pixel] == SphereScene::None, std::isinf(expected));
      if (std::isfinite(expected))
      {
        ++hits;
        ASSERT_NEAR(frame.t[pixel], expected, 1e-6) << x << ' ' << y;
        const Vec3d point = rays.worldPoint(x + 0.5, y + 0.5, frame.t[pixel]);
        ASSERT_NEAR(length(point), 1, 1e-6);
        ASSERT_NEAR(length(frame.normal[pixel].as<double>() - point), 0, 1e-6);
      }
    }
  }
  EXPECT_GT(hits, 1000);
}

INSTANTIATE_TEST_SUITE_P(Both, FrameOfOneSphere,
  testing::Values(Projection{ true, 5 }, Projection{ true, 1e4 }, Projection{ false, 5 },
    Projection{ false, 1e4 }));

TEST(FrameTracer, FindsTheNearestOfManyFromInsideTheCloud)
{
  // The eye is in the middle of the cloud, inside of some spheres: those are passed.
  const std::vector<Sphere> spheres = randomSpheres(3000, 12);
  Camera camera{ translation(0.1, -0.2, 0.3), frustum(-.1, .1, -.1, .1, .1, 100), 61, 61 };
  const PrimaryRays rays = *PrimaryRays::make(camera, Identity);
  const TracedFrame frame = shoot(spheres, rays).frame;
  for (int y = 0; y < 61; ++y)
  {
    for (int x = 0; x < 61; ++x)
    {
      const PrimaryRay ray = rays.at(x + 0.5, y + 0.5);
      const double expected = nearestFront(spheres, ray.origin, ray.direction, ray.nearest);
      const double found = frame.t[pixelAt(frame, x, y)];
      ASSERT_EQ(std::isinf(found), std::isinf(expected)) << x << ' ' << y;
      ASSERT_TRUE(std::isinf(found) || std::abs(found - expected) < 1e-6) << x << ' ' << y;
    }
  }
}

TEST(FrameTracer, SphereAroundTheEyeIsPassed)
{
  const Camera camera = lookAtOrigin(true, 0.5, 0.5, 9, 9, 0.01, 100);
  const PrimaryRays rays = *PrimaryRays::make(camera, Identity);
  const Shot alone = shoot({ { 0, 0, 0, 1 } }, rays);
  EXPECT_EQ(alone.counters.hits, 0u);
  const Shot behind = shoot({ { 0, 0, 0, 1 }, { 0, 0, -5, 1 } }, rays);
  EXPECT_EQ(behind.frame.sphere[pixelAt(behind.frame, 4, 4)], 1u);
  EXPECT_NEAR(behind.frame.t[pixelAt(behind.frame, 4, 4)], 4.5, 1e-6);
}

TEST(FrameTracer, NearAndFarPlanesClip)
{
  const std::vector<Sphere> row{ { 0, 0, 0, 1 }, { 0, 0, -10, 1 } };
  const auto seen = [&](double zNear, double zFar)
  {
    const Camera camera = lookAtOrigin(true, 20, 1, 3, 3, zNear, zFar);
    return shoot(row, *PrimaryRays::make(camera, Identity)).frame.sphere[4];
  };
  EXPECT_EQ(seen(18.9, 40), 0u);
  EXPECT_EQ(seen(19.1, 40), 1u) << "a sphere cut open by the near plane is passed";
  EXPECT_EQ(seen(18, 18.9), SphereScene::None);
  EXPECT_EQ(seen(21, 28.9), SphereScene::None);
  EXPECT_EQ(seen(21, 29.1), 1u);
}

TEST(FrameTracer, WindowDepthIsThatOfTheProjection)
{
  for (const bool perspective : { true, false })
  {
    const Camera camera = lookAtOrigin(perspective, 10, 2, 40, 30, 4, 25);
    const PrimaryRays rays = *PrimaryRays::make(camera, translation(3, 4, 5));
    const PrimaryRay ray = rays.at(7.25, 11.5);
    for (const double t : { 4.5, 9.0, 20.0 })
    {
      const Vec3d eye = transformPoint(camera.worldToEye, rays.worldPoint(7.25, 11.5, t));
      const Vec3d clip = transformPoint(camera.eyeToClip, eye);
      const double w = perspective ? -eye.z : 1;
      EXPECT_NEAR(ray.windowDepth(t / ray.worldPerLocal), 0.5 + 0.5 * clip.z / w, 1e-12);
      EXPECT_NEAR(clip.x / w, 2 * 7.25 / 40 - 1, 1e-12);
      EXPECT_NEAR(clip.y / w, 2 * 11.5 / 30 - 1, 1e-12);
    }
  }
}

TEST(FrameTracer, OffAxisTilesAreTheSameRaysAsTheWhole)
{
  const std::vector<Sphere> spheres = randomSpheres(500, 6);
  Camera whole{ translation(0, 0, -20), frustum(-.4, .5, -.3, .3, 1, 60), 90, 60 };
  Camera tile{ translation(0, 0, -20), frustum(.2, .5, -.1, .1, 1, 60), 30, 20 };
  const TracedFrame a = shoot(spheres, *PrimaryRays::make(whole, Identity)).frame;
  const TracedFrame b = shoot(spheres, *PrimaryRays::make(tile, Identity)).frame;
  for (int y = 0; y < 20; ++y)
  {
    for (int x = 0; x < 30; ++x)
    {
      const std::size_t i = pixelAt(a, x + 60, y + 20), j = pixelAt(b, x, y);
      ASSERT_EQ(a.sphere[i], b.sphere[j]);
      ASSERT_TRUE(a.t[i] == b.t[j] || std::abs(a.t[i] - b.t[j]) < 1e-9);
    }
  }
}

TEST(FrameTracer, ActorMatrixScalesAndShears)
{
  // An ellipsoid with half axes 3, 1, 1 whose middle is moved along x.
  const Matrix4 stretch{ 3, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
  const Camera camera = lookAtOrigin(false, 10, 4, 81, 81, 1, 20);
  const PrimaryRays rays = *PrimaryRays::make(camera, stretch);
  const TracedFrame frame = shoot({ { 0, 0, 0, 1 } }, rays).frame;
  std::size_t hits = 0;
  for (int y = 0; y < 81; ++y)
  {
    for (int x = 0; x < 81; ++x)
    {
      const double wx = 8 * (x + 0.5) / 81 - 4, wy = 8 * (y + 0.5) / 81 - 4;
      const double squared = 1 - (wx - 1) * (wx - 1) / 9 - wy * wy;
      const std::size_t pixel = pixelAt(frame, x, y);
      ASSERT_EQ(std::isfinite(frame.t[pixel]), squared >= 0);
      if (squared >= 0)
      {
        ++hits;
        const double z = std::sqrt(squared);
        ASSERT_NEAR(frame.t[pixel], 10 - z, 1e-6);
        const Vec3d normal = normalized(Vec3d{ (wx - 1) / 9, wy, z });
        ASSERT_NEAR(length(worldNormal(rays, frame.normal[pixel]) - normal), 0, 1e-6);
      }
    }
  }
  EXPECT_GT(hits, 500u);
}

TEST(FrameTracer, SingularMatricesAndEmptyWindowsGiveNoRays)
{
  const Camera camera = lookAtOrigin(true, 10, 1, 4, 4, 1, 20);
  Matrix4 flat = Identity;
  flat[10] = 0;
  EXPECT_FALSE(PrimaryRays::make(camera, flat));
  Camera empty = camera;
  empty.width = 0;
  EXPECT_FALSE(PrimaryRays::make(empty, Identity));
}

TEST(FrameTracer, AnyWindowSize)
{
  for (const auto& [width, height] : { std::pair(1, 1), std::pair(17, 5), std::pair(33, 64) })
  {
    const Camera camera = lookAtOrigin(true, 10, 0.5, width, height, 1, 20);
    const Shot shot = shoot({ { 0, 0, 0, 3 } }, *PrimaryRays::make(camera, Identity));
    EXPECT_EQ(shot.counters.hits, static_cast<std::size_t>(width * height));
    EXPECT_EQ(shot.frame.pixels(), static_cast<std::size_t>(width * height));
  }
}

TEST(FrameTracer, EmptySceneAndEmptyTilesCostNoRays)
{
  const Camera camera = lookAtOrigin(true, 100, 50, 256, 256, 1, 200);
  const PrimaryRays rays = *PrimaryRays::make(camera, Identity);
  EXPECT_EQ(shoot({}, rays).counters.rays, 0u);
  const Shot shot = shoot({ { 0, 0, 0, 1 } }, rays);
  EXPECT_GT(shot.counters.hits, 0u);
  EXPECT_GT(shot.counters.tilesSkipped, shot.counters.tiles / 2);
  EXPECT_LT(shot.counters.rays, 500u);
}

TEST(FrameTracer, SameFrameForAnyNumberOfThreads)
{
  const SphereScene scene(randomSpheres(5000, 15));
  const Camera camera = lookAtOrigin(true, 40, 16, 150, 130, 1, 100);
  const PrimaryRays rays = *PrimaryRays::make(camera, Identity);
  TracedFrame first;
  for (const std::size_t threads : { 1, 2, 7 })
  {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    TracedFrame frame;
    (void)traceFrame(scene, rays, {}, frame);
    first = threads == 1 ? frame : first;
    EXPECT_EQ(frame.t, first.t) << threads;
    EXPECT_EQ(frame.sphere, first.sphere) << threads;
  }
}
}
