// SPDX-License-Identifier: BSD-3-Clause
// One frame of 500 x 500 pixels, one ray a pixel: bare Embree loops against the tracer, and what
// shading and textures add. "Bare" does nothing but intersect rays that were made beforehand.
#include "SphereRenderer.h"

#include <benchmark/benchmark.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <memory>

namespace
{
using namespace po;

constexpr int Side = 500;
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
Camera viewOf(int side)
{
  const double c = std::sqrt(0.5), size = 2.2 * side, distance = 2.2 * size;
  // Rotation by 45 degrees about y, then by 35 about x.
  const double s = std::sin(0.6155), k = std::cos(0.6155);
  const Matrix4 worldToEye{ c, 0, -c, 0, -s * c, k, -s * c, 0, k * c, s, k * c, -distance, 0, 0, 0,
    1 };
  const double near = 0.1 * distance, far = 4 * distance, focal = 2.6;
  const Matrix4 eyeToClip{ focal, 0, 0, 0, 0, focal, 0, 0, 0, 0, -(far + near) / (far - near),
    -2 * far * near / (far - near), 0, 0, -1, 0 };
  return { worldToEye, eyeToClip, Side, Side };
}

struct Fixture
{
  SphereCloud cloud;
  SphereScene scene;
  PrimaryRays rays;
  std::vector<RTCRayHit> queries; ///< packets of 4 x 4 pixels one after the other

  explicit Fixture(int side)
    : cloud(lattice(side))
    , scene(cloud.spheres)
    , rays(*PrimaryRays::make(viewOf(side), localToWorld()))
  {
    for (int y = 0; y < Side; y += 4)
    {
      for (int x = 0; x < Side; x += 4)
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
  static int currentSide = 0;
  if (const int side = static_cast<int>(state.range(0)); side != currentSide)
  {
    current = std::make_unique<Fixture>(side);
    currentSide = side;
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

void bareEmbreePackets(benchmark::State& state)
{
  const Fixture& f = fixture(state);
  for (auto _ : state)
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
          }
          RayQueryContext context;
          initRayQueryContext(context, true);
          intersect16(valid, f.scene.handle(), context, packet);
          benchmark::DoNotOptimize(packet);
        }
      });
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

/// A whole frame. Arguments: side of the lattice, shading mode, textures or not, shadows or not.
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
  const OcclusionTextures textures = state.range(2) != 0
    ? OcclusionTextures(Resolution, texels.data(), 1.0, rows.data(), nullptr)
    : OcclusionTextures();
  Light light;
  light.direction = normalized(Vec3d{ -1, -2, -1 });
  Material material;
  material.mode = static_cast<ShadingMode>(state.range(1));

  SphereRenderer renderer;
  renderer.setCloud(f.cloud);
  Camera camera = viewOf(static_cast<int>(state.range(0)));
  benchmark::DoNotOptimize(renderer.trace(camera, Identity)); // builds the scene, which then stays
  for (auto _ : state)
  {
    camera.worldToEye[3] += 1e-9; // a new view each time: nothing is kept
    benchmark::DoNotOptimize(renderer.trace(camera, Identity));
    renderer.shade(material, textures, { light }, state.range(3) != 0);
  }
  finish(state, f);
}

BENCHMARK(bareEmbreeSingle)
  ->Name("BareEmbreeSingle")
  ->Arg(20)
  ->Arg(98)
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
BENCHMARK(bareEmbreePackets)
  ->Name("BareEmbreePackets")
  ->Arg(20)
  ->Arg(98)
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
BENCHMARK(trace)->Name("Trace")->Arg(20)->Arg(98)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(frame)
  ->Name("Frame")
  ->ArgNames({ "side", "mode", "textures", "shadows" })
  ->Args({ 98, 0, 0, 0 })
  ->Args({ 98, 0, 0, 1 })
  ->Args({ 98, 1, 1, 0 })
  ->Args({ 98, 2, 1, 0 })
  ->Args({ 98, 2, 1, 1 })
  ->Unit(benchmark::kMillisecond)
  ->UseRealTime();
}

BENCHMARK_MAIN();
