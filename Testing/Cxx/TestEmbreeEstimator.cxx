// SPDX-License-Identifier: BSD-3-Clause
#include "EmbreeEstimator.h"
#include "EstimateDifference.h"
#include "OcclusionBaker.h"
#include "ReferenceEstimator.h"
#include "SyntheticSpheres.h"
#include "TestScenes.h"
#include "TexelMap.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
po::EmbreeEstimator embreeOf(int directions)
{
  po::EmbreeOptions options;
  options.directions = directions;
  return po::EmbreeEstimator(options);
}

/// Embree against Reference with many rays: no bias above 0.002, and an RMS difference that 2048
/// directions leave.
void expectLikeReference(const po::BakeScene& scene, const po::BakeSettings& settings, double rms)
{
  po::BakeSettings fine = settings;
  fine.samplesPerTexel = 4000;
  const Estimates judge = estimateAll(po::ReferenceEstimator(), scene, fine);
  const Estimates ours = estimateAll(embreeOf(2048), scene, settings);
  const Difference difference = compare(ours, judge, settings.textureResolution);
  EXPECT_LT(difference.rms, rms);
  EXPECT_LT(std::abs(difference.bias), 0.002);
}

void expectLikeReference(
  const std::vector<po::Sphere>& spheres, const po::BakeSettings& settings, double rms = 0.01)
{
  const po::SphereCloud cloud = cloudOf(spheres);
  expectLikeReference(po::BakeScene(cloud), settings, rms);
}

/// A rectangle about `middle` that the vectors `u` and `v` span.
void addRectangle(po::OccluderMesh& mesh, po::Vec3f middle, po::Vec3f u, po::Vec3f v)
{
  const auto first = static_cast<unsigned>(mesh.vertices.size());
  mesh.vertices.push_back(middle - u - v);
  mesh.vertices.push_back(middle + u - v);
  mesh.vertices.push_back(middle + u + v);
  mesh.vertices.push_back(middle - u + v);
  mesh.triangles.push_back({ first, first + 1, first + 2 });
  mesh.triangles.push_back({ first, first + 2, first + 3 });
}

po::Occluders ground(float z)
{
  po::Occluders occluders;
  addRectangle(occluders.mesh, { 0, 0, z }, { 1e4f, 0, 0 }, { 0, 1e4f, 0 });
  return occluders;
}

/// The six sides of a cube about the origin.
po::Occluders cube(float reach)
{
  po::Occluders occluders;
  for (const float side : { -reach, reach })
  {
    addRectangle(occluders.mesh, { side, 0, 0 }, { 0, reach, 0 }, { 0, 0, reach });
    addRectangle(occluders.mesh, { 0, side, 0 }, { 0, 0, reach }, { reach, 0, 0 });
    addRectangle(occluders.mesh, { 0, 0, side }, { reach, 0, 0 }, { 0, reach, 0 });
  }
  return occluders;
}

TEST(EmbreeEstimator, AClosedShellIsDarkInside)
{
  // Near and far: its spheres are listed, or met by rays.
  for (const double distance : { 3.5, 8.0 })
  {
    std::vector<po::Sphere> spheres{ { 0, 0, 0, 1 } };
    addClosedShell(spheres, distance, 2, 400);
    const po::SphereCloud cloud = cloudOf(spheres);
    const Estimates ours =
      estimateAll(po::EmbreeEstimator(), po::BakeScene(cloud), floatSettings(8, 49));
    EXPECT_EQ(*std::max_element(ours.values.begin(), ours.values.begin() + 64), 0.0f);
    EXPECT_GT(*std::max_element(ours.values.begin() + 64, ours.values.end()), 0.9f);
  }
}

TEST(EmbreeEstimator, AgreesWithReferenceWhereMoreSpheresAreNearThanAreListed)
{
  // A ball in a cloud of dust: most grains are met by rays, of every texel.
  std::vector<po::Sphere> spheres{ { 0, 0, 0, 1 } };
  po::Random random(5, 0, 0);
  while (spheres.size() < 400)
  {
    const auto coordinate = [&] { return static_cast<float>(4 * random.uniform() - 2); };
    spheres.push_back({ coordinate(), coordinate(), coordinate(), 0.1f });
  }
  expectLikeReference(spheres, floatSettings(6, 49), 0.012);
}

