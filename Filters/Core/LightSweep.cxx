// SPDX-License-Identifier: BSD-3-Clause
#include "LightSweep.h"

#include "SphereSweep.h"

#include <limits>
#include <utility>

namespace po
{
namespace
{
/// Every test is exact, and no sphere is left out since other points have not shown it.
SweepSkips exactSkips()
{
  SweepSkips skips;
  skips.neverSeen = false;
  skips.offsetMasks = false;
  return skips;
}
}

LightSweep::LightSweep(const BakeScene& scene, const std::vector<unsigned>& particles,
  const SweepTexels& texels, std::uint64_t seed, Vec3d direction, float distance, bool outOfCore,
  Progress& progress)
  : order_(scene.set())
  , alone_(order_.size(), 0)
{
  if (outOfCore)
  {
    log_ = std::make_unique<LoggedVisibility>(texels, order_.indicesOf(particles), order_.size(),
      LoggedVisibility::Watch::Some, std::vector<unsigned>());
  }
  records_.emplace(scene, order_, texels, seed, order_.flagsOf(particles), alone_,
    std::vector<unsigned>(), std::move(log_));
  {
    SphereSweep sweep(
      order_, white_, distance, *records_, exactSkips(), alone_, scene.group, AxisWays::Forward);
    progress.begin(2 * TexelPatterns::Count * order_.size(), "Sweep along the light");
    // Points take turns: each serves one of the axes, which are all the same.
    sweep.run(std::vector<Vec3d>(TexelPatterns::Count, direction), progress);
  }
  alone_ = std::vector<std::uint8_t>();
  if (outOfCore)
  {
    log_ = records_->takeLog();
    log_->endSweep();
    records_.reset();
  }
}

std::size_t LightSweep::loadFor(std::size_t place)
{
  return log_ ? log_->loadFor(place) : std::numeric_limits<std::size_t>::max();
}

const float* LightSweep::sums(unsigned particle) const
{
  const unsigned sphere = order_.indexOf(particle);
  return log_ ? log_->sums(sphere) : records_->sums(sphere);
}
}
