// SPDX-License-Identifier: BSD-3-Clause
#include "LightSweep.h"

#include "SphereSweep.h"

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
  const SweepTexels& texels, std::uint64_t seed, Vec3d direction, float distance,
  Progress& progress)
  : order_(scene.set())
  , alone_(order_.size(), 0)
  , records_(scene, order_, texels, seed, order_.flagsOf(particles), alone_, {})
{
  SphereSweep sweep(
    order_, white_, distance, records_, exactSkips(), alone_, scene.group, AxisWays::Forward);
  progress.begin(2 * TexelPatterns::Count * order_.size(), "Sweep along the light");
  // Points take turns: each serves one of the axes, which are all the same.
  sweep.run(std::vector<Vec3d>(TexelPatterns::Count, direction), progress);
}

const float* LightSweep::sums(unsigned particle) const
{
  return records_.sums(order_.indexOf(particle));
}
}
