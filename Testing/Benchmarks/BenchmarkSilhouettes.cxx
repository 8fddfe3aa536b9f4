// SPDX-License-Identifier: BSD-3-Clause
/// What silhouettes cost beside the ray-traced frame that they are drawn on: 1920 x 1080 pixels,
/// one ray a pixel, direct light, no shadows (the cheapest frame, so that the shares are the
/// highest).
///
/// Lines/FAMILY/PARTICLES/SAMPLES/THREADS: each iteration traces and shades a new view, then finds
/// its lines. CPU times of both are taken within one iteration, so that load from outside falls on
/// both alike; "share" is lines over frame. Wall-clock times of both show how they scale over
/// threads. Without particles the frame is empty.

#include "SilhouetteRims.h"
#include "SphereRenderer.h"
#include "SyntheticSpheres.h"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <memory>
#include <string>

namespace
{
using namespace po;

constexpr int Width = 1920, Height = 1080;
const Matrix4 Identity{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

/// CPU and wall-clock seconds since some time.
struct Clock
{
  double cpu, wall;

  static Clock now()
  {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    const auto wall = std::chrono::steady_clock::now().time_since_epoch();
    return { static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec),
      std::chrono::duration<double>(wall).count() };
  }
};

struct Spent
{
  double cpu = 0, wall = 0;

  void add(const Clock& from, const Clock& to)
  {
    cpu += to.cpu - from.cpu;
    wall += to.wall - from.wall;
  }
};

SphereCloud makeCloud(const std::string& family, std::size_t count)
{
  const SyntheticSpheres spheres = makeSyntheticSpheres(*syntheticFamilyFromName(family), count, 1);
  return makeSphereCloud(
    count,
    [&](std::size_t i)
    {
      const auto& c = spheres.centers[i];
      return Vec3d{ c[0], c[1], c[2] };
    },
    [&](std::size_t i) { return static_cast<double>(spheres.radii[i]); });
}

/// Half the diagonal of the cloud's box.
double extentOf(const SphereCloud& cloud)
{
  Vec3d low{ 1e300, 1e300, 1e300 }, high{ -1e300, -1e300, -1e300 };
  for (const Sphere& s : cloud.spheres)
  {
    const Vec3d c = cloud.toWorld(s.center().as<double>());
    low = { std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z) };
    high = { std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z) };
  }
  return 0.5 * length(high - low);
}

/// From outside, obliquely, so near that the cloud fills the height of the window.
Camera viewOf(const SphereCloud& cloud, double extent)
{
  const double c = std::cos(0.5), s = std::sin(0.5), k = std::cos(0.4), m = std::sin(0.4);
  const double distance = 3.2 * extent, near = 0.1 * extent, far = 10 * extent, focal = 3.73;
  const Vec3d x{ c, 0, -s }, y{ -m * s, k, -m * c }, z{ k * s, m, k * c }, o = cloud.origin;
  const Matrix4 worldToEye{ x.x, x.y, x.z, -dot(x, o), y.x, y.y, y.z, -dot(y, o), z.x, z.y, z.z,
    -dot(z, o) - distance, 0, 0, 0, 1 };
  const Matrix4 eyeToClip{ focal * Height / Width, 0, 0, 0, 0, focal, 0, 0, 0, 0,
    -(far + near) / (far - near), -2 * far * near / (far - near), 0, 0, -1, 0 };
  return { worldToEye, eyeToClip, Width, Height };
}

void lines(benchmark::State& state, const std::string& family)
{
  const auto count = static_cast<std::size_t>(state.range(0));
  const tbb::global_control threads(
    tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(state.range(2)));
  SphereCloud cloud = count > 0 ? makeCloud(family, count) : makeCloud("pack", 13);
  const double extent = count > 0 ? extentOf(cloud) : 1;
  Camera camera = viewOf(cloud, extent);
  camera.worldToEye[3] += count > 0 ? 0 : 1e3; // out of sight
  SilhouetteParameters parameters;
  parameters.samples = static_cast<int>(state.range(1));
  const SilhouetteRule rule = resolve(parameters, { cloud.scale, 2 * extent });

  Style style;
  style.lights = { Light() };
  SphereRenderer renderer;
  renderer.setCloud(std::move(cloud));
  benchmark::DoNotOptimize(renderer.trace(camera, Identity)); // builds the scene, which then stays
  SilhouetteImage image;
  SilhouetteCounters counters;
  Spent frame, search;
  for (auto _ : state)
  {
    camera.worldToEye[3] += 1e-9 * extent; // a new view each time: nothing is kept
    const Clock start = Clock::now();
    benchmark::DoNotOptimize(renderer.trace(camera, Identity));
    renderer.shade(style);
    const Clock middle = Clock::now();
    const TracedDepth depth({ { renderer.frame(), renderer.rays(), renderer.cloud().spheres } });
    counters = findTracedSilhouettes(depth, rule, image);
    const Clock end = Clock::now();
    frame.add(start, middle);
    search.add(middle, end);
  }
  std::size_t covered = 0;
  for (const float strength : image.strength)
  {
    covered += strength > 0;
  }
  const auto n = static_cast<double>(state.iterations());
  state.counters["frame_ms"] = 1e3 * frame.wall / n;
  state.counters["lines_ms"] = 1e3 * search.wall / n;
  state.counters["frame_cpu"] = 1e3 * frame.cpu / n;
  state.counters["lines_cpu"] = 1e3 * search.cpu / n;
  state.counters["share_%"] = 100 * search.cpu / frame.cpu;
  state.counters["covered_%"] = 100.0 * static_cast<double>(covered) / (Width * Height);
  state.counters["skipped_%"] =
    100.0 * static_cast<double>(counters.tilesSkipped) / static_cast<double>(counters.tiles);
}

void addBenchmarks()
{
  for (const std::string family : { "pack", "overlap", "gas", "shell", "foam" })
  {
    for (const int samples : { 1, 4 })
    {
      benchmark::RegisterBenchmark(("Lines/" + family).c_str(), lines, family)
        ->ArgNames({ "particles", "samples", "threads" })
        ->Args({ 200000, samples, 2 })
        ->Unit(benchmark::kMillisecond);
    }
  }
  for (const int threads : { 1, 2, 4 })
  {
    benchmark::RegisterBenchmark("Threads/foam", lines, "foam")
      ->ArgNames({ "particles", "samples", "threads" })
      ->Args({ 200000, 4, threads })
      ->Unit(benchmark::kMillisecond);
  }
  for (const int samples : { 1, 4 })
  {
    benchmark::RegisterBenchmark("Empty", lines, "")
      ->ArgNames({ "particles", "samples", "threads" })
      ->Args({ 0, samples, 2 })
      ->Unit(benchmark::kMillisecond);
  }
}
}

int main(int argc, char** argv)
{
  addBenchmarks();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
  {
    return 1;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
