// SPDX-License-Identifier: BSD-3-Clause
#include "SweepEstimator.h"

#include "ProgressiveSweep.h"

#include <algorithm>
#include <cmath>

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

/// The error falls as D^-1/2 at worst; aim a little further and look again.
int moreDirections(int directions, double excess)
{
  const double factor = std::clamp(1.1 * excess * excess, 1.25, 8.0);
  const double total = std::ceil(directions * factor / DirectionsPerBlock) * DirectionsPerBlock;
  return static_cast<int>(std::min<double>(total, SweepEstimator::MaximumDirections));
}

/// Sets of directions until the error is small enough.
void refineToTarget(
  ProgressiveSweep& sweep, double targetError, Progress& progress, SweepReport& report)
{
  int done = 0;
  int wanted = FirstDirections;
  while (!progress.aborted())
  {
    sweep.refine(wanted - done, progress, ProgressiveSweep::Spread::InSubsets);
    done = wanted;
    report.estimatedError = sweep.estimatedError();
    report.reached = Margin * report.estimatedError <= targetError;
    if (report.reached || done == SweepEstimator::MaximumDirections)
    {
      return;
    }
    wanted = moreDirections(done, Margin * report.estimatedError / targetError);
  }
}
}

int sweepDirectionsForSamples(int samplesPerTexel)
{
  // Directions at the error of jittered rays, between measured numbers of directions: 49 rays, 85
  // (pack) to 140 (molecule); 200 rays, 320 (molecule) to 440 (gas). Of 16 rays it is known only
  // that 64 directions are better in pack, overlap, gas, foam and molecule.
  const double directions = 144 * std::pow(samplesPerTexel / 49.0, 0.9);
  const double blocks = std::ceil(directions / DirectionsPerBlock);
  return static_cast<int>(
    std::clamp(blocks * DirectionsPerBlock, 16.0, double(SweepEstimator::MaximumDirections)));
}

void SweepEstimator::estimate(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, Progress& progress, const Sink& sink, BakeCounters& counters) const
{
  report_ = {};
  ProgressiveSweep sweep(scene, particles, settings, options_.skips);
  if (options_.targetError > 0)
  {
    refineToTarget(sweep, options_.targetError, progress, report_);
  }
  else
  {
    sweep.refine(options_.directions > 0 ? options_.directions
                                         : sweepDirectionsForSamples(settings.samplesPerTexel),
      progress);
  }
  report_.directions = sweep.directions();
  if (progress.aborted())
  {
    return;
  }
  report_.estimatedError = sweep.estimatedError();
  sweep.handOut(sink, progress, counters);
}
}
