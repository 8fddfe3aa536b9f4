// SPDX-License-Identifier: BSD-3-Clause
/// Direct light that is baked into the textures, against formulas and brute force.

#include "Constants.h"
#include "EmbreeEstimator.h"
#include "EstimateDifference.h"
#include "OcclusionBaker.h"
#include "ReferenceEstimator.h"
#include "SweepEstimator.h"
#include "TestScenes.h"
#include "TexelMap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace
{
constexpr int Resolution = 12;
constexpr std::size_t Texels = Resolution * Resolution;
const po::Vec3d Shining{ 0.3, -0.5, -1 };

enum class Sky
{
  Open, ///< luminance 1 from everywhere
  Black
};

po::BakeSettings settingsWith(double intensity, Sky sky)
{
  po::BakeSettings settings = floatSettings(Resolution, 9);
  settings.light = po::DistantLight{ Shining, intensity };
  settings.dilateInside = false;
  if (sky == Sky::Black)
  {
    settings.background = po::GradientBackground{ { 0, 0, 1 }, 0, 0 };
  }
  return settings;
}

po::BakeResult bake(const po::BakeScene& scene, const po::BakeSettings& settings,
  const po::OcclusionEstimator& estimator = po::EmbreeEstimator())
{
  po::Progress progress;
  return po::bakeOcclusion(scene, settings, estimator, progress);
}

std::array<float, Texels> textureOf(const po::BakeResult& result, std::size_t particle)
{
  std::array<float, Texels> texture;
  std::copy_n(
    result.table.floats.data() + Texels * static_cast<std::size_t>(result.rowOf[particle]), Texels,
    texture.data());
  return texture;
}

constexpr int JudgedSide = 30;
constexpr int JudgedPoints = JudgedSide * JudgedSide;

/// D of a texel by many points and a loop over spheres, in double precision; and how its points are
/// shared out.
struct Judged
{
  double light = 0;
  double outside = 0; ///< share of the points
  int facing = 0, lit = 0;
};

/// The spheres that can hold a point of a particle or stand in its light.
std::vector<std::size_t> candidates(const po::SphereCloud& cloud, std::size_t id)
{
  const po::Vec3d toLight = -po::normalized(Shining);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < cloud.spheres.size(); ++i)
  {
    const po::Vec3d way = cloud.center(i) - cloud.center(id);
    const double touch = 1.01 * (cloud.spheres[i].radius + cloud.spheres[id].radius);
    const double ahead = dot(way, toLight);
    if (i != id && ahead > -touch && dot(way, way) - ahead * ahead < touch * touch)
    {
      found.push_back(i);
    }
  }
  return found;
}

Judged judge(const po::SphereCloud& cloud, std::size_t id, const std::vector<std::size_t>& others,
  std::size_t texel, double reach)
{
  const int row = static_cast<int>(texel) / Resolution,
            column = static_cast<int>(texel) % Resolution;
  const po::Vec3d toLight = -po::normalized(Shining);
  const auto radiusOf = [&](std::size_t i) { return double(cloud.spheres[i].radius); };
  Judged judged;
  int outside = 0;
  for (int k = 0; k < JudgedPoints; ++k)
  {
    const double s = (k % JudgedSide + 0.5) / JudgedSide, t = (k / JudgedSide + 0.5) / JudgedSide;
    const po::Vec3d n = po::texelPoint(Resolution, row, column, s, t);
    bool inside = false, blocked = false;
    for (const std::size_t i : others)
    {
      const po::Vec3d way = cloud.center(i) - cloud.center(id) - radiusOf(id) * n;
      const double ahead = dot(way, toLight);
      const double across = dot(way, way) - ahead * ahead;
      const double squared = radiusOf(i) * radiusOf(i);
      inside = inside || dot(way, way) < squared;
      blocked =
        blocked || (ahead > 0 && across < squared && ahead - std::sqrt(squared - across) < reach);
    }
    const double cosine = dot(n, toLight);
    outside += !inside;
    judged.facing += !inside && cosine > 0;
    judged.lit += !inside && cosine > 0 && !blocked;
    judged.light += !inside && !blocked ? std::max(0.0, cosine) : 0;
  }
  judged.outside = outside / double(JudgedPoints);
  judged.light = outside > 0 ? judged.light / outside : 0;
  return judged;
}

