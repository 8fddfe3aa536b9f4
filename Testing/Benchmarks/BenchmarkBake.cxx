// SPDX-License-Identifier: BSD-3-Clause
/// How much of a Reference bake is Embree and ray generation, and how its ray rate compares with a
/// bare loop of rtcOccluded1 over the same rays. Everything runs on one thread; times are CPU time.
///
/// Bake/FAMILY      the estimator: rays, occlusion tests, sums, bookkeeping
/// Generate/FAMILY  the bake's own rays from the bake's own code, dropped instead of traced: the
///                  search for overlaps, which samples get a ray, and where it begins, included
/// Bare/FAMILY      rtcOccluded1 over the very same rays, stored, from an epsilon on
///
/// Repetitions of all are shuffled, so that load from outside falls on all alike, and since it can
/// only add to the time, the table at the end is of the fastest. share = (Generate + Bare) / Bake
/// is what the bake spends in ray generation, or cannot but spend in Embree; ray rate = Bare /
/// (Bake - Generate) is its rate of tracing against the bare loop's.

#include "Embree.h"
#include "OcclusionBaker.h"
#include "ReferenceEstimator.h"
#include "ReferenceRays.h"
#include "SurfaceTracer.h"
#include "SyntheticSpheres.h"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
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
constexpr const char* Fastest = "fastest"; ///< of the repetitions: a name for statistics
constexpr const char* Families[] = { "pack", "overlap", "gas", "shell", "foam" };

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
    scene.prepareRays();
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

/// Calls f(particle, rays) with the rays of each texel of the bake, in its order.
template <typename Function>
void forEachTexel(const Workload& work, const Function& f)
{
  const po::BakeSettings s = settings();
  const po::ReferenceRays rays(work.scene, s);
  po::ReferenceRays::Workspace memory;
  std::vector<po::SurfaceRay> made;
  for (const unsigned id : work.baked)
  {
    const bool visible = rays.beginParticle(id, memory);
    for (int texel = 0; visible && texel < Resolution * Resolution; ++texel)
    {
      made.clear();
      (void)rays.makeRays(id, texel / Resolution, texel % Resolution, memory, made);
      f(id, made);
    }
  }
}

/// The rays of the bake, and a scene of their own.
class BareLoop
{
public:
  explicit BareLoop(const Workload& work)
    : device_(po::makeDevice(work.cloud.spheres.size()))
    , scene_(rtcNewScene(device_.get()))
  {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
      work.cloud.spheres.data(), 0, sizeof(po::Sphere), work.cloud.spheres.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_.get());
    forEachTexel(work,
      [&](unsigned id, const std::vector<po::SurfaceRay>& rays)
      {
        const po::SurfaceTracer bake(work.scene.rays(), id, std::numeric_limits<float>::infinity());
        for (const po::SurfaceRay& ray : rays)
        {
          rays_.push_back(query(ray));
          differing_ += isOccluded(rays_.back()) != bake.occluded(ray);
        }
      });
  }

  [[nodiscard]] std::size_t size() const { return rays_.size(); }

  /// Rays that the bake decides otherwise than this loop, whose epsilon keeps rays off their own
  /// sphere.
  [[nodiscard]] std::size_t differing() const { return differing_; }

  /// Traces all rays; how many are occluded.
  [[nodiscard]] std::size_t run() const
  {
    std::size_t occluded = 0;
    for (const RTCRay& ray : rays_)
    {
      occluded += isOccluded(ray);
    }
    return occluded;
  }

private:
  static constexpr float Start = 1e-3f; ///< epsilon

  [[nodiscard]] static RTCRay query(const po::SurfaceRay& ray)
  {
    return { ray.origin.x, ray.origin.y, ray.origin.z, Start, ray.direction.x, ray.direction.y,
      ray.direction.z, 0, std::numeric_limits<float>::infinity(), 0xFFFFFFFFu, 0, 0 };
  }

  [[nodiscard]] bool isOccluded(RTCRay ray) const
  {
    po::RayQueryContext context;
    po::initRayQueryContext(context, false);
    po::occluded1(scene_.get(), context, ray);
    return ray.tfar < 0;
  }

  po::DeviceHandle device_;
  po::SceneHandle scene_;
  std::vector<RTCRay> rays_;
  std::size_t differing_ = 0;
};

