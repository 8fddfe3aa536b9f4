// SPDX-License-Identifier: BSD-3-Clause
#include "FrameTracer.h"
#include "Shading.h"
#include "TexelMap.h"

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
const Matrix4 Identity{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

/// OpenGL's frustum; the numbers are the edges of the near plane.
Matrix4 frustum(double left, double right, double bottom, double top, double zNear, double zFar)
{
  return { 2 * zNear / (right - left), 0, (right + left) / (right - left), 0, 0,
    2 * zNear / (top - bottom), (top + bottom) / (top - bottom), 0, 0, 0,
    -(zFar + zNear) / (zFar - zNear), -2 * zFar * zNear / (zFar - zNear), 0, 0, -1, 0 };
}

Matrix4 parallel(double left, double right, double bottom, double top, double zNear, double zFar)
{
  return { 2 / (right - left), 0, 0, -(right + left) / (right - left), 0, 2 / (top - bottom), 0,
    -(top + bottom) / (top - bottom), 0, 0, -2 / (zFar - zNear), -(zFar + zNear) / (zFar - zNear),
    0, 0, 0, 1 };
}

Matrix4 translation(double x, double y, double z)
{
  return { 1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1 };
}

/// An eye at (0, 0, distance) that looks at the origin; `half` is the half height seen there.
Camera lookAtOrigin(
  bool perspective, double distance, double half, int width, int height, double zNear, double zFar)
{
  const double aspect = static_cast<double>(width) / height;
  const double edge = perspective ? half * zNear / distance : half;
  const auto& projection = perspective ? frustum : parallel;
  return { translation(0, 0, -distance),
    projection(-edge * aspect, edge * aspect, -edge, edge, zNear, zFar), width, height };
}

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
  shot.counters = traceFrame(SphereScene(spheres), rays, shot.frame);
  return shot;
}

std::size_t pixelAt(const TracedFrame& frame, int x, int y)
{
  return static_cast<std::size_t>(y) * frame.width + x;
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
    for (const double t : { 4.5, 9.0, 20.0 })
    {
      const Vec3d eye = transformPoint(camera.worldToEye, rays.worldPoint(7.25, 11.5, t));
      const Vec3d clip = transformPoint(camera.eyeToClip, eye);
      const double w = perspective ? -eye.z : 1;
      EXPECT_NEAR(rays.windowDepth(7.25, 11.5, t), 0.5 + 0.5 * clip.z / w, 1e-12);
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
    (void)traceFrame(scene, rays, frame);
    first = threads == 1 ? frame : first;
    EXPECT_EQ(frame.t, first.t) << threads;
    EXPECT_EQ(frame.sphere, first.sphere) << threads;
  }
}

/// A big sphere as ground, a small one above it, light from straight above.
TEST(Shadows, SphereAboveSphereIsADiscOfItsRadius)
{
  const SphereScene scene({ { 0, -1000, 0, 1000 }, { 0, 3, 0, 1 } });
  // The eye looks down along -y from between ground and occluder.
  const Matrix4 down{ 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, -1.5, 0, 0, 0, 1 };
  const Camera camera{ down, parallel(-2, 2, -2, 2, 0, 10), 101, 101 };
  const PrimaryRays rays = *PrimaryRays::make(camera, Identity);
  TracedFrame frame;
  (void)traceFrame(scene, rays, frame);
  Light light;
  light.direction = { 0, -1, 0 };
  std::vector<std::uint8_t> lit;
  const ShadowCounters counters = traceShadows(scene, rays, frame, light, lit);
  EXPECT_EQ(counters.rays, 101u * 101u);
  EXPECT_EQ(counters.skipped, 0u);
  for (int y = 0; y < 101; ++y)
  {
    for (int x = 0; x < 101; ++x)
    {
      const Vec3d p = rays.worldPoint(x + 0.5, y + 0.5, frame.t[pixelAt(frame, x, y)]);
      const double fromAxis = std::hypot(p.x, p.z);
      if (std::abs(fromAxis - 1) > 1e-3)
      {
        ASSERT_EQ(lit[pixelAt(frame, x, y)] != 0, fromAxis > 1) << x << ' ' << y;
      }
    }
  }
}