/// All texels of 20 to 40 particles against the judge. 32 points of each texel leave an error where
/// a shadow's edge crosses it: of 0.02 RMS at most, and no texel that is far from an edge is off by
/// more than the spread of the cosine within a texel.
void expectLikeJudge(const po::SphereCloud& cloud, double maximumDistance)
{
  po::BakeSettings settings = settingsWith(1, Sky::Black);
  settings.maximumDistance = maximumDistance;
  const po::BakeScene scene(cloud);
  const po::BakeResult result = bake(scene, settings);
  double squares = 0, bias = 0;
  std::size_t count = 0;
  const std::size_t step = std::max<std::size_t>(1, cloud.spheres.size() / 20);
  for (std::size_t id = 0; id < cloud.spheres.size(); id += step)
  {
    const auto texture = textureOf(result, id);
    const std::vector<std::size_t> others = candidates(cloud, id);
    for (std::size_t texel = 0; texel < Texels; ++texel)
    {
      const Judged judged = judge(cloud, id, others, texel, cloud.toLocalReach(maximumDistance));
      if (judged.outside < 0.25)
      {
        continue;
      }
      const double difference = 2 * double(texture[texel]) - judged.light;
      squares += difference * difference;
      bias += difference;
      ++count;
      if (judged.facing == 0 || judged.lit == 0)
      {
        EXPECT_LT(texture[texel], 0.01) << id << " " << texel; // dark
      }
      else if (judged.outside == 1 && judged.lit == JudgedPoints)
      {
        EXPECT_NEAR(2 * texture[texel], judged.light, 0.03) << id << " " << texel;
      }
    }
  }
  ASSERT_GT(count, 900u);
  EXPECT_LT(std::sqrt(squares / double(count)), 0.02);
  EXPECT_LT(std::abs(bias / double(count)), 0.001);
}

TEST(BakedLight, ShadowsAreThoseOfBruteForce)
{
  expectLikeJudge(cloudOf(mixedScene()), 0);
  expectLikeJudge(cloudOf(wideScene()), 0);
  expectLikeJudge(cloudOf(syntheticScene(po::SyntheticFamily::Gas, 400)), 0);
}

TEST(BakedLight, OnlyWhatIsWithinTheMaximumDistanceCastsShadows)
{
  expectLikeJudge(cloudOf(mixedScene()), 0.5);
  expectLikeJudge(cloudOf(syntheticScene(po::SyntheticFamily::Gas, 400)), 3);
}

TEST(BakedLight, OfALoneParticleIsTheCosine)
{
  const po::SphereCloud cloud = cloudOf({ { 5, 6, 7, 2 } });
  const po::BakeResult result = bake(po::BakeScene(cloud), settingsWith(1, Sky::Black));
  EXPECT_NEAR(result.mean[0], 0.5 / 4, 1e-3); // the mean of max(0, cos) over a sphere is 1/4
  const auto texture = textureOf(result, 0);
  for (std::size_t texel = 0; texel < Texels; ++texel)
  {
    EXPECT_NEAR(2 * texture[texel], judge(cloud, 0, {}, texel, HUGE_VAL).light, 0.02) << texel;
  }
}

TEST(BakedLight, ASphereInFrontDarkensWhatLiesBehindIt)
{
  // The larger one, 30 radii away on the way to the light, covers the other; beside it, it does
  // not.
  const po::Vec3d toLight = -po::normalized(Shining);
  const po::Vec3f inFront = (30.0 * toLight).as<float>();
  const po::Vec3f across = po::normalized(cross(toLight, po::Vec3d{ 1, 0, 0 })).as<float>();
  const po::Vec3f beside = inFront + 3.01f * across;
  for (const auto& [center, expected] :
    { std::pair(inFront, 0.0), std::pair(beside, 0.5 / 4), std::pair(-1.0f * inFront, 0.5 / 4) })
  {
    const po::BakeResult result =
      bake(po::BakeScene(cloudOf({ { 0, 0, 0, 1 }, { center.x, center.y, center.z, 2 } })),
        settingsWith(1, Sky::Black));
    EXPECT_NEAR(result.mean[0], expected, expected > 0 ? 1e-3 : 0.0);
  }
}

