// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceEstimator.h"

#include "ReferenceRays.h"
#include "TexelMap.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
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
  BakeCounters counters;
};

Plan makePlan(const BakeScene& scene, const BakeSettings& settings)
{
  const auto side = static_cast<std::size_t>(settings.textureResolution);
  Plan plan{ scene, settings, settings.textureResolution, side * side,
    std::numeric_limits<float>::infinity(),
    std::holds_alternative<UniformBackground>(settings.background),
    ReferenceRays(scene, settings) };
  if (settings.maximumDistance > 0)
  {
    plan.rayLength = static_cast<float>(settings.maximumDistance / scene.cloud.scale);
  }
  return plan;
}

struct TexelEstimate
{
  float value = 0;
  float outsideShare = 0;
};

/// Adds up the background over the rays that nothing stops.
double gatherLight(const Plan& plan, unsigned id, const std::vector<TexelRay>& rays)
{
  double light = 0;
  for (const TexelRay& ray : rays)
  {
    if (!plan.scene.rays.occluded(ray.origin, ray.direction.as<float>(), plan.rayLength, id))
    {
      light += plan.uniform ? 1 : luminance(plan.settings.background, ray.direction);
    }
  }
  return light;
}

TexelEstimate estimateTexel(const Plan& plan, unsigned id, int row, int column, Workspace& work)
{
  const int samples = plan.rays.makeRays(id, row, column, work.rays);
  const std::size_t outside = work.rays.rays.size();
  work.counters.texelsInside += samples == 0;
  work.counters.rays += outside;
  work.counters.samplesInside += static_cast<std::uint64_t>(samples) - outside;
  if (outside == 0)
  {
    return {};
  }
  const double light = gatherLight(plan, id, work.rays.rays);
  return { static_cast<float>(light / static_cast<double>(outside)),
    static_cast<float>(outside) / static_cast<float>(samples) };
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
    for (int column = 0; column < plan.resolution; ++column)
    {
      const std::size_t texel = texelIndex(plan.resolution, row, column);
      const TexelEstimate estimate = estimateTexel(plan, id, row, column, work);
      values[texel] = estimate.value;
      shares[texel] = estimate.outsideShare;
      if (!progress.advance(1))
      {
        return;
      }
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
  const Plan plan = makePlan(scene, settings);
  const std::size_t chunk = chunkSize(plan);
  tbb::enumerable_thread_specific<Workspace> workspaces;
  std::vector<float> values;
  std::vector<float> shares;

  progress.begin(particles.size() * plan.texels);
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
