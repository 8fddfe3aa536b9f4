// SPDX-License-Identifier: BSD-3-Clause
// One frame, one ray a pixel: bare Embree loops against the tracer, what shading and textures add,
// and three ways to crop. "Bare" does nothing but intersect rays that were made beforehand. CPU is
// that of all threads: where other processes run, compare it instead of the time.
#include "Cropping.h"
#include "FrontFinder.h"
#include "SphereRenderer.h"

#include <benchmark/benchmark.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <memory>

namespace
{
using namespace po;

constexpr int Resolution = 16;
const Matrix4 Identity{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

/// A lattice of side^3 spheres of radius 1, a little apart.
SphereCloud lattice(int side)
{
  const double middle = 1.1 * (side - 1);
  return makeSphereCloud(
    static_cast<std::size_t>(side) * side * side,
    [=](std::size_t i)
    {
      const auto n = static_cast<std::size_t>(side);
      return Vec3d{ 2.2 * (i % n) - middle, 2.2 * (i / n % n) - middle,
        2.2 * (i / n / n) - middle };
    },
    [](std::size_t) { return 1.0; });
}

/// Looks down the cube's diagonal from outside; the cube fills most of the window.
Camera viewOf(int side, int width, int height)
{
  const double c = std::sqrt(0.5), size = 2.2 * side, distance = 2.2 * size;
  // Rotation by 45 degrees about y, then by 35 about x.
  const double s = std::sin(0.6155), k = std::cos(0.6155);
  const Matrix4 worldToEye{ c, 0, -c, 0, -s * c, k, -s * c, 0, k * c, s, k * c, -distance, 0, 0, 0,
    1 };
  const double near = 0.1 * distance, far = 4 * distance, focal = 2.6;
  const double aspect = static_cast<double>(width) / height;
  const Matrix4 eyeToClip{ focal / aspect, 0, 0, 0, 0, focal, 0, 0, 0, 0,
    -(far + near) / (far - near), -2 * far * near / (far - near), 0, 0, -1, 0 };
  return { worldToEye, eyeToClip, width, height };
}

struct Fixture
{
  SphereCloud cloud;
  SphereScene scene;
  PrimaryRays rays;
  std::vector<RTCRayHit> queries; ///< packets of 4 x 4 pixels one after the other

  Fixture(int side, int width, int height)
    : cloud(lattice(side))
    , scene(cloud.spheres)
    , rays(*PrimaryRays::make(viewOf(side, width, height), localToWorld()))
  {
    for (int y = 0; y < height; y += 4)
    {
      for (int x = 0; x < width; x += 4)
      {
        for (int lane = 0; lane < 16; ++lane)
        {
          queries.push_back(query(x + lane % 4, y + lane / 4));
        }
      }
    }
  }

  [[nodiscard]] Matrix4 localToWorld() const
  {
    const double s = cloud.scale;
    return { s, 0, 0, cloud.origin.x, 0, s, 0, cloud.origin.y, 0, 0, s, cloud.origin.z, 0, 0, 0,
      1 };
  }

  [[nodiscard]] RTCRayHit query(int x, int y) const
  {
    const PrimaryRay ray = rays.at(x + 0.5, y + 0.5);
    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(ray.origin.x);
    query.ray.org_y = static_cast<float>(ray.origin.y);
    query.ray.org_z = static_cast<float>(ray.origin.z);
    query.ray.dir_x = static_cast<float>(ray.direction.x);
    query.ray.dir_y = static_cast<float>(ray.direction.y);
    query.ray.dir_z = static_cast<float>(ray.direction.z);
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = 0xFFFFFFFFu;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return query;
  }
};

const Fixture& fixture(const benchmark::State& state)
{
  static std::unique_ptr<Fixture> current;
  static std::array<int, 3> shape{};
  const std::array<int, 3> wanted{ int(state.range(0)), int(state.range(1)), int(state.range(2)) };
  if (wanted != shape)
  {
    current = std::make_unique<Fixture>(wanted[0], wanted[1], wanted[2]);
    shape = wanted;
  }
  return *current;
}

void finish(benchmark::State& state, const Fixture& f)
{
  state.counters["spheres"] = static_cast<double>(f.cloud.spheres.size());
  state.counters["frames/s"] =
    benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void bareEmbreeSingle(benchmark::State& state)
{
  const Fixture& f = fixture(state);
  for (auto _ : state)
  {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, f.queries.size(), 256),
      [&](const tbb::blocked_range<std::size_t>& range)
      {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
        {
          RTCRayHit query = f.queries[i];
          RayQueryContext context;
          initRayQueryContext(context, true);
          intersect1(f.scene.handle(), context, query);
          benchmark::DoNotOptimize(query);
        }
      });
  }
  finish(state, f);
}

void loadLane(const RTCRayHit& one, RTCRayHit16& packet, int lane)
{
  packet.ray.org_x[lane] = one.ray.org_x;
  packet.ray.org_y[lane] = one.ray.org_y;
  packet.ray.org_z[lane] = one.ray.org_z;
  packet.ray.dir_x[lane] = one.ray.dir_x;
  packet.ray.dir_y[lane] = one.ray.dir_y;
  packet.ray.dir_z[lane] = one.ray.dir_z;
  packet.ray.tnear[lane] = 0;
  packet.ray.tfar[lane] = one.ray.tfar;
  packet.ray.time[lane] = 0;
  packet.ray.mask[lane] = one.ray.mask;
  packet.ray.flags[lane] = 0;
  packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
}

/// All packets of the fixture in a scene.
void tracePackets(const Fixture& f, RTCScene scene, unsigned mask, const std::uint8_t* hidden)
{
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, f.queries.size() / 16, 16),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      alignas(64) int valid[16];
      std::fill_n(valid, 16, -1);
      for (std::size_t i = range.begin(); i < range.end(); ++i)
      {
        alignas(64) RTCRayHit16 packet;
        for (int lane = 0; lane < 16; ++lane)
        {
          loadLane(f.queries[16 * i + static_cast<std::size_t>(lane)], packet, lane);
          packet.ray.mask[lane] = mask;
        }
        FrontQuery query{ {}, hidden, &f.scene.set().bricks().front(), nullptr };
        initRayQueryContext(query.embree, true);
        intersect16(valid, scene, query.embree, packet, hidden ? passSpheres : nullptr);
        benchmark::DoNotOptimize(packet);
      }
    });
}

