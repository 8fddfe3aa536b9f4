// SPDX-License-Identifier: BSD-3-Clause
/// Where rays from the surface of a sphere begin, so that Embree cannot report the sphere itself.

#include "Constants.h"
#include "OcclusionBaker.h"
#include "Random.h"
#include "ReferenceRays.h"
#include "Sampling.h"
#include "SurfaceTracer.h"
#include "SyntheticSpheres.h"
#include "TestScenes.h"
#include "TexelMap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace
{
constexpr float Unbounded = std::numeric_limits<float>::infinity();

/// Between both, its logarithm uniform.
double anySize(po::Random& random, double low, double high)
{
  return low * std::pow(high / low, random.uniform());
}

/// Outwards with a given cosine to the normal.
po::Vec3d outwards(po::Vec3d normal, double cosine, po::Random& random)
{
  const double angle = 2 * po::Pi * random.uniform();
  const double sine = std::sqrt(1 - cosine * cosine);
  return po::aboutNormal(normal, { sine * std::cos(angle), sine * std::sin(angle), cosine });
}

po::SurfaceRay rayFrom(const po::Sphere& sphere, po::Vec3d normal, po::Vec3d direction)
{
  return po::makeSurfaceRay(
    sphere, sphere.center() + sphere.radius * normal.as<float>(), direction.as<float>());
}

/// A scene of one sphere, which must outlive it.
po::SceneHandle sceneOf(RTCDevice device, const po::Sphere& sphere)
{
  po::SceneHandle scene = po::makeScene(device);
  const po::GeometryHandle geometry =
    po::makeGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT, "EMBREE_GEOMETRY_POINT");
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, &sphere,
    0, sizeof(po::Sphere), 1);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene.get(), geometry.get());
  po::commitScene(device, scene, "building a scene");
  return scene;
}

/// Does Embree report anything, traced alone or sixteen times at once? The ray has a start.
bool reportsHit(RTCScene scene, const po::SurfaceRay& ray)
{
  po::RayQueryContext context;
  po::initRayQueryContext(context, false);
  const bool hit = po::isStopped(scene, context, ray.origin, *ray.start, ray.direction, Unbounded);
  alignas(64) int valid[16];
  RTCRay16 packet;
  for (unsigned i = 0; i < 16; ++i)
  {
    valid[i] = -1;
    packet.org_x[i] = ray.origin.x;
    packet.org_y[i] = ray.origin.y;
    packet.org_z[i] = ray.origin.z;
    packet.tnear[i] = *ray.start;
    packet.dir_x[i] = ray.direction.x;
    packet.dir_y[i] = ray.direction.y;
    packet.dir_z[i] = ray.direction.z;
    packet.time[i] = 0;
    packet.tfar[i] = Unbounded;
    packet.mask[i] = 0xFFFFFFFFu;
    packet.id[i] = i;
    packet.flags[i] = 0;
  }
  po::initRayQueryContext(context, true);
  po::occluded16(valid, scene, context, packet);
  return hit || *std::min_element(packet.tfar, packet.tfar + 16) < 0;
}

/// Radii from 1e-4 to 1e4, up to a million of their radii away from the origin.
std::vector<po::Sphere> spheresOfAllSizes()
{
  po::Random random(1, 0, 0);
  std::vector<po::Sphere> spheres;
  for (int i = 0; i < 1000; ++i)
  {
    const double radius = anySize(random, 1e-4, 1e4);
    const double distance = anySize(random, 1e-2, 1e6) * radius;
    const po::Vec3d center =
      distance * po::textureDirection({ random.uniform(), random.uniform() });
    spheres.push_back({ static_cast<float>(center.x), static_cast<float>(center.y),
      static_cast<float>(center.z), static_cast<float>(radius) });
  }
  return spheres;
}

class SurfaceRayInstructions : public testing::TestWithParam<const char*>
{
};
}

