// SPDX-License-Identifier: BSD-3-Clause
/// How much of a Reference bake is Embree and ray generation, and how its ray rate compares with a
/// bare loop of rtcOccluded1 over the same rays. Everything runs on one thread.
///
/// Bake/FAMILY      the estimator: rays, exact overlaps, sums, bookkeeping
/// Generate/FAMILY  making the same number of rays with the same functions, without tracing them
/// Bare/FAMILY      rtcOccluded1 over stored rays, without any filter: the upper limit of the rate
///
/// share = (Generate + Bare) / Bake is what the bake spends in Embree or in ray generation.

#include "Embree.h"
#include "OcclusionBaker.h"
#include "ReferenceEstimator.h"
#include "Sampling.h"
#include "SyntheticSpheres.h"
#include "TexelMap.h"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace
{
constexpr std::size_t Particles = 100000;
constexpr std::size_t BakedParticles = 128;
constexpr int Resolution = 16;
constexpr int Samples = 49;

struct Ray
{
  po::Vec3f origin;
  po::Vec3f direction;
};

/// A family of spheres and the particles that are baked, the same for all benchmarks.
struct Workload
{
  explicit Workload(const std::string& family)
    : spheres(po::makeSyntheticSpheres(*po::syntheticFamilyFromName(family), Particles, 1))
    , cloud(po::makeSphereCloud(
        Particles,
        [this](std::size_t i)
        {
          const auto& c = spheres.centers[i];
          return po::Vec3d{ c[0], c[1], c[2] };
        },
        [this](std::size_t i) { return static_cast<double>(spheres.radii[i]); }))
    , scene(cloud)
  {
    for (std::size_t i = 0; i < BakedParticles; ++i)
    {
      baked.push_back(static_cast<unsigned>(i * Particles / BakedParticles));
    }
  }

  po::SyntheticSpheres spheres;
  po::SphereCloud cloud;
  po::BakeScene scene;
  std::vector<unsigned> baked;
};

Workload& workload(const std::string& family)
{
  static std::map<std::string, std::unique_ptr<Workload>> cache;
  auto& entry = cache[family];
  if (!entry)
  {
    entry = std::make_unique<Workload>(family);
  }
  return *entry;
}

po::BakeSettings settings()
{
  po::BakeSettings s;
  s.textureResolution = Resolution;
  s.samplesPerTexel = Samples;
  return s;
}

/// The rays of the Reference estimator for one particle without overlaps, in its order.
void generateRays(const po::Sphere& sphere, std::uint64_t id, std::vector<Ray>& rays)
{
  static const po::StratifiedSquare strata(Samples);
  static std::vector<std::uint32_t> pairing(Samples);
  rays.clear();
  for (int row = 0; row < Resolution; ++row)
  {
    for (int column = 0; column < Resolution; ++column)
    {
      po::Random random(1, id, po::texelIndex(Resolution, row, column));
      po::randomPermutation(random, pairing);
      const po::TexelPatch patch(Resolution, row, column);
      for (int k = 0; k < Samples; ++k)
      {
        const po::Point2 place = strata.point(k, random.uniform(), random.uniform());
        const po::Point2 heading =
          strata.point(static_cast<int>(pairing[static_cast<std::size_t>(k)]), random.uniform(),
            random.uniform());
        const po::Vec3d n = patch.point(place.x, place.y);
        const po::Vec3d d = po::aboutNormal(n, po::cosineHemisphereFromSquare(heading));
        rays.push_back({ sphere.center() + sphere.radius * n.as<float>(), d.as<float>() });
      }
    }
  }
}

void bake(benchmark::State& state, const std::string& family)
{
  Workload& work = workload(family);
  po::BakeCounters counters;
  for (auto _ : state)
  {
    po::Progress progress;
    counters = {};
    po::ReferenceEstimator().estimate(
      work.scene, work.baked, settings(), progress,
      [](const po::RawTextures& raw) { benchmark::DoNotOptimize(raw.values); }, counters);
  }
  state.counters["rays"] = static_cast<double>(counters.rays);
  state.counters["rays/s"] = benchmark::Counter(
    static_cast<double>(counters.rays), benchmark::Counter::kIsIterationInvariantRate);
}

void generate(benchmark::State& state, const std::string& family)
{
  Workload& work = workload(family);
  std::vector<Ray> rays;
  double count = 0;
  for (auto _ : state)
  {
    count = 0;
    for (const unsigned id : work.baked)
    {
      generateRays(work.cloud.spheres[id], id, rays);
      count += static_cast<double>(rays.size());
      benchmark::DoNotOptimize(rays.data());
    }
  }
  state.counters["rays/s"] =
    benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate);
}

void bare(benchmark::State& state, const std::string& family)
{
  Workload& work = workload(family);
  std::vector<Ray> rays;
  std::vector<Ray> all;
  for (const unsigned id : work.baked)
  {
    po::Overlaps overlaps;
    work.scene.overlaps.find(id, overlaps);
    if (overlaps.buried)
    {
      continue;
    }
    generateRays(work.cloud.spheres[id], id, rays);
    for (const Ray& ray : rays)
    {
      const po::Vec3d n =
        po::normalized((ray.origin - work.cloud.spheres[id].center()).as<double>());
      const bool inside = std::any_of(overlaps.caps.begin(), overlaps.caps.end(),
        [n](const po::BuriedCap& cap) { return po::dot(n, cap.axis) > cap.cosine; });
      if (!inside)
      {
        all.push_back(ray);
      }
    }
  }
  // A scene of its own, without the filter; a large epsilon keeps rays off their own sphere.
  const po::DeviceHandle device = po::makeDevice();
  const po::SceneHandle scene(rtcNewScene(device.get()));
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
    work.cloud.spheres.data(), 0, sizeof(po::Sphere), work.cloud.spheres.size());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  po::RayQueryContext context;
  po::initRayQueryContext(context, false);
  std::size_t occluded = 0;
  for (auto _ : state)
  {
    occluded = 0;
    for (const Ray& r : all)
    {
      RTCRay ray{ r.origin.x, r.origin.y, r.origin.z, 1e-3f, r.direction.x, r.direction.y,
        r.direction.z, 0, std::numeric_limits<float>::infinity(), 0xFFFFFFFFu, 0, 0 };
      po::occluded1(scene.get(), context, ray);
      occluded += ray.tfar < 0 ? 1 : 0;
    }
  }
  state.counters["rays"] = static_cast<double>(all.size());
  state.counters["rays/s"] = benchmark::Counter(
    static_cast<double>(all.size()), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["occluded"] =
    static_cast<double>(occluded) / static_cast<double>(std::max<std::size_t>(all.size(), 1));
}
}

int main(int argc, char** argv)
{
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  for (const char* name : { "pack", "overlap", "gas", "shell", "foam" })
  {
    const std::string family = name;
    benchmark::RegisterBenchmark(("Bake/" + family).c_str(), bake, family)
      ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("Generate/" + family).c_str(), generate, family)
      ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("Bare/" + family).c_str(), bare, family)
      ->Unit(benchmark::kMillisecond);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
