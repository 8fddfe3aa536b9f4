// SPDX-License-Identifier: BSD-3-Clause
#include "SweepEstimator.h"

#include "EmbreeEstimator.h"
#include "ProgressiveSweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace po
{
namespace
{
constexpr int DirectionsPerBlock = 2 * static_cast<int>(AxesPerBlock);

/// Directions of the first look with a target error.
constexpr int FirstDirections = 64;

/// The estimate is itself known to some percent only: four subsets of directions, which all
/// particles share. With this margin the error stays below the target in 95 of 100 bakes.
constexpr double Margin = 1.1;

/// What a particle costs by rays, in terms of the sweep with as many directions: measured 4
/// (overlap) to 14 (gas), and somewhat more for directions beyond need, whose number doubles.
constexpr double RayCost = 16;

/// The error falls as D^-1/2 at worst; aim a little further and look again.
int moreDirections(int directions, double excess)
{
  const double factor = std::clamp(1.1 * excess * excess, 1.25, 8.0);
  const double total = std::ceil(directions * factor / DirectionsPerBlock) * DirectionsPerBlock;
  return static_cast<int>(std::min<double>(total, SweepEstimator::MaximumDirections));
}

/// A sweep that goes on until the error is small enough, and may leave the last few particles to
/// rays.
class TargetedSweep
{
public:
  TargetedSweep(const BakeScene& scene, const std::vector<unsigned>& particles,
    const BakeSettings& settings, const SweepOptions& options, Progress& progress)
    : scene_(scene)
    , particles_(particles)
    , settings_(settings)
    , options_(options)
    , progress_(progress)
    , sweep_(scene, particles, settings,
        { options.skips, ProgressiveSweep::Watch::All, ProgressiveSweep::Records::InMemory,
          options.smooth })
  {
  }

  void run(const OcclusionEstimator::Sink& sink, BakeCounters& counters)
  {
    sweepAndRefine(counters);
    report_.directions = sweep_.directions();
    if (!progress_.aborted())
    {
      sweep_.end();
      sweep_.handOut(sink, progress_, counters, refined_);
    }
  }

  [[nodiscard]] const SweepReport& report() const { return report_; }

private:
  void sweepAndRefine(BakeCounters& counters)
  {
    int done = 0;
    int wanted = FirstDirections;
    while (!progress_.aborted())
    {
      sweep_.refine(wanted - done, progress_, ProgressiveSweep::Spread::InSubsets);
      if (progress_.aborted())
      {
        return; // the other processes are told by the owner, and wait for nothing else
      }
      done = wanted;
      errors_ = sweep_.squaredErrors();
      judge();
      if (report_.reached || done == SweepEstimator::MaximumDirections)
      {
        return;
      }
      wanted = moreDirections(done, excess(report_.estimatedError));
      if (options_.refineByRays && raysAreCheaper(done, wanted - done))
      {
        refineByRays(counters);
        judge();
        return;
      }
    }
  }

  /// How many times an error is above what the target asks for.
  [[nodiscard]] double excess(double error) const { return Margin * error / options_.targetError; }

  void judge()
  {
    SquaredError all;
    for (const SquaredError& error : errors_)
    {
      all.add(error);
    }
    all = { scene_.group.sum(all.sum), scene_.group.sum(all.area) };
    report_.estimatedError = all.rms();
    report_.reached = excess(report_.estimatedError) <= 1;
  }

  /// Whether rays take the particles that are above the target below it at less work than the next
  /// round of directions would be: of all processes, which must go on alike.
  [[nodiscard]] bool raysAreCheaper(int done, int more) const
  {
    const double needed = scene_.group.sum(directionsByRays(done));
    // With a bounded distance each process sweeps a part of the spheres.
    const double swept = settings_.maximumDistance > 0
      ? scene_.group.sum(static_cast<double>(particles_.size()))
      : static_cast<double>(sweep_.spheres());
    return RayCost * needed < more * swept;
  }

  /// Summed over the particles that are above the target; infinite if one asks for too many.
  [[nodiscard]] double directionsByRays(int done) const
  {
    double needed = 0;
    for (const SquaredError& error : errors_)
    {
      const double factor = excess(error.rms());
      if (factor > 1)
      {
        // Between the D^-1/2 of the worst case and the D^-3/4 of the best.
        const double directions = done * std::pow(factor, 1.5);
        needed += directions <= EmbreeEstimator::MaximumDirections
          ? directions
          : std::numeric_limits<double>::infinity();
      }
    }
    return needed;
  }

  void refineByRays(BakeCounters& counters)
  {
    std::vector<unsigned> particles;
    for (std::size_t place = 0; place < errors_.size(); ++place)
    {
      if (excess(errors_[place].rms()) > 1)
      {
        refined_.places.push_back(place);
        particles.push_back(particles_[place]);
      }
    }
    EmbreeOptions options;
    options.targetError = options_.targetError / Margin;
    const EmbreeEstimator embree(options);
    BakeCounters work;
    embree.estimate(
      scene_, particles, settings_, progress_, [this](const RawTextures& raw) { keep(raw); }, work);
    counters.rays += work.rays;
    counters.threads = std::max(counters.threads, work.threads);
    report_.refined = particles.size();
    for (const std::size_t place : refined_.places)
    {
      SquaredError& error = errors_[place];
      error.sum = error.area * embree.report().estimatedError * embree.report().estimatedError;
    }
  }

  void keep(const RawTextures& raw)
  {
    const auto side = static_cast<std::size_t>(settings_.textureResolution);
    const std::size_t count = raw.count * side * side;
    refined_.values.insert(refined_.values.end(), raw.values, raw.values + count);
    refined_.shares.insert(refined_.shares.end(), raw.outsideShares, raw.outsideShares + count);
  }

  const BakeScene& scene_;
  const std::vector<unsigned>& particles_;
  const BakeSettings& settings_;
  const SweepOptions& options_;
  Progress& progress_;
  ProgressiveSweep sweep_;
  std::vector<SquaredError> errors_; ///< in the order of the list
  TextureReplacements refined_;
  SweepReport report_;
};
}

int sweepDirectionsForSamples(int samplesPerTexel)
{
  // Directions at the error of jittered rays, between measured numbers of directions: 49 rays, 49
  // (pack) to 107 (gas). Exponent: between those of the error of rays and of directions.
  const double directions = 112 * std::pow(samplesPerTexel / 49.0, 0.9);
  const double blocks = std::ceil(directions / DirectionsPerBlock);
  return static_cast<int>(
    std::clamp(blocks * DirectionsPerBlock, 16.0, double(SweepEstimator::MaximumDirections)));
}

void SweepEstimator::estimate(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, Progress& progress, const Sink& sink, BakeCounters& counters) const
{
  report_ = {};
  if (options_.targetError > 0)
  {
    TargetedSweep sweep(scene, particles, settings, options_, progress);
    sweep.run(sink, counters);
    report_ = sweep.report();
    return;
  }
  sweepOnce(scene, particles, settings, progress, sink, counters);
}

void SweepEstimator::sweepOnce(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, Progress& progress, const Sink& sink, BakeCounters& counters) const
{
  const int directions = options_.directions > 0
    ? options_.directions
    : sweepDirectionsForSamples(settings.samplesPerTexel);
  const auto records =
    options_.outOfCore ? ProgressiveSweep::Records::OutOfCore : ProgressiveSweep::Records::InMemory;
  ProgressiveSweep sweep(scene, particles, settings,
    { options_.skips, ProgressiveSweep::Watch::Some, records, options_.smooth });
  sweep.refine(directions, progress);
  report_.directions = sweep.directions();
  if (!progress.aborted())
  {
    sweep.end();
    sweep.handOut(sink, progress, counters);
    report_.estimatedError = sweep.estimatedError();
  }
}
}
