// SPDX-License-Identifier: BSD-3-Clause
/// What silhouettes cost beside the ray-traced frame that they are drawn on: 1920 x 1080 pixels,
/// one ray a pixel.
///
/// Lines/FAMILY/PARTICLES/SAMPLES/THREADS: each iteration traces a new view, shades it in two ways,
/// then finds its lines and colours them. CPU times of all are taken within one iteration, so that
/// load from outside falls on all alike; the medians over the iterations count. Two frames are
/// compared with:
/// - the default display: light from the camera and baked occlusion, no shadows;
/// - the cheapest, so that the share is the highest: direct light alone.
/// With antialiased lines also with
/// - the default display with hard shadows, and
/// - the default display with four rays a pixel.
/// Wall-clock times show how lines scale over threads. Without particles the frame is empty.
/// The floor: to read once, and do nothing else with, the depths of the tiles that may have lines.
///
/// Shared/FAMILY/PARTICLES/PROCESSES/SLABS: the particles are divided over processes, played by
/// threads, by turns or into slabs. CPU time of all of them together, with what one process takes
/// alone in the same iteration, and bytes that are handed from process to process.

#include "FreeLength.h"
#include "SharedSilhouettes.h"
#include "SilhouettePixels.h"
#include "SilhouetteRims.h"
#include "SilhouetteTiles.h"
#include "SphereRenderer.h"
#include "SyntheticSpheres.h"
#include "ThreadGroup.h"
#include "TracedDepth.h"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

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

/// CPU and wall-clock milliseconds of one step in each iteration.
class Spent
{
public:
  template <typename Step>
  void measure(const Step& step)
  {
    // Threads that wait for work go on for a while after the step before: not at this one's cost.
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const Clock from = Clock::now();
    step();
    const Clock to = Clock::now();
    cpu_.push_back(1e3 * (to.cpu - from.cpu));
    wall_.push_back(1e3 * (to.wall - from.wall));
  }

  [[nodiscard]] double cpu() const { return median(cpu_); }
  [[nodiscard]] double wall() const { return median(wall_); }

private:
  static double median(std::vector<double> values)
  {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  }

  std::vector<double> cpu_, wall_;
};

/// Textures as the filter makes them by default: 16 x 16 texels of 8 bits for each particle.
struct Textures
{
  static constexpr int Resolution = 16;
  std::vector<std::uint8_t> texels;
  std::vector<std::int32_t> rows;

  explicit Textures(std::size_t particles)
    : texels(particles * Resolution * Resolution)
    , rows(particles)
  {
    std::iota(rows.begin(), rows.end(), 0);
    for (std::size_t i = 0; i < texels.size(); ++i)
    {
      texels[i] = static_cast<std::uint8_t>(i * 7919);
    }
  }