/// A ball in dust so thick that the nearest 128 grains are a part of what is near, and end close to
/// it.
std::vector<po::Sphere> dustyBall()
{
  std::vector<po::Sphere> spheres{ { 0, 0, 0, 1 } };
  po::Random random(6, 0, 0);
  while (spheres.size() < 800)
  {
    const auto coordinate = [&] { return static_cast<float>(4.4 * random.uniform() - 2.2); };
    const po::Sphere grain{ coordinate(), coordinate(), coordinate(), 0.1f };
    const float distance = length(grain.center());
    if (distance > 1.1f && distance < 2.2f)
    {
      spheres.push_back(grain);
    }
  }
  return spheres;
}

/// What all seeds have in common, on the first particle alone.
Difference differenceOfSeeds(
  const po::BakeScene& scene, po::BakeSettings settings, int seeds, int samples)
{
  Estimates mean;
  for (int seed = 1; seed <= seeds; ++seed)
  {
    settings.seed = static_cast<std::uint64_t>(seed);
    const Estimates one = estimateList(embreeOf(512), scene, { 0 }, settings);
    mean.values.resize(one.values.size());
    std::transform(one.values.begin(), one.values.end(), mean.values.begin(), mean.values.begin(),
      [=](float value, float sum) { return sum + value / static_cast<float>(seeds); });
  }
  settings.samplesPerTexel = samples;
  const Estimates judge = estimateList(po::ReferenceEstimator(), scene, { 0 }, settings);
  return compare(mean, judge, settings.textureResolution);
}

TEST(EmbreeEstimator, AFullListOfNearSpheresIsNotTakenForAll)
{
  // With a maximum distance only the full list asks for rays; without one, for rays of every texel,
  // or shadows from close by would be blurred.
  const po::SphereCloud cloud = cloudOf(dustyBall());
  const po::BakeScene scene(cloud);
  for (const double distance : { 0.0, 2.0 })
  {
    SCOPED_TRACE(distance);
    po::BakeSettings settings = floatSettings(16, 49);
    settings.maximumDistance = distance;
    EXPECT_LT(differenceOfSeeds(scene, settings, 8, 1000).rms, 0.02);
  }
}

TEST(EmbreeEstimator, RaysThatStandForManyTexelsKeepTheMean)
{
  // A large sphere just beyond the near ones, above or below: from the upper texels of each square
  // it looks larger, or smaller, than from all of them, and likewise from those that face it less.
  for (const float side : { -1.0f, 1.0f })
  {
    SCOPED_TRACE(side);
    const po::SphereCloud cloud = cloudOf({ { 0, 0, 0, 1 }, { 0, 0, side * 14.1f, 10 } });
    const Difference difference =
      differenceOfSeeds(po::BakeScene(cloud), floatSettings(4, 49), 64, 40000);
    EXPECT_LT(std::abs(difference.bias), 0.0012);
  }
}

TEST(EmbreeEstimator, AgreesWithReferenceAmongTriangles)
{
  // A cup of walls that lie aslant: they touch and cut some of the particles, and are far from
  // others.
  po::Occluders walls;
  addRectangle(walls.mesh, { 0, 0, -2.5f }, { 4, 0, 1 }, { 0, 4, 0 });
  addRectangle(walls.mesh, { 3, 0, 1 }, { 1, 1, 3 }, { -2, 3, 0 });
  addRectangle(walls.mesh, { -3, -2, 2 }, { 0.5f, 0, 1 }, { 0, 1, 0 });
  const po::SphereCloud cloud = cloudOf(mixedScene());
  const po::BakeScene scene(cloud, walls);
  expectLikeReference(scene, floatSettings(6, 49), 0.01);
  po::BakeSettings bounded = floatSettings(6, 49);
  bounded.maximumDistance = 1;
  expectLikeReference(scene, bounded, 0.01);
}