TEST(Shadows, TheLitHalfOfALoneSphereHasNoSpeckle)
{
  // Far from the origin and lit from the side: nothing but the surface's own facing may decide.
  const SphereScene scene({ { 300, 200, -100, 1 } });
  const Camera camera{ translation(-300, -200, 90), parallel(-1.1, 1.1, -1.1, 1.1, 0, 20), 301,
    301 };
  const PrimaryRays rays = *PrimaryRays::make(camera, Identity);
  TracedFrame frame;
  (void)traceFrame(scene, rays, frame);
  Light light;
  light.direction = normalized(Vec3d{ -1, -0.3, -0.1 });
  std::vector<std::uint8_t> lit;
  const ShadowCounters counters = traceShadows(scene, rays, frame, light, lit);
  EXPECT_GT(counters.skipped, 10000u);
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel)
  {
    if (frame.sphere[pixel] != SphereScene::None)
    {
      const double facing = -dot(frame.normal[pixel].as<double>(), light.direction);
      ASSERT_EQ(lit[pixel] != 0, facing > 0);
    }
  }
}

TEST(Shadows, OccludersBehindAPositionalLightCastNone)
{
  const SphereScene scene({ { 0, 0, 0, 1 }, { 0, 0, 6, 1 } });
  const Camera camera = lookAtOrigin(true, 4.5, 0.5, 5, 5, 0.1, 20);
  const PrimaryRays rays = *PrimaryRays::make(camera, Identity);
  TracedFrame frame;
  (void)traceFrame(scene, rays, frame);
  Light light;
  light.positional = true;
  std::vector<std::uint8_t> lit;
  light.position = { 0, 0, 4 };
  (void)traceShadows(scene, rays, frame, light, lit);
  EXPECT_EQ(lit[12], 1);
  light.position = { 0, 0, 8 };
  (void)traceShadows(scene, rays, frame, light, lit);
  EXPECT_EQ(lit[12], 0);
}

TEST(Lights, ConeAndAttenuationFollowOpenGL)
{
  Light light;
  light.positional = true;
  light.position = { 0, 0, 2 };
  light.coneAngle = 30;
  light.exponent = 2;
  light.attenuation = { 1, 0.5, 0.25 };
  const double inAxis = illuminate(light, { 0, 0, 0 }).strength;
  EXPECT_NEAR(inAxis, 1 / (1 + 0.5 * 2 + 0.25 * 4), 1e-12);
  const double d = std::sqrt(5.0); // at 26.6 degrees
  EXPECT_NEAR(
    illuminate(light, { 1, 0, 0 }).strength, std::pow(2 / d, 2) / (1 + 0.5 * d + 0.25 * 5), 1e-12);
  EXPECT_EQ(illuminate(light, { 1.2, 0, 0 }).strength, 0);
}

/// One random float texture of 8 x 8.
struct OneTexture
{
  std::vector<float> values = std::vector<float>(64);
  std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(64);
  std::vector<std::int32_t> rows{ 0 };

  OneTexture()
  {
    std::mt19937 random(3);
    for (std::size_t i = 0; i < 64; ++i)
    {
      bytes[i] = static_cast<std::uint8_t>(random() % 256);
      values[i] = 0.8f * (bytes[i] / 255.0f) * (bytes[i] / 255.0f);
    }
  }
};

TEST(OcclusionTextures, ValueIsTheBilinearOneOfTheCore)
{
  const OneTexture one;
  const OcclusionTextures floats(8, one.values.data(), one.rows.data(), nullptr);
  const OcclusionTextures bytes(8, one.bytes.data(), 0.8, one.rows.data(), nullptr);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 1000; ++i)
  {
    const TextureCoordinate c{ uniform(random), uniform(random) };
    const BilinearTexels texels = bilinearTexels(8, c);
    float expected = 0;
    for (std::size_t k = 0; k < 4; ++k)
    {
      expected += texels.weight[k] * one.values[texels.index[k]];
    }
    EXPECT_NEAR(floats.at(0, textureDirection(c)), expected, 1e-5);
    EXPECT_NEAR(bytes.at(0, textureDirection(c)), expected, 1e-5);
  }
}

