// SPDX-License-Identifier: BSD-3-Clause
/// What casts but does not receive: triangles and further spheres beside the particles.

#include "Constants.h"
#include "ErrorPilot.h"
#include "OcclusionBaker.h"
#include "ReferenceEstimator.h"
#include "SweepEstimator.h"
#include "TestScenes.h"
#include "TexelMap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace
{
/// A square of half side `reach` at height z; which side is the front is up to the caller.
po::OccluderMesh square(float reach, float z, bool frontUp)
{
  po::OccluderMesh mesh;
  mesh.vertices = { { -reach, -reach, z }, { reach, -reach, z }, { reach, reach, z },
    { -reach, reach, z } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  if (!frontUp)
  {
    std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
    std::swap(mesh.triangles[1][0], mesh.triangles[1][1]);
  }
  return mesh;
}

/// An axis-aligned box about the origin, twelve triangles.
po::OccluderMesh box(float reach)
{
  po::OccluderMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
  {
    const auto side = [&](int bit) { return (corner >> bit & 1) != 0 ? reach : -reach; };
    mesh.vertices.push_back({ side(0), side(1), side(2) });
  }
  const unsigned faces[6][4] = { { 0, 1, 3, 2 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 3, 7, 6 },
    { 0, 2, 6, 4 }, { 1, 3, 7, 5 } };
  for (const auto& face : faces)
  {
    mesh.triangles.push_back({ face[0], face[1], face[2] });
    mesh.triangles.push_back({ face[0], face[2], face[3] });
  }
  return mesh;
}

po::BakeResult bakeUnder(const po::SphereCloud& cloud, const po::Occluders& occluders,
  const po::BakeSettings& settings, const po::OcclusionEstimator& estimator)
{
  po::Progress progress;
  return po::bakeOcclusion(po::BakeScene(cloud, occluders), settings, estimator, progress);
}

std::vector<float> textureOf(const po::BakeResult& result, std::size_t particle)
{
  const auto texels = result.table.resolution * result.table.resolution;
  const auto first = result.table.floats.begin() + result.rowOf[particle] * texels;
  return { first, first + texels };
}

/// The first `receivers` spheres of a cloud as particles, the others as occluders.
struct Split
{
  Split(const po::SphereCloud& all, std::size_t receivers)
    : particles(all)
  {
    const auto middle = all.spheres.begin() + static_cast<std::ptrdiff_t>(receivers);
    particles.spheres.assign(all.spheres.begin(), middle);
    particles.sourceIds.resize(receivers);
    occluders.spheres.assign(middle, all.spheres.end());
  }

  po::SphereCloud particles;
  po::Occluders occluders;
};

TEST(Occluders, ASphereOnASquareSeesHalfTheSky)
{
  // Over a plane the visible share is (1 + n.z) / 2. The square reaches 10,000 radii, so the sky
  // between its edge and the horizon adds less than 1e-4. A texel's tolerance is 4 binomial
  // standard errors, which stratification can only lower; the square touches the sphere.
  constexpr int resolution = 16;
  constexpr int samples = 900;
  for (const bool frontUp : { true, false })
  {
    const po::BakeResult result =
      bakeUnder(cloudOf({ { 0, 0, 0, 1 } }), { {}, square(10000, -1, frontUp) },
        floatSettings(resolution, samples), po::ReferenceEstimator());
    EXPECT_NEAR(result.mean[0], 0.5, 4 * 0.5 / std::sqrt(256.0 * samples) + 1e-4);
    const std::vector<float> texture = textureOf(result, 0);
    for (int row = 0; row < resolution; ++row)
    {
      const double top = std::cos(po::Pi * row / resolution);
      const double bottom = std::cos(po::Pi * (row + 1) / resolution);
      const double expected = (1 + (top + bottom) / 2) / 2; // mean over the texel's area
      const double error = std::sqrt(expected * (1 - expected) / samples);
      for (int column = 0; column < resolution; ++column)
      {
        EXPECT_NEAR(texture[po::texelIndex(resolution, row, column)], expected, 4 * error + 1e-4)
          << row << " " << column << (frontUp ? " front" : " back");
      }
    }
  }
}

TEST(Occluders, NoRayLeavesAClosedBox)
{
  // Not one of 100,000 rays, whether or not it comes near the edges that triangles share.
  const po::BakeResult result = bakeUnder(
    cloudOf({ { 0, 0, 0, 1 } }), { {}, box(3) }, floatSettings(16, 400), po::ReferenceEstimator());
  const std::vector<float> texture = textureOf(result, 0);
  EXPECT_EQ(std::count(texture.begin(), texture.end(), 0.0f), 256);
  EXPECT_EQ(result.mean[0], 0);
  EXPECT_EQ(result.counters.particlesDark, 1u);
}

TEST(Occluders, ATriangleThroughAParticleHidesNothingOfItsOwnSide)
{
  // The equator's plane: the upper half sees what is above, the lower half what is below, both
  // (1 + |n.z|) / 2 of the sky.
  constexpr int resolution = 8;
  constexpr int samples = 900;
  const po::BakeResult result = bakeUnder(cloudOf({ { 0, 0, 0, 1 } }),
    { {}, square(10000, 0, true) }, floatSettings(resolution, samples), po::ReferenceEstimator());
  EXPECT_EQ(result.counters.samplesInside, 0u);
  EXPECT_NEAR(result.mean[0], 0.75, 0.005);
  const std::vector<float> texture = textureOf(result, 0);
  EXPECT_GT(texture[po::texelIndex(resolution, 0, 0)], 0.95f);
  EXPECT_GT(texture[po::texelIndex(resolution, resolution - 1, 0)], 0.95f);
}

TEST(Occluders, TrianglesBeyondTheMaximumDistanceDoNotOcclude)
{
  po::BakeSettings settings = floatSettings(8, 64);
  settings.maximumDistance = 3.9; // the square is 4 away
  const po::SphereCloud cloud = cloudOf({ { 0, 0, 0, 2 } });
  const po::Occluders below{ {}, square(1000, -3, true) }; // local: 3 radii of 2
  EXPECT_EQ(bakeUnder(cloud, below, settings, po::ReferenceEstimator()).mean[0], 1);
  settings.maximumDistance = 4.5;
  EXPECT_LT(bakeUnder(cloud, below, settings, po::ReferenceEstimator()).mean[0], 1);
}

TEST(Occluders, SpheresOccludeAndBuryAsParticlesDo)
{
  // The same spheres, all particles or the last 30 of them occluders: the same bits for Reference,
  // whose random numbers depend on the particle alone.
  const po::SphereCloud all = cloudOf(mixedScene());
  const Split split(all, 30);
  const po::BakeSettings settings = floatSettings(6, 49);
  const po::BakeResult whole = bakeUnder(all, {}, settings, po::ReferenceEstimator());
  const po::BakeResult part =
    bakeUnder(split.particles, split.occluders, settings, po::ReferenceEstimator());
  ASSERT_EQ(part.rowOf.size(), 30u);
  EXPECT_EQ(part.counters.particles, 30u);
  for (std::size_t i = 0; i < 30; ++i)
  {
    EXPECT_EQ(textureOf(part, i), textureOf(whole, i)) << i;
    EXPECT_EQ(part.mean[i], whole.mean[i]) << i;
  }
}

TEST(Occluders, TheSweepSeesOccluderSpheres)
{
  // The directions and the points in the texels are the same ones. An occluder of which only a part
  // inside others shows counts as visible where a particle does not: the sweep's shortcuts then
  // differ, within their bias of 0.002 (measured: 0.0007 for one particle, 0 for the others).
  const po::SphereCloud all = cloudOf(mixedScene());
  const Split split(all, 30);
  const po::BakeSettings settings = floatSettings(6, 49);
  const po::BakeResult whole = bakeUnder(all, {}, settings, po::SweepEstimator());
  const po::BakeResult part =
    bakeUnder(split.particles, split.occluders, settings, po::SweepEstimator());
  ASSERT_EQ(part.mean.size(), 30u);
  for (std::size_t i = 0; i < 30; ++i)
  {
    EXPECT_NEAR(part.mean[i], whole.mean[i], 0.002) << i;
  }
}

TEST(Occluders, ThePilotLooksAtParticlesOnly)
{
  const po::SphereCloud all = cloudOf(mixedScene());
  const Split split(all, 30);
  const po::BakeScene scene(split.particles, split.occluders);
  EXPECT_EQ(scene.receivers(), 30u);
  po::Progress progress;
  const po::PilotResult pilot = po::samplesForError(
    scene, allOf(scene), floatSettings(4, 1), po::ReferenceEstimator(), 0.02, progress);
  EXPECT_TRUE(pilot.reached);
}

TEST(Occluders, SpheresArePutIntoTheCoordinatesOfTheParticles)
{
  const po::SphereCloud particles = cloudOf({ { 10, 0, 0, 2 }, { 14, 0, 0, 2 } });
  const po::Vec3d positions[] = { { 12, 6, 0 }, { 0, 0, 1e30 } };
  const po::SphereCloud others = po::makeSphereCloudLike(
    particles, { 2, [&](std::size_t i) { return positions[i]; }, [](std::size_t) { return 8; } });
  ASSERT_EQ(others.spheres.size(), 1u);
  EXPECT_EQ(others.spheres[0].x, 0);
  EXPECT_EQ(others.spheres[0].y, 3);
  EXPECT_EQ(others.spheres[0].radius, 4);
  EXPECT_EQ(others.rejected.outOfRange, 1u);
  EXPECT_TRUE(po::SphereCloud::inRange({ 1e17, 0, 0 }));
  EXPECT_FALSE(po::SphereCloud::inRange({ 0, 1e19, 0 }));
  EXPECT_FALSE(po::SphereCloud::inRange({ 0, 0, std::numeric_limits<double>::quiet_NaN() }));
}

TEST(Occluders, PacketsOfRaysSayWhatSingleRaysSay)
{
  const po::SphereCloud cloud = cloudOf(mixedScene());
  po::Random random(3, 0, 0);
  const po::BakeScene scene(cloud, { {}, square(4, -1, true) });
  unsigned stopped = 0;
  for (unsigned id = 0; id < 50; ++id)
  {
    const po::Sphere& sphere = scene.set().spheres()[id];
    const po::Vec3d direction = po::textureDirection({ random.uniform(), random.uniform() });
    const unsigned count = 1 + id % po::SphereScene::PacketSize;
    const float distance = id % 2 == 0 ? 1.0f : std::numeric_limits<float>::infinity();
    std::vector<po::Vec3f> origins;
    while (origins.size() < count)
    {
      const po::Vec3d normal = po::textureDirection({ random.uniform(), random.uniform() });
      if (dot(normal, direction) > 0)
      {
        origins.push_back(sphere.center() + sphere.radius * normal.as<float>());
      }
    }
    const unsigned packet =
      scene.rays().occludedFrom(origins.data(), count, direction.as<float>(), distance, id);
    for (unsigned i = 0; i < count; ++i)
    {
      const bool single = scene.rays().occluded(origins[i], direction.as<float>(), distance, id);
      EXPECT_EQ((packet >> i & 1) != 0, single) << id << " " << i;
      stopped += single;
    }
    EXPECT_EQ(packet >> count, 0u);
  }
  EXPECT_GT(stopped, 50u);
}

TEST(Occluders, TheDistanceOfTrianglesIsThatOfTheirNearestPoint)
{
  const po::SphereCloud cloud = cloudOf({ { 0, 0, 0, 1 } });
  const po::SphereScene scene(cloud.spheres, square(2, -3, true));
  EXPECT_FALSE(scene.isMeshWithin({ 0, 0, 0 }, 2.99f));
  EXPECT_TRUE(scene.isMeshWithin({ 0, 0, 0 }, 3.01f));
  EXPECT_TRUE(scene.isMeshWithin({ 1.5f, -1, -6 }, 3.01f)); // from the other side
  EXPECT_FALSE(scene.isMeshWithin({ 6, 0, 0 }, 4.99f));     // an edge: 4 across, 3 up
  EXPECT_TRUE(scene.isMeshWithin({ 6, 0, 0 }, 5.01f));
  EXPECT_FALSE(scene.isMeshWithin({ 5, 6, -3 }, 4.99f)); // a corner: 3 and 4 across
  EXPECT_TRUE(scene.isMeshWithin({ 5, 6, -3 }, 5.01f));
  EXPECT_FALSE(po::SphereScene(cloud.spheres).isMeshWithin({ 0, 0, 0 }, 100));

  // A slope's box holds the point, the slope itself does not come near.
  po::OccluderMesh slope;
  slope.vertices = { { 0, 0, 0 }, { 10, 0, 10 }, { 10, 1, 10 } };
  slope.triangles = { { 0, 1, 2 } };
  const po::SphereScene aslant(cloud.spheres, slope);
  EXPECT_FALSE(aslant.isMeshWithin({ 8, 0.5f, 2 }, 4));
  EXPECT_TRUE(aslant.isMeshWithin({ 8, 0.5f, 2 }, 4.5f));
}
}
