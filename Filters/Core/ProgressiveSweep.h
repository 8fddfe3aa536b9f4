// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ProgressiveSweep_h
#define po_ProgressiveSweep_h

#include "OcclusionEstimator.h"
#include "SphereSweep.h"
#include "SweepScene.h"
#include "SweepTexels.h"
#include "VisibilityRecords.h"

#include <vector>

namespace po
{
/// A sweep that goes on for as long as its owner wants: its textures may be handed out after any
/// number of directions (16 make a preview) and refined later.
///
/// The result depends on the scene, the settings and the sequence of refinements, not on threads.
class ProgressiveSweep
{
public:
  /// @param particles whose textures are wanted, by their index in the cloud; all others occlude.
  /// The scene and the settings must outlive this.
  ProgressiveSweep(const BakeScene& scene, std::vector<unsigned> particles,
    const BakeSettings& settings, const SweepSkips& skips = {});

  /// Sweeps that many more directions (an odd number is rounded up), spread evenly by themselves.
  /// Returns early when `progress` says so; the sweep cannot go on then.
  void refine(int directions, Progress& progress);

  /// Swept so far, without those that the background makes black.
  [[nodiscard]] int directions() const;

  /// RMS error of linear visibility, from the spread of subsets of the directions over up to 256
  /// particles; 0 with less than one direction for each of the four subsets of a block of 16.
  [[nodiscard]] double estimatedError() const;

  /// Hands the textures out in the order of the particles, on the calling thread.
  void handOut(
    const OcclusionEstimator::Sink& sink, Progress& progress, BakeCounters& counters) const;

private:
  const BakeSettings& settings_;
  std::vector<unsigned> particles_;
  SweepScene order_;
  SweepTexels texels_;
  std::vector<unsigned> watched_; ///< by index in `order_`
  VisibilityRecords records_;
  SphereSweep sweep_;
  std::uint64_t rounds_ = 0;
};
}

#endif