TEST(BakedLight, TrianglesCastShadowsFromBothSides)
{
  const po::SphereCloud cloud = cloudOf({ { 0, 0, 0, 1 } });
  const auto meanUnder = [&](float z, bool frontUp, double maximumDistance)
  {
    po::OccluderMesh roof;
    roof.vertices = { { -100, -100, z }, { 100, -100, z }, { 0, 100, z } };
    roof.triangles = { { 0, frontUp ? 1u : 2u, frontUp ? 2u : 1u } };
    po::BakeSettings settings = settingsWith(1, Sky::Black);
    settings.maximumDistance = maximumDistance;
    return bake(po::BakeScene(cloud, { {}, roof }), settings).mean[0];
  };
  for (const bool frontUp : { true, false })
  {
    EXPECT_EQ(meanUnder(3, frontUp, 0), 0);
    EXPECT_EQ(meanUnder(3, frontUp, 10), 0);
    EXPECT_NEAR(meanUnder(30, frontUp, 10), 0.5 / 4, 1e-3);
    EXPECT_NEAR(meanUnder(-3, frontUp, 0), 0.5 / 4, 1e-3);
  }
}

TEST(BakedLight, IsTheSameWithEveryMethodAndList)
{
  const po::SphereCloud cloud = cloudOf(mixedScene());
  const po::BakeScene scene(cloud);
  const po::BakeSettings settings = settingsWith(2, Sky::Black);
  const po::BakeResult embree = bake(scene, settings);
  EXPECT_EQ(embree.counters.rays, 0u);
  for (const po::BakeResult& other : { bake(scene, settings, po::SweepEstimator()),
         bake(scene, settings, po::ReferenceEstimator()) })
  {
    EXPECT_TRUE(other.table.floats == embree.table.floats);
    EXPECT_TRUE(other.rowOf == embree.rowOf);
    EXPECT_TRUE(other.mean == embree.mean);
  }
  po::Progress progress;
  const po::BakeResult two =
    po::bakeOcclusion(scene, { 17, 41 }, settings, po::SweepEstimator(), progress);
  EXPECT_TRUE(textureOf(two, 0) == textureOf(embree, 17));
  EXPECT_TRUE(textureOf(two, 1) == textureOf(embree, 41));
}

TEST(BakedLight, IsTheSameWhereTrianglesTakeRays)
{
  // A triangle that shades nothing. A point may be decided otherwise where a ray grazes a sphere.
  po::Occluders below;
  below.mesh.vertices = { { 0, 0, -900 }, { 1, 0, -900 }, { 0, 1, -900 } };
  below.mesh.triangles = { { 0, 1, 2 } };
  for (const std::vector<po::Sphere>& spheres :
    { mixedScene(), wideScene(), syntheticScene(po::SyntheticFamily::Gas, 500) })
  {
    for (const double distance : { 0.0, 2.0 })
    {
      const po::SphereCloud cloud = cloudOf(spheres);
      po::BakeSettings settings = settingsWith(1, Sky::Black);
      settings.maximumDistance = distance;
      const po::BakeResult swept = bake(po::BakeScene(cloud), settings);
      const po::BakeResult traced = bake(po::BakeScene(cloud, below), settings);
      EXPECT_GT(traced.counters.rays, 0u);
      std::size_t differ = 0;
      for (std::size_t id = 0; id < spheres.size(); ++id)
      {
        const auto a = textureOf(swept, id), b = textureOf(traced, id);
        for (std::size_t texel = 0; texel < Texels; ++texel)
        {
          differ += std::abs(a[texel] - b[texel]) > 1e-5f;
        }
      }
      EXPECT_LT(static_cast<double>(differ), 2e-3 * static_cast<double>(Texels * spheres.size()));
    }
  }
}

