// SPDX-License-Identifier: BSD-3-Clause
#include "EmbreeEstimator.h"

#include "DirectionSets.h"
#include "ParticleView.h"
#include "Random.h"
#include "RimFinder.h"
#include "SweepEstimator.h"
#include "TexelSums.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <string>

namespace po
{
namespace
{
/// Directions of the first set with a target error.
constexpr int FirstDirections = 128;

/// Without a target the error bar comes from up to so many particles.
constexpr std::size_t WatchedParticles = 256;

/// Particles that are at work at a time have so many slots together, of up to 50 bytes.
constexpr std::size_t SlotsPerChunk = std::size_t(1) << 18;

/// Memory that a thread uses again and again.
struct Workspace
{
  ParticleView view;
  Overlaps overlaps;
  RimFinder rims;
  std::vector<GroupMask> exposed;
  std::vector<GroupMask> seen;
  BakeCounters counters;
};

/// A particle of the chunk at hand.
struct ParticleWork
{
  ParticleWork(std::size_t slots, bool spread)
    : sums(slots, spread)
  {
  }

  TexelSums sums;
  SquaredError error;
  bool finished = false;
};

/// Directions without a target.
int directionsOf(const EmbreeOptions& options, const BakeSettings& settings)
{
  return options.directions > 0 ? options.directions
                                : embreeDirectionsForSamples(settings.samplesPerTexel);
}

std::vector<std::vector<Vec3d>> chooseAxes(
  const EmbreeOptions& options, const BakeSettings& settings)
{
  if (options.targetError > 0)
  {
    return DirectionSets::growing(
      FirstDirections, EmbreeEstimator::MaximumDirections, settings.seed);
  }
  return DirectionSets::lattice(directionsOf(options, settings), settings.seed);
}

/// The blur of far shadows shall stay below the noise: squares of 16 texels add 0.008 RMS, of 4
/// half of that; 512 directions leave about 0.02, 4096 about 0.006.
RayShare chooseShare(const EmbreeOptions& options, const BakeSettings& settings)
{
  const bool hasTarget = options.targetError > 0;
  const int directions = hasTarget ? 0 : directionsOf(options, settings);
  const auto noiseAbove = [&](double error, int limit)
  { return hasTarget ? options.targetError >= error : directions <= limit; };
  if (noiseAbove(0.02, 512))
  {
    return RayShare::Sixteen;
  }
  return noiseAbove(0.006, 4096) ? RayShare::Four : RayShare::One;
}

/// Flags by place in the list: drawn by the seed.
std::vector<std::uint8_t> chooseWatched(std::size_t particles, std::uint64_t seed)
{
  std::vector<std::uint8_t> watched(particles, particles <= WatchedParticles ? 1 : 0);
  Random random(seed, particles, 0);
  for (std::size_t i = 0; i < WatchedParticles && particles > 0; ++i)
  {
    watched[random.below(static_cast<std::uint32_t>(particles))] = 1;
  }
  return watched;
}

/// One bake.
class EmbreeBake
{
public:
  EmbreeBake(const BakeScene& scene, const std::vector<unsigned>& particles,
    const BakeSettings& settings, const EmbreeOptions& options, Progress& progress)
    : scene_(scene)
    , particles_(particles)
    , settings_(settings)
    , targetError_(options.targetError)
    , share_(chooseShare(options, settings))
    , progress_(progress)
    , texels_(settings.textureResolution)
    , sets_(
        texels_, settings.background, settings.seed, chooseAxes(options, settings), options.smooth)
    , formula_(texels_, sets_.get(0).directions.patterns(), settings.background)
    , watched_(chooseWatched(particles.size(), settings.seed))
    , workspaces_(
        [this]
        {
          const std::vector<GroupMask> mask(texels_.groups());
          return Workspace{ ParticleView(
                              scene_, scene_.cloud.toLocalReach(settings_.maximumDistance), share_),
            {}, {}, mask, mask, {} };
        })
  {
  }

  void run(const OcclusionEstimator::Sink& sink)
  {
    progress_.begin(
      particles_.size(), "Rays from " + std::to_string(particles_.size()) + " particles");
    const std::size_t chunk = std::clamp<std::size_t>(SlotsPerChunk / texels_.slots(), 64, 1024);
    for (std::size_t first = 0; first < particles_.size() && !progress_.aborted(); first += chunk)
    {
      const std::size_t count = std::min(chunk, particles_.size() - first);
      estimateChunk(first, count);
      if (!progress_.aborted())
      {
        sink({ first, count, values_.data(), shares_.data() });
      }
    }
  }

  void addTo(BakeCounters& counters) const
  {
    for (const Workspace& work : workspaces_)
    {
      counters.add(work.counters);
      counters.rays += work.view.rays();
    }
    counters.directionsBlack += black_;
    counters.threads = std::max(counters.threads, static_cast<unsigned>(workspaces_.size()));
  }

  [[nodiscard]] EmbreeReport report() const
  {
    return { static_cast<int>(directions_), error_.rms(),
      targetError_ > 0 && error_.rms() <= targetError_, above_ };
  }

private:
  [[nodiscard]] std::size_t texelsOfTexture() const
  {
    const auto side = static_cast<std::size_t>(settings_.textureResolution);
    return side * side;
  }