void bareEmbreePackets(benchmark::State& state)
{
  const Fixture& f = fixture(state);
  for (auto _ : state)
  {
    tracePackets(f, f.scene.handle(), 0xFFFFFFFFu, nullptr);
  }
  finish(state, f);
}

void trace(benchmark::State& state)
{
  const Fixture& f = fixture(state);
  TracedFrame frame;
  TraceCounters counters;
  for (auto _ : state)
  {
    counters = traceFrame(f.scene, f.rays, {}, frame);
  }
  finish(state, f);
  state.counters["hits"] = static_cast<double>(counters.hits);
  state.counters["tilesSkipped"] = static_cast<double>(counters.tilesSkipped);
}

/// A whole frame. Arguments: side of the lattice, width, height, shading mode, textures or not,
/// shadows or not.
void frame(benchmark::State& state)
{
  const Fixture& f = fixture(state);
  const std::size_t particles = f.cloud.spheres.size();
  std::vector<std::int32_t> rows(particles);
  std::vector<std::uint8_t> texels(1000 * Resolution * Resolution);
  for (std::size_t i = 0; i < particles; ++i)
  {
    rows[i] = static_cast<std::int32_t>(i % 1000);
  }
  for (std::size_t i = 0; i < texels.size(); ++i)
  {
    texels[i] = static_cast<std::uint8_t>(i * 7919);
  }
  const OcclusionTextures textures = state.range(4) != 0
    ? OcclusionTextures(Resolution, texels.data(), 1.0, rows.data(), nullptr)
    : OcclusionTextures();
  Light light;
  light.direction = normalized(Vec3d{ -1, -2, -1 });
  Style style;
  style.material.mode = static_cast<ShadingMode>(state.range(3));
  style.textures = textures;
  style.lights = { light };
  style.shadows = state.range(5) != 0;

  SphereRenderer renderer;
  renderer.setCloud(f.cloud);
  Camera camera = viewOf(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
    static_cast<int>(state.range(2)));
  benchmark::DoNotOptimize(renderer.trace(camera, Identity)); // builds the scene, which then stays
  for (auto _ : state)
  {
    camera.worldToEye[3] += 1e-9; // a new view each time: nothing is kept
    benchmark::DoNotOptimize(renderer.trace(camera, Identity));
    renderer.shade(style);
  }
  finish(state, f);
}

/// Hides the half of the cube that is turned away from the eye's side.
std::vector<std::uint8_t> hiddenHalf(const SphereCloud& cloud)
{
  Cropping cropping;
  cropping.halfSpaces.push_back({ { 1, 0, 1 }, 0 });
  return hideSpheres(cloud, cropping);
}

/// Half of the spheres hidden by a filter of the query.
void cropByFilter(benchmark::State& state)
{
  const Fixture& f = fixture(state);
  const std::vector<std::uint8_t> hidden = hiddenHalf(f.cloud);
  TracedFrame frame;
  FrameSettings settings;
  settings.hidden = hidden.data();
  for (auto _ : state)
  {
    traceFrame(f.scene, f.rays, settings, frame);
  }
  finish(state, f);
}