TEST_P(SurfaceRayInstructions, EmbreeNeverReportsTheOwnSphere)
{
  const po::DeviceHandle device(rtcNewDevice((std::string("isa=") + GetParam()).c_str()));
  if (!device)
  {
    GTEST_SKIP() << "neither this machine nor every build of Embree has all instructions";
  }
  const std::vector<po::Sphere> spheres = spheresOfAllSizes();
  std::size_t traced = 0;
  for (unsigned own = 0; own < spheres.size(); ++own)
  {
    const po::SceneHandle scene = sceneOf(device.get(), spheres[own]);
    po::Random random(2, own, 0);
    for (int i = 0; i < 200; ++i)
    {
      const po::Vec3d normal = po::textureDirection({ random.uniform(), random.uniform() });
      const double cosine = i % 2 == 0 ? std::sqrt(random.uniform()) : anySize(random, 1e-6, 1);
      const po::SurfaceRay ray = rayFrom(spheres[own], normal, outwards(normal, cosine, random));
      if (ray.start)
      {
        ++traced;
        EXPECT_FALSE(reportsHit(scene.get(), ray)) << own << ", cosine " << cosine;
        EXPECT_GT(*ray.start, 0);
        EXPECT_LE(*ray.start, po::LongestRayStart * spheres[own].radius);
      }
    }
  }
  EXPECT_GT(traced, 50000u);
}

INSTANTIATE_TEST_SUITE_P(All, SurfaceRayInstructions,
  testing::Values("sse2", "sse4.2", "avx", "avx2", "avx512"),
  [](const auto& info)
  {
    std::string name = info.param;
    name.erase(std::remove(name.begin(), name.end(), '.'), name.end());
    return name;
  });

TEST(SurfaceRays, RaysWithoutASafeStartHaveNone)
{
  const po::Sphere sphere{ 0, 0, 0, 1 };
  EXPECT_TRUE(po::rayStart(sphere, { 0, 0, 1 }, { 0, 0, 1 }));
  EXPECT_LT(*po::rayStart(sphere, { 0, 0, 1 }, { 0, 0, 1 }), 1e-5f);
  EXPECT_FALSE(po::rayStart(sphere, { 0, 0, 1 }, { 0, 0, -1 }));
  EXPECT_FALSE(po::rayStart(sphere, { 0, 0, 1 }, { 1, 0, 0 }));
  EXPECT_FALSE(po::rayStart(sphere, { 0, 0, 0 }, { 1, 0, 0 }));
  EXPECT_FALSE(po::rayStart(sphere, { 0, 0, 0.9f }, { 0, 0, 1 })); // far below the surface
  EXPECT_FALSE(po::rayStart({ 0, 0, 0, 1e-20f }, { 0, 0, 1e-20f }, { 0, 0, 1 }));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(po::rayStart(sphere, { 0, 0, nan }, { 0, 0, 1 }));
}

namespace
{
/// Rays of the Reference estimator from up to `particles` particles of a scene.
struct Comparison
{
  std::size_t rays = 0;
  std::size_t withoutStart = 0;
  std::size_t differing = 0; ///< from what the filter says of all hits
};

Comparison compareWithFilter(const po::SphereCloud& cloud, std::size_t particles)
{
  const po::BakeScene scene(cloud);
  scene.prepareRays();
  const po::BakeSettings settings = floatSettings(8, 49);
  const po::ReferenceRays maker(scene, settings);
  po::ReferenceRays::Workspace work;
  const std::vector<std::uint8_t> noneHidden(cloud.spheres.size()); // takes the filter
  Comparison found;
  for (std::size_t i = 0; i < particles; ++i)
  {
    const auto id = static_cast<unsigned>(i * cloud.spheres.size() / particles);
    std::vector<po::SurfaceRay> rays;
    const bool visible = maker.beginParticle(id, work);
    for (int texel = 0; visible && texel < 64; ++texel)
    {
      (void)maker.makeRays(id, texel / 8, texel % 8, work, rays);
    }
    const po::SurfaceTracer tracer(scene.rays(), id, Unbounded);
    for (const po::SurfaceRay& ray : rays)
    {
      ++found.rays;
      found.withoutStart += !ray.start;
      found.differing += tracer.occluded(ray) !=
        scene.rays().occluded(ray.origin, ray.direction, Unbounded, id, noneHidden.data());
    }
  }
  return found;
}
}

