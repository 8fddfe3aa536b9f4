// SPDX-License-Identifier: BSD-3-Clause
#include "SweepEstimator.h"

#include "Random.h"
#include "SphereSweep.h"
#include "SweepDirections.h"
#include "SweepTextures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace po
{
namespace
{
constexpr std::size_t WatchedParticles = 256;

/// Directions of the first look with a target error.
constexpr int FirstDirections = 128;

std::vector<std::uint8_t> listedFlags(
  const BakeScene& scene, const std::vector<unsigned>& particles)
{
  std::vector<std::uint8_t> flags(scene.rays.spheres().size(), 0);
  for (const unsigned particle : particles)
  {
    flags[particle] = 1;
  }
  return flags;
}

/// Up to 256 particles of the list, drawn by the seed.
std::vector<unsigned> watchedParticles(std::vector<unsigned> particles, std::uint64_t seed)
{
  const std::size_t count = std::min(particles.size(), WatchedParticles);
  Random random(seed, particles.size(), 0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto left = static_cast<std::uint32_t>(particles.size() - i);
    std::swap(particles[i], particles[i + random.below(left)]);
  }
  particles.resize(count);
  return particles;
}

double estimatedError(const SweepTextures& textures, const std::vector<unsigned>& watched)
{
  SweepTextures::SquaredError all;
  for (const unsigned particle : watched)
  {
    const SweepTextures::SquaredError error = textures.squaredError(particle);
    all.sum += error.sum;
    all.area += error.area;
  }
  return all.area > 0 ? std::sqrt(all.sum / all.area) : 0;
}

/// The error falls as D^-1/2 at worst; aim a little further and look again.
int moreDirections(int directions, double excess)
{
  const double factor = std::clamp(1.1 * excess * excess, 1.25, 8.0);
  const double total = std::ceil(directions * factor / SweepBlock) * SweepBlock;
  return static_cast<int>(std::min<double>(total, SweepEstimator::MaximumDirections));
}

/// Sets of directions, each spread evenly by itself, until the error is small enough.
void sweepToTarget(SphereSweep& sweep, const VisibilityRecords& records,
  const BakeSettings& settings, const std::vector<unsigned>& watched, double targetError,
  std::size_t spheres, Progress& progress, SweepReport& report)
{
  int done = 0;
  int wanted = FirstDirections;
  for (std::uint64_t round = 0; !progress.aborted(); ++round)
  {
    progress.begin(static_cast<std::uint64_t>(wanted - done) * spheres);
    sweep.run(sweepDirections(wanted - done, mixBits(settings.seed + round)), progress);
    done = wanted;
    report.estimatedError = estimatedError(SweepTextures(records, settings.background), watched);
    report.reached = report.estimatedError <= targetError;
    if (report.reached || done == SweepEstimator::MaximumDirections)
    {
      return;
    }
    wanted = moreDirections(done, report.estimatedError / targetError);
  }
}

/// Hands the textures out in the order of the list.
void handOut(const SweepTextures& textures, const std::vector<unsigned>& particles, int resolution,
  const OcclusionEstimator::Sink& sink, Progress& progress, BakeCounters& counters)
{
  constexpr std::size_t valuesPerChunk = std::size_t(1) << 22;
  const auto texels = static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution);
  const std::size_t chunk = std::max<std::size_t>(1, valuesPerChunk / texels);
  std::vector<float> values;
  std::vector<float> shares;
  for (std::size_t first = 0; first < particles.size() && !progress.aborted(); first += chunk)
  {
    const std::size_t count = std::min(chunk, particles.size() - first);
    values.resize(count * texels);
    shares.resize(count * texels);
    tbb::parallel_for(std::size_t(0), count,
      [&](std::size_t i) {
        textures.fill(particles[first + i], values.data() + i * texels, shares.data() + i * texels);
      });
    counters.texelsInside +=
      static_cast<std::uint64_t>(std::count(shares.begin(), shares.end(), 0.0f));
    sink({ first, count, values.data(), shares.data() });
    progress.advance(0);
  }
}
}

int sweepDirectionsForSamples(int samplesPerTexel)
{
  // Directions at the error of jittered rays, between measured numbers of directions: 49 rays, 85
  // (pack) to 140 (molecule); 200 rays, 320 (molecule) to 440 (gas). Of 16 rays it is known only
  // that 64 directions are better in pack, overlap, gas, foam and molecule.
  const double directions = 144 * std::pow(samplesPerTexel / 49.0, 0.9);
  const double blocks = std::ceil(directions / SweepBlock);
  return static_cast<int>(
    std::clamp(blocks * SweepBlock, 16.0, double(SweepEstimator::MaximumDirections)));
}

void SweepEstimator::estimate(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, Progress& progress, const Sink& sink, BakeCounters& counters) const
{
  report_ = {};
  const SweepTexels texels(settings.textureResolution);
  const std::vector<unsigned> watched = watchedParticles(particles, settings.seed);
  VisibilityRecords records(scene, texels, settings.seed, listedFlags(scene, particles), watched);
  const float distance = settings.maximumDistance > 0
    ? static_cast<float>(settings.maximumDistance / scene.cloud.scale)
    : std::numeric_limits<float>::infinity();
  SphereSweep sweep(scene, settings.background, distance, records);
  const std::size_t spheres = scene.rays.spheres().size();
  if (options_.targetError > 0)
  {
    sweepToTarget(
      sweep, records, settings, watched, options_.targetError, spheres, progress, report_);
  }
  else
  {
    const int directions = options_.directions > 0
      ? options_.directions
      : sweepDirectionsForSamples(settings.samplesPerTexel);
    progress.begin(static_cast<std::uint64_t>(directions) * spheres);
    sweep.run(sweepDirections(directions, settings.seed), progress);
  }
  report_.directions = sweep.directions();
  if (progress.aborted())
  {
    return;
  }
  const SweepTextures textures(records, settings.background);
  report_.estimatedError = estimatedError(textures, watched);
  handOut(textures, particles, settings.textureResolution, sink, progress, counters);
  counters.particles += particles.size();
  counters.texels += particles.size() * static_cast<std::size_t>(settings.textureResolution) *
    static_cast<std::size_t>(settings.textureResolution);
  counters.particlesBuried += records.buried();
  counters.threads = std::max(counters.threads, sweep.threads());
}
}