  [[nodiscard]] OcclusionTextures get() const
  {
    return { Resolution, texels.data(), 1.0, rows.data(), nullptr };
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

/// Reads the depths of the tiles that may have lines.
void readDepths(const TracedFrame& frame, const SilhouetteRule& rule, SilhouetteImage& nothing)
{
  const std::vector<SearchedTiles> tiles =
    tilesToSearch(frame.tiles, rule, rule.samples - 1, nothing, true);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), 8),
    [&](const tbb::blocked_range<std::size_t>& part)
    {
      double farthest = 0;
      for (std::size_t at = part.begin(); at < part.end(); ++at)
      {
        const PixelRange pixels = tiles[at].pixels(frame.width, frame.height);
        for (int j = pixels.y0; j < pixels.y1; ++j)
        {
          const double* row = frame.t.data() + static_cast<std::ptrdiff_t>(j) * frame.width;
          // One number of each cache line.
          for (int i = pixels.x0; i < pixels.x1; i += 8)
          {
            farthest = std::max(farthest, row[i]);
          }
        }
      }
      benchmark::DoNotOptimize(farthest);
    });
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
  const double meanRadius = cloud.scale;

  const Textures textures(cloud.spheres.size());
  Style direct, display, shadowed;
  direct.lights = display.lights = { Light() };
  direct.material.mode = ShadingMode::DirectLight;
  display.textures = textures.get();
  shadowed = display;
  shadowed.lights.front().direction = Vec3d{ 0.6, -0.64, -0.48 };
  shadowed.shadows = true;
  const bool isSmooth = parameters.samples > 1;
  SphereRenderer renderer;
  renderer.setCloud(std::move(cloud));
  const SilhouetteRule rule =
    resolve(parameters, { meanRadius, 2 * extent, renderer.freeLength() });
  SilhouetteImage image;
  SilhouettePixels pixels;
  SilhouetteCounters counters;
  SilhouetteImage nothing;
  nothing.width = Width;
  nothing.height = Height;
  nothing.tileRows.assign(static_cast<std::size_t>(depthTiles(Width)) * depthTiles(Height), 0);
  Spent tracing, shadingDirect, shadingDisplay, search, coloring, shadows, samples, reading;
  const auto makeFrame = [&]
  {
    camera.worldToEye[3] += 1e-9 * extent; // a new view each time: nothing is kept
    tracing.measure([&] { benchmark::DoNotOptimize(renderer.trace(camera, Identity)); });
    shadingDirect.measure([&] { renderer.shade(direct); });
    shadingDisplay.measure([&] { renderer.shade(display); });
  };
  const auto iterate = [&]
  {
    makeFrame();
    const TracedFrame& frame = renderer.frame();
    search.measure(
      [&]
      {
        const TracedDepth depth({ { frame, renderer.rays(), renderer.cloud().spheres } });
        counters = findTracedSilhouettes(depth, rule, image, { true, true });
      });
    coloring.measure(
      [&]
      {
        const auto* rgba = rule.samples > 1 ? renderer.rgba().data() : nullptr;
        colorSilhouettes(image, {}, { rgba, frame.windowDepth.data() }, pixels);
      });
    if (isSmooth)
    {
      samples.measure([&] { renderer.refine(4); });
      shadows.measure([&] { renderer.shade(shadowed); });
    }
  };
  iterate(); // builds the scene and makes room
  tracing = shadingDirect = shadingDisplay = search = coloring = shadows = samples = {};
  for (auto _ : state)
  {
    iterate();
    makeFrame(); // so that no depth is in the cache
    reading.measure([&] { readDepths(renderer.frame(), rule, nothing); });
  }
  const auto covered = std::count_if(
    image.strength.begin(), image.strength.end(), [](float strength) { return strength > 0; });
  const double display_cpu = tracing.cpu() + shadingDisplay.cpu();
  const double cheapest_cpu = tracing.cpu() + shadingDirect.cpu();
  state.counters["display_cpu"] = display_cpu;
  state.counters["cheapest_cpu"] = cheapest_cpu;
  state.counters["lines_cpu"] = search.cpu();
  state.counters["floor_cpu"] = reading.cpu();
  state.counters["coloring_cpu"] = coloring.cpu();
  state.counters["display_%"] = 100 * search.cpu() / display_cpu;
  state.counters["colored_%"] = 100 * (search.cpu() + coloring.cpu()) / display_cpu;
  state.counters["cheapest_%"] = 100 * search.cpu() / cheapest_cpu;
  if (isSmooth)
  {
    state.counters["shadowed_%"] = 100 * search.cpu() / (tracing.cpu() + shadows.cpu());
    state.counters["smooth_%"] = 100 * search.cpu() / (display_cpu + samples.cpu());
  }
  state.counters["lines_ms"] = search.wall();
  state.counters["covered_%"] = 100.0 * static_cast<double>(covered) / (Width * Height);
  state.counters["skipped_%"] =
    100.0 * static_cast<double>(counters.tilesSkipped) / static_cast<double>(counters.tiles);
}

/// The process of each sphere: by turns, or slabs along x with as many spheres each.
std::vector<int> divide(const SphereCloud& cloud, int processes, bool slabs)
{
  std::vector<std::size_t> order(cloud.spheres.size());
  std::iota(order.begin(), order.end(), 0);
  if (slabs)
  {
    std::sort(order.begin(), order.end(),
      [&](std::size_t a, std::size_t b) { return cloud.spheres[a].x < cloud.spheres[b].x; });
  }
  std::vector<int> owner(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const auto size = static_cast<std::size_t>(processes);
    owner[order[i]] = static_cast<int>(slabs ? i * size / order.size() : i % size);
  }
  return owner;
}