SphereCloud shownOf(const SphereCloud& cloud, const std::vector<std::uint8_t>& hidden)
{
  SphereCloud shown = cloud;
  shown.spheres.clear();
  for (std::size_t i = 0; i < hidden.size(); ++i)
  {
    if (hidden[i] == 0)
    {
      shown.spheres.push_back(cloud.spheres[i]);
    }
  }
  return shown;
}

/// A scene of the other half alone: its frames, and its building.
void cropByRebuilding(benchmark::State& state)
{
  const Fixture& f = fixture(state);
  const SphereScene scene(shownOf(f.cloud, hiddenHalf(f.cloud)).spheres);
  TracedFrame frame;
  for (auto _ : state)
  {
    traceFrame(scene, f.rays, {}, frame);
  }
  finish(state, f);
}

void buildScene(benchmark::State& state)
{
  const Fixture& f = fixture(state);
  const SphereCloud shown = shownOf(f.cloud, hiddenHalf(f.cloud));
  for (auto _ : state)
  {
    const SphereScene scene(shown.spheres);
    benchmark::DoNotOptimize(scene.handle());
  }
  finish(state, f);
}

void findHidden(benchmark::State& state)
{
  const Fixture& f = fixture(state);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(hiddenHalf(f.cloud).data());
  }
  finish(state, f);
}

/// Embree's masks are those of geometries: two of them, whose spheres must be known when the scene
/// is built. Bare packets.
void cropByMasks(benchmark::State& state)
{
  const Fixture& f = fixture(state);
  const std::vector<std::uint8_t> hidden = hiddenHalf(f.cloud);
  const DeviceHandle device = makeDevice(f.cloud.spheres.size());
  if (rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED) == 0)
  {
    state.SkipWithError("this build of Embree has no ray masks");
    return;
  }
  const SceneHandle scene(rtcNewScene(device.get()));
  std::array<std::vector<Sphere>, 2> parts;
  for (std::size_t i = 0; i < hidden.size(); ++i)
  {
    parts[hidden[i]].push_back(f.cloud.spheres[i]);
  }
  for (unsigned part = 0; part < 2; ++part)
  {
    const GeometryHandle geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT));
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
      parts[part].data(), 0, sizeof(Sphere), parts[part].size());
    rtcSetGeometryMask(geometry.get(), 1u << part);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene.get(), geometry.get());
  }
  rtcCommitScene(scene.get());
  for (auto _ : state)
  {
    tracePackets(f, scene.get(), 1u, nullptr);
  }
  finish(state, f);
}

/// Half of the spheres hidden by a filter, bare packets.
void cropBareByFilter(benchmark::State& state)
{
  const Fixture& f = fixture(state);
  const std::vector<std::uint8_t> hidden = hiddenHalf(f.cloud);
  for (auto _ : state)
  {
    tracePackets(f, f.scene.handle(), 0xFFFFFFFFu, hidden.data());
  }
  finish(state, f);
}

void sizes(benchmark::internal::Benchmark* b)
{
  for (const int side : { 58, 100 })
  {
    b->Args({ side, 500, 500 })->Args({ side, 1920, 1080 });
  }
  b->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

/// Direct light with and without shadows, occlusion only, both with and without shadows.
void styles(benchmark::internal::Benchmark* b)
{
  for (const int side : { 58, 100 })
  {
    for (const auto& [width, height] : { std::pair(500, 500), std::pair(1920, 1080) })
    {
      b->Args({ side, width, height, 0, 0, 0 })->Args({ side, width, height, 0, 0, 1 });
      b->Args({ side, width, height, 1, 1, 0 });
      b->Args({ side, width, height, 2, 1, 0 })->Args({ side, width, height, 2, 1, 1 });
    }
  }
  b->ArgNames({ "side", "width", "height", "mode", "textures", "shadows" });
  b->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

BENCHMARK(bareEmbreeSingle)->Name("BareEmbreeSingle")->Apply(sizes);
BENCHMARK(bareEmbreePackets)->Name("BareEmbreePackets")->Apply(sizes);
BENCHMARK(trace)->Name("Trace")->Apply(sizes);
BENCHMARK(frame)->Name("Frame")->Apply(styles);
BENCHMARK(cropBareByFilter)->Name("CropBareByFilter")->Apply(sizes);
BENCHMARK(cropByMasks)->Name("CropBareByMasks")->Apply(sizes);
BENCHMARK(cropByFilter)->Name("CropByFilter")->Apply(sizes);
BENCHMARK(cropByRebuilding)->Name("CropByRebuilding")->Apply(sizes);
BENCHMARK(buildScene)->Name("CropBuild")->Apply(sizes);
BENCHMARK(findHidden)->Name("CropFindHidden")->Apply(sizes);
}

BENCHMARK_MAIN();