TEST(SurfaceRays, AlmostAllAreTracedWithoutFilterAndTellTheSame)
{
  for (const char* family : { "pack", "overlap", "gas", "shell", "foam" })
  {
    const po::SyntheticSpheres spheres =
      po::makeSyntheticSpheres(*po::syntheticFamilyFromName(family), 20000, 1);
    const po::SphereCloud cloud = po::makeSphereCloud(
      20000,
      [&](std::size_t i)
      {
        const auto& c = spheres.centers[i];
        return po::Vec3d{ c[0], c[1], c[2] };
      },
      [&](std::size_t i) { return static_cast<double>(spheres.radii[i]); });
    const Comparison found = compareWithFilter(cloud, 64);
    EXPECT_GT(found.rays, 50000u) << family;
    EXPECT_LE(found.withoutStart, found.rays / 10000) << family;
    EXPECT_LE(found.differing, found.rays / 20000) << family;
  }
}

TEST(SurfaceRays, UnequalRadiiTellTheSameWithAndWithoutFilter)
{
  po::Random random(3, 0, 0);
  std::vector<po::Sphere> spheres;
  for (int i = 0; i < 4000; ++i)
  {
    const auto coordinate = [&] { return static_cast<float>(18 * random.uniform()); };
    spheres.push_back(
      { coordinate(), coordinate(), coordinate(), static_cast<float>(anySize(random, 1e-4, 1)) });
  }
  const Comparison found = compareWithFilter(cloudOf(spheres), 128);
  EXPECT_GT(found.rays, 250000u);
  EXPECT_LE(found.withoutStart, found.rays / 5);
  EXPECT_LE(found.differing, found.rays / 20000);
}

TEST(SurfaceRays, SmallSpheresInContactWithALargeOneAreMet)
{
  // Next to the point of contact all rays enter the small sphere at once, and leave it beyond.
  const po::Sphere large{ 0, 0, 0, 1e4f };
  const po::SphereScene scene({ large, { 0, 0, 1e4f + 1, 1 } });
  const po::SurfaceTracer tracer(scene, 0, Unbounded);
  po::Random random(4, 0, 0);
  std::size_t met = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const double angle = 2 * po::Pi * random.uniform();
    const double slope = anySize(random, 1e-9, 1e-6); // up to a hundredth of the small radius
    const po::Vec3d normal =
      po::normalized(po::Vec3d{ slope * std::cos(angle), slope * std::sin(angle), 1 });
    const double cosine = 0.1 + 0.9 * random.uniform();
    met += tracer.occluded(rayFrom(large, normal, outwards(normal, cosine, random)));
  }
  EXPECT_EQ(met, 20000u);
}

TEST(SurfaceRays, ALoneSphereFarFromTheOriginIsExactlyOpen)
{
  const po::SphereScene scene(std::vector<po::Sphere>{ { 3e5f, -2e5f, 1e5f, 1 } });
  const po::Sphere sphere = scene.spheres().front();
  const po::SurfaceTracer tracer(scene, 0, Unbounded);
  po::Random random(5, 0, 0);
  for (int i = 0; i < 20000; ++i)
  {
    const po::Vec3d normal = po::textureDirection({ random.uniform(), random.uniform() });
    const double cosine = anySize(random, 1e-3, 1);
    EXPECT_FALSE(tracer.occluded(rayFrom(sphere, normal, outwards(normal, cosine, random))));
  }
}