TEST(BakedLight, IsMixedByItsIntensity)
{
  const po::SphereCloud cloud = cloudOf(mixedScene());
  const po::BakeScene scene(cloud);
  po::BakeSettings without = settingsWith(0, Sky::Open);
  without.light.reset();
  const po::EmbreeEstimator embree;
  const po::BakeResult occlusion = bake(scene, without, embree);
  const po::BakeResult light = bake(scene, settingsWith(1, Sky::Black), embree);
  EXPECT_TRUE(
    bake(scene, settingsWith(0, Sky::Open), embree).table.floats == occlusion.table.floats);
  for (const double intensity : { 0.25, 1.0, 8.0 })
  {
    const po::BakeResult both = bake(scene, settingsWith(intensity, Sky::Open), embree);
    float largest = 0;
    for (std::size_t id = 0; id < cloud.spheres.size(); ++id)
    {
      const auto a = textureOf(occlusion, id), d = textureOf(light, id), sum = textureOf(both, id);
      for (std::size_t texel = 0; texel < Texels; ++texel)
      {
        const double expected = (a[texel] + intensity * 2 * d[texel]) / (1 + intensity);
        ASSERT_NEAR(sum[texel], expected, 1e-6) << intensity << " " << id << " " << texel;
        largest = std::max(largest, sum[texel]);
      }
    }
    EXPECT_LE(largest, 1) << "values do not grow beyond those without a light";
    EXPECT_GT(largest, 0.8);
  }
}

TEST(BakedLight, BytesKeepValuesAboveOneToo)
{
  // A background brighter than 1: bytes scale with the largest value, and nothing is cut off.
  const po::SphereCloud cloud = cloudOf(mixedScene());
  const po::BakeScene scene(cloud);
  po::BakeSettings settings = settingsWith(1, Sky::Open);
  settings.background = po::GradientBackground{ -Shining, 0, 6 };
  const po::BakeResult floats = bake(scene, settings);
  settings.encoding = po::Encoding::UInt8Gamma2;
  const po::BakeResult bytes = bake(scene, settings);
  const auto largest = *std::max_element(floats.table.floats.begin(), floats.table.floats.end());
  EXPECT_GT(largest, 1.5);
  EXPECT_EQ(bytes.table.maximum, double(largest));
  for (std::size_t id = 0; id < cloud.spheres.size(); ++id)
  {
    const auto linear = textureOf(floats, id);
    for (std::size_t texel = 0; texel < Texels; ++texel)
    {
      const std::size_t place = Texels * static_cast<std::size_t>(bytes.rowOf[id]) + texel;
      // Half a step of the square root, at its steepest.
      EXPECT_NEAR(po::decodeGamma2(bytes.table.bytes[place], bytes.table.maximum), linear[texel],
        double(largest) / 255);
    }
  }
}

TEST(BakedLight, WhatNoLightReachesIsZero)
{
  std::vector<po::Sphere> spheres{ { 0, 0, 0, 1 } };
  addClosedShell(spheres, 6, 1, 400);
  const po::BakeResult result =
    bake(po::BakeScene(cloudOf(spheres)), settingsWith(1, Sky::Open), po::SweepEstimator());
  EXPECT_EQ(result.mean[0], 0);
  const auto texture = textureOf(result, 0);
  EXPECT_EQ(std::count(texture.begin(), texture.end(), 0.0f), std::ptrdiff_t(Texels));
}

TEST(BakedLight, FewAndManyTexelsHaveTheSameLight)
{
  // The mean over a sphere does not depend on how fine it is cut.
  const po::SphereCloud cloud = cloudOf(mixedScene());
  const po::BakeScene scene(cloud);
  po::BakeSettings settings = settingsWith(1, Sky::Black);
  const po::BakeResult fine = bake(scene, settings);
  settings.textureResolution = 3;
  const po::BakeResult coarse = bake(scene, settings);
  for (std::size_t id = 0; id < cloud.spheres.size(); ++id)
  {
    EXPECT_NEAR(coarse.mean[id], fine.mean[id], 0.005) << id;
  }
}

TEST(BakedLight, StopsWhenItIsAborted)
{
  const po::SphereCloud cloud = cloudOf(mixedScene());
  const po::BakeScene scene(cloud);
  po::Progress* asked = nullptr;
  po::Progress progress(
    [&](double) { return asked->phase().find("Textures") != 0; }, std::chrono::milliseconds(0));
  asked = &progress;
  const po::BakeResult result =
    po::bakeOcclusion(scene, settingsWith(1, Sky::Open), po::SweepEstimator(), progress);
  EXPECT_TRUE(result.aborted);
}
}