void countRays(benchmark::State& state, std::uint64_t rays)
{
  state.counters["rays"] = static_cast<double>(rays);
  state.counters["rays/s"] =
    benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsIterationInvariantRate);
}

void bake(benchmark::State& state, const std::string& family)
{
  const Workload& work = workload(family);
  po::BakeCounters counters;
  for (auto _ : state)
  {
    po::Progress progress;
    counters = {};
    po::ReferenceEstimator().estimate(
      work.scene, work.baked, settings(), progress,
      [](const po::RawTextures& raw) { benchmark::DoNotOptimize(raw.values); }, counters);
  }
  countRays(state, counters.rays);
}

void generate(benchmark::State& state, const std::string& family)
{
  const Workload& work = workload(family);
  std::uint64_t count = 0;
  for (auto _ : state)
  {
    count = 0;
    forEachTexel(work,
      [&](unsigned, const std::vector<po::SurfaceRay>& rays)
      {
        count += rays.size();
        benchmark::DoNotOptimize(rays.data());
      });
  }
  countRays(state, count);
}

void bare(benchmark::State& state, const std::string& family)
{
  static std::map<std::string, std::unique_ptr<BareLoop>> cache;
  auto& loop = cache[family];
  if (!loop)
  {
    loop = std::make_unique<BareLoop>(workload(family));
  }
  std::size_t occluded = 0;
  for (auto _ : state)
  {
    occluded = loop->run();
    benchmark::DoNotOptimize(occluded);
  }
  countRays(state, loop->size());
  state.counters["occluded"] = static_cast<double>(occluded) / static_cast<double>(loop->size());
  state.counters["differing"] = static_cast<double>(loop->differing());
}

/// Keeps the fastest CPU times, and prints the table of shares.
class ShareReporter : public benchmark::ConsoleReporter
{
public:
  void ReportRuns(const std::vector<Run>& runs) override
  {
    for (const Run& run : runs)
    {
      if (run.run_type == Run::RT_Aggregate && run.aggregate_name == Fastest)
      {
        milliseconds_[run.run_name.function_name] = run.GetAdjustedCPUTime();
      }
    }
    ConsoleReporter::ReportRuns(runs);
  }

  void printTable() const
  {
    std::printf("\n| family | bake, ms | generate | bare Embree | share | ray rate |\n"
                "| --- | ---: | ---: | ---: | ---: | ---: |\n");
    for (const char* family : Families)
    {
      const double whole = of("Bake", family), rays = of("Generate", family);
      const double traced = of("Bare", family);
      if (whole > 0 && rays > 0 && traced > 0)
      {
        std::printf("| %s | %.0f | %.0f | %.0f | %.0f %% | %.0f %% |\n", family, whole, rays,
          traced, 100 * (rays + traced) / whole, 100 * traced / (whole - rays));
      }
    }
  }

private:
  [[nodiscard]] double of(const std::string& what, const std::string& family) const
  {
    const auto found = milliseconds_.find(what + "/" + family);
    return found == milliseconds_.end() ? 0 : found->second;
  }

  std::map<std::string, double> milliseconds_;
};

void add(const std::string& what, const std::string& family,
  void (*measure)(benchmark::State&, const std::string&))
{
  benchmark::RegisterBenchmark((what + "/" + family).c_str(), measure, family)
    ->Unit(benchmark::kMillisecond)
    ->ComputeStatistics(Fastest,
      [](const std::vector<double>& times)
      { return *std::min_element(times.begin(), times.end()); })
    ->ReportAggregatesOnly();
}
}

int main(int argc, char** argv)
{
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  for (const char* family : Families)
  {
    add("Bake", family, bake);
    add("Generate", family, generate);
    add("Bare", family, bare);
  }
  std::vector<char*> arguments(argv, argv + argc);
  // Before those of the caller, who may so ask for others.
  std::string shuffled = "--benchmark_enable_random_interleaving=true";
  std::string repetitions = "--benchmark_repetitions=11";
  std::string onePass = "--benchmark_min_time=0.01";
  arguments.insert(arguments.begin() + 1, { shuffled.data(), repetitions.data(), onePass.data() });
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data()))
  {
    return 1;
  }
  ShareReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.printTable();
  return 0;
}