TEST(OcclusionTextures, NoJumpAcrossTheSeam)
{
  const OneTexture one;
  const OcclusionTextures textures(8, one.values.data(), one.rows.data(), nullptr);
  const double step = 1e-6;
  for (double v = 0.01; v < 1; v += 0.01)
  {
    const float before = textures.at(0, textureDirection({ 1 - step, v }));
    const float after = textures.at(0, textureDirection({ step, v }));
    // Values differ by at most 0.8 over a texel, which is 1/8 of u.
    EXPECT_NEAR(before, after, 2 * step * 8 * 0.8 + 1e-6) << v;
  }
}

TEST(OcclusionTextures, ParticlesWithoutATextureHaveTheirMean)
{
  const OneTexture one;
  const std::vector<std::int32_t> rows{ -1, 0 };
  const std::vector<float> means{ 0.25f, 0.5f };
  const OcclusionTextures with(8, one.values.data(), rows.data(), means.data());
  const OcclusionTextures without(8, one.values.data(), rows.data(), nullptr);
  EXPECT_EQ(with.at(0, { 1, 0, 0 }), 0.25f);
  EXPECT_EQ(without.at(0, { 1, 0, 0 }), 1.0f);
  EXPECT_EQ(OcclusionTextures().at(0, { 1, 0, 0 }), 1.0f);
}

/// A sphere that fills a 3 x 3 window, seen along -z; colours are those of the middle pixel.
class ShadedSphere : public testing::Test
{
protected:
  ShadedSphere()
    : rays(*PrimaryRays::make(lookAtOrigin(false, 10, 0.5, 3, 3, 1, 20), Identity))
  {
    (void)traceFrame(SphereScene({ { 0, 0, 0, 1 } }), rays, frame);
    lights.front().direction = { 0, 0, -1 };
    half = OcclusionTextures(1, halfOpen.data(), rows.data(), nullptr);
  }

  std::array<int, 3> middle(const OcclusionTextures& textures, const Material& material)
  {
    std::vector<std::uint8_t> rgba;
    shadeFrame({ rays, frame, particles, textures, lights, shadows, material }, rgba);
    EXPECT_EQ(rgba[4 * 4 + 3], 255);
    return { rgba[16], rgba[17], rgba[18] };
  }

  PrimaryRays rays;
  TracedFrame frame;
  std::vector<std::int64_t> particles{ 0 };
  std::vector<float> halfOpen{ 0.5f };
  std::vector<std::int32_t> rows{ 0 };
  OcclusionTextures none, half;
  std::vector<Light> lights{ Light{} };
  ShadowMasks shadows;
};

TEST_F(ShadedSphere, TermsAddUpAsInVTK)
{
  Material m;
  m.mode = ShadingMode::DirectLight;
  m.ambient = 0.1;
  m.diffuse = 0.5;
  m.specular = 0.2;
  m.diffuseColor = { 1, 0.5f, 0 };
  m.ambientColor = { 0, 0, 1 };
  EXPECT_EQ(middle(half, m), (std::array<int, 3>{ 179, 115, 77 })); // .5+.2, .25+.2, .1+.2
  shadows.lit = { std::vector<std::uint8_t>(9, 0) };
  EXPECT_EQ(middle(half, m), (std::array<int, 3>{ 0, 0, 26 }));
}

TEST_F(ShadedSphere, OcclusionScalesWhatItShould)
{
  Material m;
  m.ambient = 0.4;
  m.diffuse = 0.4;
  EXPECT_EQ(middle(none, m)[0], 204);
  EXPECT_EQ(middle(half, m)[0], 102);
  m.occlusionOnDiffuse = false;
  EXPECT_EQ(middle(half, m)[0], 153); // 0.2 + 0.4
  m.mode = ShadingMode::AmbientOcclusion;
  m.diffuseColor = { 1, 0.5f, 0 };
  EXPECT_EQ(middle(half, m), (std::array<int, 3>{ 128, 64, 0 }));
  m.mode = ShadingMode::DirectLight;
  m.diffuseColor = { 1, 1, 1 };
  EXPECT_EQ(middle(half, m)[0], 204);
}

TEST_F(ShadedSphere, ParticleColoursReplaceBothColours)
{
  const std::uint8_t green[] = { 0, 200, 0, 255 };
  Material m;
  m.ambient = 0.5;
  m.diffuse = 0.5;
  m.particleColors = green;
  EXPECT_EQ(middle(none, m), (std::array<int, 3>{ 0, 200, 0 }));
}
}