  void estimateChunk(std::size_t first, std::size_t count)
  {
    std::vector<ParticleWork> works;
    for (std::size_t i = 0; i < count; ++i)
    {
      works.emplace_back(texels_.slots(), targetError_ > 0 || watched_[first + i] != 0);
    }
    values_.resize(count * texelsOfTexture());
    shares_.resize(count * texelsOfTexture());
    std::vector<std::size_t> active(count); // places in the chunk
    for (std::size_t i = 0; i < count; ++i)
    {
      active[i] = i;
    }
    for (std::size_t set = 0; set < sets_.size() && !active.empty(); ++set)
    {
      const DirectionSet& directions = sets_.get(set);
      tbb::parallel_for(std::size_t(0), active.size(),
        [&](std::size_t i) { advance(set, directions, first, active[i], works[active[i]]); });
      if (progress_.aborted())
      {
        return;
      }
      countSet(set, directions);
      active.erase(std::remove_if(active.begin(), active.end(),
                     [&](std::size_t i) { return works[i].finished; }),
        active.end());
    }
    addErrors(works);
  }

  /// Takes a particle through one more set; its texture is made when it needs no other.
  void advance(std::size_t set, const DirectionSet& directions, std::size_t first,
    std::size_t place, ParticleWork& work)
  {
    if (progress_.aborted())
    {
      return;
    }
    Workspace& workspace = workspaces_.local();
    look(particles_[first + place], set == 0, directions.directions, work.sums, workspace);
    if (work.sums.hasSubsets())
    {
      work.error = squaredError(formula_, work.sums, directions.open, directions.smoothing);
    }
    work.finished = work.sums.buried || set + 1 == sets_.size() ||
      (targetError_ > 0 && work.error.rms() <= targetError_);
    if (work.finished)
    {
      finish(place, work, directions, workspace);
    }
  }

  void finish(std::size_t place, const ParticleWork& work, const DirectionSet& directions,
    Workspace& workspace)
  {
    const std::size_t texels = texelsOfTexture();
    float* shares = shares_.data() + place * texels;
    float* values = values_.data() + place * texels;
    fillTexture(formula_, work.sums, directions.open, values, shares);
    directions.smoothing.apply(values, shares);
    BakeCounters& counters = workspace.counters;
    ++counters.particles;
    counters.texels += texels;
    counters.particlesBuried += work.sums.buried;
    counters.texelsInside += static_cast<std::uint64_t>(std::count(shares, shares + texels, 0.0f));
    progress_.advance(1);
  }

  /// Adds what a particle sees along all directions of a set.
  void look(
    unsigned id, bool firstSet, const SharedDirections& set, TexelSums& sums, Workspace& work)
  {
    scene_.overlaps.find(id, work.overlaps);
    if (work.overlaps.buried)
    {
      sums.buried = true;
      return;
    }
    TexelExposure exposure;
    if (!work.overlaps.caps.empty())
    {
      exposeTexels(texels_, set.patterns(), work.rims.find(texels_, work.overlaps.caps), exposure);
      if (firstSet)
      {
        OutsideSurface outside;
        formula_.cut(exposure, outside);
        sums.makeCut(std::move(outside));
      }
    }
    work.view.begin(id);
    for (const SharedDirection& direction : set.directions())
    {
      if (!progress_.advance(0))
      {
        return;
      }
      if (!facingOutside(direction.facing, exposure, direction.pattern, work.exposed))
      {
        continue;
      }
      work.seen = work.exposed;
      Random random(settings_.seed, scene_.randomKey(id), direction.index);
      work.view.hide(direction, random, work.seen.data());
      sums.add(direction, work.exposed.data(), work.seen.data());
    }
  }

  void countSet(std::size_t set, const DirectionSet& directions)
  {
    if (set == setsCounted_)
    {
      directions_ += directions.directions.directions().size();
      black_ += directions.directions.black();
      ++setsCounted_;
    }
  }

  /// In the order of the list, so that the sum is the same for any number of threads.
  void addErrors(const std::vector<ParticleWork>& works)
  {
    for (const ParticleWork& work : works)
    {
      error_.add(work.error);
      above_ += targetError_ > 0 && work.error.rms() > targetError_;
    }
  }

  const BakeScene& scene_;
  const std::vector<unsigned>& particles_;
  const BakeSettings& settings_;
  double targetError_;
  RayShare share_;
  Progress& progress_;
  SweepTexels texels_;
  DirectionSets sets_;
  TextureFormula formula_;
  std::vector<std::uint8_t> watched_;
  tbb::enumerable_thread_specific<Workspace> workspaces_;
  std::vector<float> values_; ///< of the chunk at hand
  std::vector<float> shares_;
  std::size_t setsCounted_ = 0;
  std::size_t directions_ = 0;
  std::size_t black_ = 0;
  std::size_t above_ = 0; ///< particles that did not reach the target
  SquaredError error_;
};
}

int embreeDirectionsForSamples(int samplesPerTexel)
{
  return sweepDirectionsForSamples(samplesPerTexel);
}

void EmbreeEstimator::estimate(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, Progress& progress, const Sink& sink, BakeCounters& counters) const
{
  scene.prepareRays();
  EmbreeBake bake(scene, particles, settings, options_, progress);
  bake.run(sink);
  bake.addTo(counters);
  report_ = bake.report();
}
}