TEST(EmbreeEstimator, NearTrianglesCastSharpShadows)
{
  // Small plates all around, nearly in contact: rays that stood for many texels would blur their
  // shadows.
  po::Occluders plates;
  for (const float side : { -1.2f, 1.2f })
  {
    addRectangle(plates.mesh, { side, 0, 0 }, { 0, 0.3f, 0 }, { 0, 0, 0.3f });
    addRectangle(plates.mesh, { 0, side, 0 }, { 0, 0, 0.3f }, { 0.3f, 0, 0 });
    addRectangle(plates.mesh, { 0, 0, side }, { 0.3f, 0, 0 }, { 0, 0.3f, 0 });
  }
  const po::SphereCloud cloud = cloudOf({ { 0, 0, 0, 1 } });
  const po::BakeScene scene(cloud, plates);
  const Estimates judge = estimateAll(po::ReferenceEstimator(), scene, floatSettings(12, 4000));
  const Estimates ours = estimateAll(embreeOf(512), scene, floatSettings(12, 49));
  EXPECT_LT(compare(ours, judge, 12).rms, 0.03);
}

TEST(EmbreeEstimator, ASphereOnAPlaneSeesHalfTheSky)
{
  // Over a plane the visible share is (1 + n.z) / 2, whether the plane touches or is far below.
  // Measured: the error of a texel with 2048 directions is below 0.012.
  constexpr int resolution = 16;
  for (const float z : { -1.0f, -2.0f, -50.0f })
  {
    const po::SphereCloud cloud = cloudOf({ { 0, 0, 0, 1 } });
    const Estimates ours =
      estimateAll(embreeOf(2048), po::BakeScene(cloud, ground(z)), floatSettings(resolution, 49));
    for (int row = 0; row < resolution; ++row)
    {
      const double top = std::cos(3.14159265358979 * row / resolution);
      const double bottom = std::cos(3.14159265358979 * (row + 1) / resolution);
      const double expected = (1 + (top + bottom) / 2) / 2; // mean over the texel's area
      for (int column = 0; column < resolution; ++column)
      {
        EXPECT_NEAR(ours.values[po::texelIndex(resolution, row, column)], expected, 0.02)
          << z << " " << row << " " << column;
      }
    }
  }
}

TEST(EmbreeEstimator, NoRayLeavesAClosedBox)
{
  for (const float reach : { 2.0f, 30.0f })
  {
    const po::SphereCloud cloud = cloudOf({ { 0, 0, 0, 1 } });
    const Estimates ours =
      estimateAll(embreeOf(1024), po::BakeScene(cloud, cube(reach)), floatSettings(16, 49));
    EXPECT_EQ(std::count(ours.values.begin(), ours.values.end(), 0.0f), 256);
  }
}

TEST(EmbreeEstimator, TrianglesBeyondTheMaximumDistanceDoNotOcclude)
{
  const po::SphereCloud cloud = cloudOf({ { 0, 0, 0, 1 } });
  const po::BakeScene scene(cloud, ground(-3));
  po::BakeSettings settings = floatSettings(8, 49);
  settings.maximumDistance = 1.9; // the plane is 2 away
  const Estimates open = estimateAll(po::EmbreeEstimator(), scene, settings);
  EXPECT_EQ(*std::min_element(open.values.begin(), open.values.end()), 1.0f);
  settings.maximumDistance = 2.5;
  const Estimates shaded = estimateAll(po::EmbreeEstimator(), scene, settings);
  EXPECT_LT(*std::min_element(shaded.values.begin(), shaded.values.end()), 0.9f);
}

TEST(EmbreeEstimator, GivesTheSameBitsForAnyNumberOfThreads)
{
  std::vector<po::Sphere> spheres = mixedScene();
  addClosedShell(spheres, 30, 1, 3000);
  const po::SphereCloud cloud = cloudOf(spheres);
  const po::BakeScene scene(cloud, ground(-4));
  for (const double targetError : { 0.0, 0.03 })
  {
    po::EmbreeOptions options;
    options.directions = 64;
    options.targetError = targetError;
    std::vector<Estimates> results;
    std::vector<double> errors;
    for (const std::size_t threads : { 1, 2, 7 })
    {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      const po::EmbreeEstimator embree(options);
      results.push_back(estimateAll(embree, scene, floatSettings(8, 49)));
      errors.push_back(embree.report().estimatedError);
    }
    EXPECT_EQ(results[1].values, results[0].values);
    EXPECT_EQ(results[2].values, results[0].values);
    EXPECT_EQ(results[1].shares, results[0].shares);
    EXPECT_EQ(results[2].shares, results[0].shares);
    EXPECT_EQ(errors[1], errors[0]);
    EXPECT_EQ(errors[2], errors[0]);
  }
}

