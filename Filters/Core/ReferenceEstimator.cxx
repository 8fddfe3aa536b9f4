// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceEstimator.h"

#include "Constants.h"
#include "Random.h"
#include "Sampling.h"
#include "TexelMap.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace po
{
namespace
{
/// What all texels of a row have in common.
struct TexelRow
{
  double angularRadius; ///< of a texel, radians
  int sharedColumns;    ///< so many neighbouring texels use the same random numbers
};

/// Texels near a pole are slivers: with noise of their own they would meet in a visible star. As
/// many as make up the width of a texel on the equator share their random numbers, so that their
/// errors are nearly equal; around the pole all do. Every texel by itself stays an unbiased
/// estimate.
int columnsSharingRandomNumbers(int resolution, int row)
{
  if (row == 0 || row == resolution - 1)
  {
    return resolution;
  }
  return static_cast<int>(std::lround(1 / std::sin(Pi * (row + 0.5) / resolution)));
}

/// Read-only state of a bake.
struct Plan
{
  const BakeScene& scene;
  const BakeSettings& settings;
  int resolution;
  std::size_t texels;
  float rayLength; ///< local, infinite when unbounded
  bool uniform;    ///< every direction of the background has luminance 1
  StratifiedSquare strata;
  std::vector<TexelRow> rows;
};

/// Memory that a thread uses again and again.
struct Workspace
{
  explicit Workspace(int samples)
    : pairing(static_cast<std::size_t>(samples))
  {
  }

  Overlaps overlaps;
  std::vector<BuriedCap> cuttingCaps; ///< caps whose rim crosses the texel at hand
  std::vector<std::uint32_t> pairing; ///< stratum of the direction for each stratum of the texel
  BakeCounters counters;
};

Plan makePlan(const BakeScene& scene, const BakeSettings& settings)
{
  const int resolution = settings.textureResolution;
  const auto side = static_cast<std::size_t>(resolution);
  Plan plan{ scene, settings, resolution, side * side, std::numeric_limits<float>::infinity(),
    std::holds_alternative<UniformBackground>(settings.background),
    StratifiedSquare(settings.samplesPerTexel), {} };
  if (settings.maximumDistance > 0)
  {
    plan.rayLength = static_cast<float>(settings.maximumDistance / scene.cloud.scale);
  }
  for (int row = 0; row < resolution; ++row)
  {
    plan.rows.push_back(
      { texelAngularRadius(resolution, row), columnsSharingRandomNumbers(resolution, row) });
  }
  return plan;
}

/// Sorts the caps into those that miss the texel and those that cut it; true if one covers it all.
bool selectCaps(const Plan& plan, int row, int column, Workspace& work)
{
  work.cuttingCaps.clear();
  const Vec3d center =
    textureDirection({ (column + 0.5) / plan.resolution, (row + 0.5) / plan.resolution });
  // A little wider than the texel: rounding may then cost time, but never a wrong answer.
  const double reach = plan.rows[static_cast<std::size_t>(row)].angularRadius + 1e-6;
  for (const BuriedCap& cap : work.overlaps.caps)
  {
    const double angle = std::acos(std::clamp(dot(center, cap.axis), -1.0, 1.0));
    const double halfAngle = std::acos(cap.cosine);
    if (angle + reach < halfAngle)
    {
      return true;
    }
    if (angle - reach <= halfAngle)
    {
      work.cuttingCaps.push_back(cap);
    }
  }
  return false;
}

bool insideAny(const std::vector<BuriedCap>& caps, Vec3d normal)
{
  return std::any_of(caps.begin(), caps.end(),
    [normal](const BuriedCap& cap) { return dot(normal, cap.axis) > cap.cosine; });
}

struct TexelEstimate
{
  float value = 0;
  float outsideShare = 0;
};

/// The sums of the rays of one texel.
struct TexelSums
{
  int samples = 0;
  int outside = 0;
  double light = 0;
};

/// One stratified set of rays from the part of a texel that is outside the cutting caps.
void addRays(const Plan& plan, unsigned id, const TexelPatch& patch, Random& random,
  Workspace& work, TexelSums& sums)
{
  const Sphere& sphere = plan.scene.rays.spheres()[id];
  randomPermutation(random, work.pairing);
  const int samples = plan.strata.size();
  sums.samples += samples;
  for (int k = 0; k < samples; ++k)
  {
    const Point2 place = plan.strata.point(k, random.uniform(), random.uniform());
    const Point2 heading =
      plan.strata.point(static_cast<int>(work.pairing[static_cast<std::size_t>(k)]),
        random.uniform(), random.uniform());
    const Vec3d normal = patch.point(place.x, place.y);
    if (insideAny(work.cuttingCaps, normal))
    {
      continue;
    }
    ++sums.outside;
    const Vec3d direction = aboutNormal(normal, cosineHemisphereFromSquare(heading));
    const Vec3f origin = sphere.center() + sphere.radius * normal.as<float>();
    if (!plan.scene.rays.occluded(origin, direction.as<float>(), plan.rayLength, id))
    {
      sums.light += plan.uniform ? 1 : luminance(plan.settings.background, direction);
    }
  }
}

TexelEstimate estimateTexel(const Plan& plan, unsigned id, int row, int column, Workspace& work)
{
  if (selectCaps(plan, row, column, work))
  {
    ++work.counters.texelsInside;
    return {};
  }
  const TexelPatch patch(plan.resolution, row, column);
  const int shared = plan.rows[static_cast<std::size_t>(row)].sharedColumns;
  Random random(plan.settings.seed, static_cast<std::uint64_t>(plan.scene.cloud.sourceIds[id]),
    texelIndex(plan.resolution, row, column - column % shared));

  // A texel of which little is outside would be left with few rays, and show as a noisy rim of the
  // overlap: it gets further sets. Where to stop depends on the geometry alone, so there is no
  // bias.
  constexpr int MaximumSets = 8;
  TexelSums sums;
  addRays(plan, id, patch, random, work, sums);
  for (int set = 1; set < MaximumSets && sums.outside > 0 && 2 * sums.outside < plan.strata.size();
       ++set)
  {
    addRays(plan, id, patch, random, work, sums);
  }
  work.counters.rays += static_cast<std::uint64_t>(sums.outside);
  work.counters.samplesInside += static_cast<std::uint64_t>(sums.samples - sums.outside);
  return { sums.outside > 0 ? static_cast<float>(sums.light / sums.outside) : 0.0f,
    static_cast<float>(sums.outside) / static_cast<float>(sums.samples) };
}

/// Fills the T * T values and shares of one particle, which are zero on entry.
void estimateParticle(
  const Plan& plan, unsigned id, float* values, float* shares, Workspace& work, Progress& progress)
{
  ++work.counters.particles;
  work.counters.texels += plan.texels;
  plan.scene.overlaps.find(id, work.overlaps);
  if (work.overlaps.buried)
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
  tbb::enumerable_thread_specific<Workspace> workspaces(settings.samplesPerTexel);
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