/// What a process has traced of its own spheres.
std::unique_ptr<SphereRenderer> traceOwn(
  const SphereCloud& cloud, const std::vector<int>& owner, int process, const Camera& camera)
{
  auto renderer = std::make_unique<SphereRenderer>();
  renderer->setCloud(cloud);
  std::vector<std::uint8_t> hidden(owner.size());
  std::transform(owner.begin(), owner.end(), hidden.begin(),
    [process](int its) { return its == process ? std::uint8_t(0) : std::uint8_t(1); });
  renderer->setHidden(hidden);
  benchmark::DoNotOptimize(renderer->trace(camera, Identity));
  return renderer;
}

void shared(benchmark::State& state, const std::string& family)
{
  const auto processes = static_cast<int>(state.range(1));
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 2);
  const SphereCloud cloud = makeCloud(family, static_cast<std::size_t>(state.range(0)));
  const double extent = extentOf(cloud);
  const Camera camera = viewOf(cloud, extent);
  const ParticleSet set{ static_cast<double>(cloud.spheres.size()), cloud.scale };
  const SilhouetteRule rule = resolve({}, { cloud.scale, 2 * extent, meanFreeLength(cloud, set) });
  const std::vector<int> owner = divide(cloud, processes, state.range(2) != 0);
  const auto whole = traceOwn(cloud, std::vector<int>(owner.size(), 0), 0, camera);
  std::vector<std::unique_ptr<SphereRenderer>> parts;
  for (int process = 0; process < processes; ++process)
  {
    parts.push_back(traceOwn(cloud, owner, process, camera));
  }
  const auto layerOf = [](const SphereRenderer& renderer) {
    return TracedLayer{ renderer.frame(), renderer.rays(), renderer.cloud().spheres };
  };
  std::vector<SharedSilhouettes> silhouettes(parts.size());
  SilhouetteImage image;
  Spent alone, together;
  for (auto _ : state)
  {
    alone.measure(
      [&] {
        findTracedSilhouettes(TracedDepth({ layerOf(*whole) }), rule, image, { true, true });
      });
    together.measure(
      [&]
      {
        inParallel(processes,
          [&](const ProcessGroup& group)
          {
            const auto at = static_cast<std::size_t>(group.rank());
            silhouettes[at].find({ layerOf(*parts[at]) }, camera, rule, group, 0, false);
          });
      });
  }
  SharedBytes bytes;
  for (const SharedSilhouettes& one : silhouettes)
  {
    bytes.ranges += one.bytes().ranges;
    bytes.depths += one.bytes().depths;
    bytes.lines += one.bytes().lines;
  }
  state.counters["alone_cpu"] = alone.cpu();
  state.counters["together_cpu"] = together.cpu();
  state.counters["ranges_kB"] = 1e-3 * static_cast<double>(bytes.ranges);
  state.counters["depths_kB"] = 1e-3 * static_cast<double>(bytes.depths);
  state.counters["lines_kB"] = 1e-3 * static_cast<double>(bytes.lines);
}

void addBenchmarks()
{
  for (const std::string family : { "pack", "overlap", "shell", "foam", "gas" })
  {
    for (const int processes : { 2, 4 })
    {
      for (const int slabs : { 0, 1 })
      {
        benchmark::RegisterBenchmark(("Shared/" + family).c_str(), shared, family)
          ->ArgNames({ "particles", "processes", "slabs" })
          ->Args({ 200000, processes, slabs })
          ->Iterations(9)
          ->Unit(benchmark::kMillisecond);
      }
    }
  }
  for (const std::string family : { "pack", "overlap", "gas", "shell", "foam" })
  {
    for (const int samples : { 1, 4 })
    {
      benchmark::RegisterBenchmark(("Lines/" + family).c_str(), lines, family)
        ->ArgNames({ "particles", "samples", "threads" })
        ->Args({ 200000, samples, 2 })
        ->Args({ 955000, samples, 2 })
        ->Iterations(15)
        ->Unit(benchmark::kMillisecond);
    }
  }
  for (const int threads : { 1, 2, 4 })
  {
    benchmark::RegisterBenchmark("Threads/foam", lines, "foam")
      ->ArgNames({ "particles", "samples", "threads" })
      ->Args({ 200000, 4, threads })
      ->Iterations(15)
      ->Unit(benchmark::kMillisecond);
  }
  for (const int samples : { 1, 4 })
  {
    benchmark::RegisterBenchmark("Empty", lines, "")
      ->ArgNames({ "particles", "samples", "threads" })
      ->Args({ 0, samples, 2 })
      ->Iterations(15)
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