TEST(EmbreeEstimator, ReachesATargetErrorParticleByParticle)
{
  const po::SphereCloud cloud = cloudOf(mixedScene());
  const po::BakeScene scene(cloud);
  const Estimates judge = estimateAll(po::ReferenceEstimator(), scene, floatSettings(6, 20000));
  for (const double target : { 0.05, 0.02, 0.01 })
  {
    po::EmbreeOptions options;
    options.targetError = target;
    const po::EmbreeEstimator embree(options);
    const Estimates ours = estimateAll(embree, scene, floatSettings(6, 1));
    EXPECT_TRUE(embree.report().reached);
    EXPECT_LE(embree.report().estimatedError, target);
    EXPECT_LE(embree.report().above, 1u); // of one particle only 1 % is outside others
    const Difference difference = compare(ours, judge, 6);
    EXPECT_LT(difference.rms, 1.1 * target);
    EXPECT_LT(std::abs(difference.bias), 0.002 + 0.1 * target);
  }
}

TEST(EmbreeEstimator, SaysWhatItDid)
{
  const po::SphereCloud cloud = cloudOf({ { 0, 0, 0, 1 }, { 5, 0, 0, 1 }, { 5, 0, 0, 0.5f } });
  const po::BakeScene scene(cloud);
  po::BakeSettings settings = floatSettings(16, 49);
  settings.background = po::ImageBackground{ 4, 2, { 1, 1, 1, 1, 0, 0, 0, 0 } };
  const po::EmbreeEstimator embree = embreeOf(100);
  po::Progress progress;
  const po::BakeResult result = po::bakeOcclusion(scene, settings, embree, progress);
  EXPECT_EQ(result.counters.particles, 3u);
  EXPECT_EQ(result.counters.particlesBuried, 1u);
  EXPECT_EQ(result.counters.texels, 3 * 256u);
  EXPECT_EQ(result.counters.texelsInside, 256u);
  EXPECT_GT(result.counters.rays, 100u);
  EXPECT_LT(result.counters.rays, 2 * 100 * 16u); // at most one for each group
  EXPECT_GE(result.counters.threads, 1u);
  EXPECT_EQ(embree.report().directions + static_cast<int>(result.counters.directionsBlack), 100);
  EXPECT_GT(result.counters.directionsBlack, 0u);
  EXPECT_GT(embree.report().estimatedError, 0);
}

TEST(EmbreeEstimator, AListGetsWhatTheWholeSetGets)
{
  const po::SphereCloud cloud = cloudOf(mixedScene());
  const po::BakeScene scene(cloud);
  const po::BakeSettings settings = floatSettings(8, 49);
  for (const double targetError : { 0.0, 0.02 })
  {
    po::EmbreeOptions options;
    options.targetError = targetError;
    const po::EmbreeEstimator embree(options);
    const Estimates all = estimateAll(embree, scene, settings);
    const std::vector<unsigned> list{ 42, 3, 17 };
    std::vector<float> values;
    po::Progress progress;
    po::BakeCounters counters;
    embree.estimate(
      scene, list, settings, progress,
      [&](const po::RawTextures& raw)
      { values.insert(values.end(), raw.values, raw.values + raw.count * 64); },
      counters);
    ASSERT_EQ(values.size(), 3 * 64u);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      EXPECT_EQ(values[i], all.values[list[i / 64] * 64 + i % 64]);
    }
  }
}

TEST(EmbreeEstimator, AnEmptyListIsNoError)
{
  const po::SphereCloud cloud = cloudOf({ { 0, 0, 0, 1 } });
  po::Progress progress;
  po::BakeCounters counters;
  po::EmbreeEstimator().estimate(
    po::BakeScene(cloud), {}, floatSettings(8, 49), progress,
    [](const po::RawTextures&) { FAIL(); }, counters);
  EXPECT_EQ(counters.particles, 0u);
}
}
