// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SweepEstimator_h
#define po_SweepEstimator_h

#include "OcclusionEstimator.h"
#include "SphereSweep.h"

#include <functional>

namespace po
{
/// How much work a sweep does.
struct SweepOptions
{
  int directions = 0;       ///< 0: as many as the settings' samplesPerTexel stand for
  double targetError = 0;   ///< above 0: RMS error to reach, with as many directions as that takes
  bool refineByRays = true; ///< with a target, where that is cheaper; off for measurements
  /// What is seen is kept in a temporary file (see LoggedVisibility). Textures have the same bits.
  /// With a target error it is read again for each look at the errors.
  bool outOfCore = false;
  SweepSkips skips = {};
  bool smooth = true; ///< textures, see TextureSmoothing; off for measurements
  /// Called, if any, when all that is seen is known and textures are to be made of it: the estimate
  /// does not need the scene any more.
  std::function<void()> afterSweep = {};
};

/// What a sweep did to reach its result.
struct SweepReport
{
  int directions = 0;        ///< swept, without those that the background makes black
  double estimatedError = 0; ///< RMS error of linear visibility, from subsets of the directions,
                             ///< with a target over all particles
  bool reached = false;      ///< the target error, if there was one
  std::size_t refined = 0;   ///< particles that were left to rays
};

/// Finds the visibility of all spheres at once along directions that all share, by going through
/// the scene from the light downward: no rays, no epsilon.
///
/// For each direction the spheres are projected, sorted into tiles and by depth; a sphere starts
/// with the texels that face the light and loses those behind the spheres in front of it. Each
/// direction looks at another point of every texel. Points inside other spheres have no weight.
///
/// The cost does not depend on how many particles are listed: for a few, rays are better. So a
/// target error is reached by more directions for all, or, once that is cheaper, by rays
/// (EmbreeEstimator) for those particles alone that are still above it.
class SweepEstimator : public OcclusionEstimator
{
public:
  static constexpr int MaximumDirections = 1 << 20;

  SweepEstimator() = default;

  explicit SweepEstimator(SweepOptions options)
    : options_(options)
  {
  }

  void estimate(const BakeScene& scene, const std::vector<unsigned>& particles,
    const BakeSettings& settings, Progress& progress, const Sink& sink,
    BakeCounters& counters) const override;

  /// Of particles that twenty others overlap; those that nothing overlaps need 5 (see
  /// VisibilityRecords). The error bars of all particles take 16. Out of core what overlaps
  /// particles that are looked at takes below 1, and with a target textures that rays have found 8.
  [[nodiscard]] double bytesPerTexel() const override
  {
    if (options_.outOfCore)
    {
      return options_.targetError > 0 ? 9 : 1;
    }
    return options_.targetError > 0 ? 26 : 10;
  }

  [[nodiscard]] bool isOutOfCore() const override { return options_.outOfCore; }

  [[nodiscard]] double estimatedError() const override { return report_.estimatedError; }

  /// Of the last estimate.
  [[nodiscard]] const SweepReport& report() const { return report_; }

private:
  void sweepOnce(const BakeScene& scene, const std::vector<unsigned>& particles,
    const BakeSettings& settings, Progress& progress, const Sink& sink,
    BakeCounters& counters) const;

  SweepOptions options_;
  mutable SweepReport report_;
};

/// The directions whose error is that of so many jittered rays a texel.
[[nodiscard]] int sweepDirectionsForSamples(int samplesPerTexel);
}

#endif
