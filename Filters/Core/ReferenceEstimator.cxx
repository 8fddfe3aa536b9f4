// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceEstimator.h"

#include "ReferenceRays.h"
#include "SurfaceTracer.h"
#include "TexelMap.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace po
{
namespace
{
/// Read-only state of a bake.
struct Plan
{
  const BakeScene& scene;
  const BakeSettings& settings;
  int resolution;
  std::size_t texels;
  float rayLength; ///< local, infinite when unbounded
  bool uniform;    ///< every direction of the background has luminance 1
  ReferenceRays rays;
};

/// Memory that a thread uses again and again.
struct Workspace
{
  ReferenceRays::Workspace rays;
  std::vector<SurfaceRay> row;   ///< rays of the row of texels at hand
  std::vector<std::size_t> ends; ///< by column
  BakeCounters counters;
};

/// For the user: "12.3 million".
std::string inMillions(double number)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f million", number / 1e6);
  return text;
}

Plan makePlan(const BakeScene& scene, const BakeSettings& settings)
{
  const auto side = static_cast<std::size_t>(settings.textureResolution);
  return { scene, settings, settings.textureResolution, side * side,
    scene.cloud.toLocalReach(settings.maximumDistance),
    std::holds_alternative<UniformBackground>(settings.background),
    ReferenceRays(scene, settings) };
}

/// Adds up the background over the rays that nothing stops.
double gatherLight(
  const Plan& plan, const SurfaceTracer& tracer, const SurfaceRay* first, const SurfaceRay* last)
{
  double light = 0;
  for (; first != last; ++first)
  {
    const SurfaceRay& ray = *first;
    const bool open = !tracer.occluded(ray);
    if (plan.uniform)
    {
      light += open; // no branch on what cannot be foreseen
    }
    else if (open)
    {
      light += luminance(plan.settings.background, ray.direction.as<double>());
    }
  }
  return light;
}

/// Makes the rays of a row of texels: those of column c end at work.ends[c].
void makeRow(const Plan& plan, unsigned id, int row, float* shares, Workspace& work)
{
  work.row.clear();
  work.ends.clear();
  for (int column = 0; column < plan.resolution; ++column)
  {
    const std::size_t before = work.row.size();
    const int samples = plan.rays.makeRays(id, row, column, work.rays, work.row);
    const std::size_t outside = work.row.size() - before;
    work.ends.push_back(work.row.size());
    work.counters.texelsInside += samples == 0;
    work.counters.rays += outside;
    work.counters.samplesInside += static_cast<std::uint64_t>(samples) - outside;
    shares[column] =
      outside == 0 ? 0.0f : static_cast<float>(outside) / static_cast<float>(samples);
  }
}

void traceRow(const Plan& plan, unsigned id, float* values, Workspace& work)
{
  const SurfaceTracer tracer(plan.scene.rays(), id, plan.rayLength);
  std::size_t begin = 0;
  for (std::size_t column = 0; column < work.ends.size(); ++column)
  {
    const std::size_t end = work.ends[column];
    const double light = gatherLight(plan, tracer, work.row.data() + begin, work.row.data() + end);
    values[column] =
      begin == end ? 0.0f : static_cast<float>(light / static_cast<double>(end - begin));
    begin = end;
  }
}

/// Fills the T * T values and shares of one particle, which are zero on entry.
void estimateParticle(
  const Plan& plan, unsigned id, float* values, float* shares, Workspace& work, Progress& progress)
{
  ++work.counters.particles;
  work.counters.texels += plan.texels;
  if (!plan.rays.beginParticle(id, work.rays))
  {
    ++work.counters.particlesBuried;
    progress.advance(plan.texels);
    return;
  }
  for (int row = 0; row < plan.resolution; ++row)
  {
    // Row by row: rays made and traced texel by texel would push each other out of the caches.
    const std::size_t first = texelIndex(plan.resolution, row, 0);
    makeRow(plan, id, row, shares + first, work);
    traceRow(plan, id, values + first, work);
    if (!progress.advance(static_cast<std::uint64_t>(plan.resolution)))
    {
      return;
    }
  }
}

/// Particles per hand-over: enough rays to keep all threads busy, few enough to need little memory.
std::size_t chunkSize(const Plan& plan)
{
  constexpr std::size_t raysPerChunk = std::size_t(1) << 22;
  const std::size_t raysPerParticle =
    plan.texels * static_cast<std::size_t>(plan.settings.samplesPerTexel);
  return std::clamp<std::size_t>(raysPerChunk / raysPerParticle, 64, 1 << 16);
}
}

void ReferenceEstimator::estimate(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, Progress& progress, const Sink& sink, BakeCounters& counters) const
{
  scene.prepareRays();
  const Plan plan = makePlan(scene, settings);
  const std::size_t chunk = chunkSize(plan);
  tbb::enumerable_thread_specific<Workspace> workspaces;
  std::vector<float> values;
  std::vector<float> shares;

  const double rays = static_cast<double>(particles.size() * plan.texels) *
    static_cast<double>(settings.samplesPerTexel);
  progress.begin(particles.size() * plan.texels, inMillions(rays) + " rays");
  for (std::size_t first = 0; first < particles.size() && !progress.aborted(); first += chunk)
  {
    const std::size_t count = std::min(chunk, particles.size() - first);
    values.assign(count * plan.texels, 0.0f);
    shares.assign(count * plan.texels, 0.0f);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range)
      {
        Workspace& work = workspaces.local();
        for (std::size_t i = range.begin(); i < range.end() && !progress.aborted(); ++i)
        {
          estimateParticle(plan, particles[first + i], values.data() + i * plan.texels,
            shares.data() + i * plan.texels, work, progress);
        }
      });
    if (!progress.aborted())
    {
      sink({ first, count, values.data(), shares.data() });
    }
  }
  for (const Workspace& work : workspaces)
  {
    counters.add(work.counters);
  }
  counters.threads = static_cast<unsigned>(workspaces.size());
}
}
