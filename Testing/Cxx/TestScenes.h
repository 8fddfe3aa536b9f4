// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TestScenes_h
#define po_TestScenes_h

// Small scenes of spheres, and short ways to bake them.

#include "OcclusionEstimator.h"
#include "Random.h"
#include "Sphere.h"
#include "SphereCloud.h"
#include "VisibilityJudge.h"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

inline po::SphereCloud cloudOf(const std::vector<po::Sphere>& spheres)
{
  return po::makeSphereCloud(
    spheres.size(), [&](std::size_t i) { return spheres[i].center().as<double>(); },
    [&](std::size_t i) { return static_cast<double>(spheres[i].radius); });
}

/// Judges the same spheres in double precision.
inline judge::Judge judgeOf(const std::vector<po::Sphere>& spheres)
{
  std::vector<judge::Ball> balls;
  for (const po::Sphere& s : spheres)
  {
    balls.push_back({ s.center().as<double>(), static_cast<double>(s.radius) });
  }
  return judge::Judge(balls);
}

inline po::BakeSettings floatSettings(int resolution, int samples)
{
  po::BakeSettings settings;
  settings.textureResolution = resolution;
  settings.samplesPerTexel = samples;
  settings.encoding = po::Encoding::Float32Linear;
  return settings;
}

/// Spheres on a sphere of radius `distance` about the origin, overlapping so that no gap is left.
inline void addClosedShell(
  std::vector<po::Sphere>& spheres, double distance, double radius, int count)
{
  const double golden = 3.14159265358979323846 * (3 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i)
  {
    const double z = 1 - (2 * i + 1.0) / count;
    const double r = std::sqrt(1 - z * z);
    const po::Vec3d p =
      distance * po::Vec3d{ r * std::cos(golden * i), r * std::sin(golden * i), z };
    spheres.push_back({ static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
      static_cast<float>(radius) });
  }
}

/// A cloud with overlaps, contacts and unequal radii.
inline std::vector<po::Sphere> mixedScene()
{
  po::Random random(4, 0, 0);
  std::vector<po::Sphere> spheres;
  for (int i = 0; i < 60; ++i)
  {
    const auto coordinate = [&] { return static_cast<float>(6 * random.uniform()); };
    spheres.push_back({ coordinate(), coordinate(), coordinate(),
      static_cast<float>(0.3 + 0.9 * random.uniform()) });
  }
  return spheres;
}

/// Values and outside shares of all particles, as the estimator finds them.
struct Estimates
{
  std::vector<float> values;
  std::vector<float> shares;
};

inline Estimates estimateList(const po::OcclusionEstimator& estimator, const po::BakeScene& scene,
  const std::vector<unsigned>& particles, const po::BakeSettings& settings,
  po::BakeCounters* counters = nullptr)
{
  const auto texels =
    static_cast<std::size_t>(settings.textureResolution * settings.textureResolution);
  Estimates found;
  po::Progress progress;
  po::BakeCounters ignored;
  estimator.estimate(
    scene, particles, settings, progress,
    [&](const po::RawTextures& raw)
    {
      found.values.insert(found.values.end(), raw.values, raw.values + raw.count * texels);
      found.shares.insert(
        found.shares.end(), raw.outsideShares, raw.outsideShares + raw.count * texels);
    },
    counters != nullptr ? *counters : ignored);
  return found;
}

/// All particles of a scene.
inline std::vector<unsigned> allOf(const po::BakeScene& scene)
{
  std::vector<unsigned> all(scene.receivers());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

inline Estimates estimateAll(const po::OcclusionEstimator& estimator, const po::BakeScene& scene,
  const po::BakeSettings& settings, po::BakeCounters* counters = nullptr)
{
  return estimateList(estimator, scene, allOf(scene), settings, counters);
}

#endif
