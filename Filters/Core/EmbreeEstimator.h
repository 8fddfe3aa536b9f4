// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_EmbreeEstimator_h
#define po_EmbreeEstimator_h

#include "OcclusionEstimator.h"

namespace po
{
/// How much work the estimator does.
struct EmbreeOptions
{
  int directions = 0;     ///< 0: as many as the settings' samplesPerTexel stand for
  double targetError = 0; ///< above 0: RMS error to reach on every single particle, if possible
  bool smooth = true;     ///< textures, see TextureSmoothing; off for measurements
};

/// What it did to reach its result.
struct EmbreeReport
{
  int directions = 0;        ///< the most that a particle took, without those of a black background
  double estimatedError = 0; ///< RMS error of linear visibility, from subsets of the directions
  bool reached = false;      ///< the target error, if there was one, by the set as a whole
  std::size_t above = 0;     ///< particles whose own error stayed above the target
};

/// Finds the visibility particle by particle along directions that all share: what is near hides
/// texels exactly, what is farther, and all triangles, is met by few rays (see ParticleView).
///
/// Its cost is in proportion to the particles that are listed, so that it suits a part of a set,
/// and meshes. A particle gets the same bits whatever else is listed, for any number of threads.
///
/// With a target error sets of directions are added until the spread of their subsets over the
/// particle at hand says that it is reached: only those that need it go on. One of which hardly
/// anything is outside others may stay above it.
class EmbreeEstimator : public OcclusionEstimator
{
public:
  /// Of a particle, with a target error.
  static constexpr int MaximumDirections = 8192;

  EmbreeEstimator() = default;

  explicit EmbreeEstimator(EmbreeOptions options)
    : options_(options)
  {
  }

  void estimate(const BakeScene& scene, const std::vector<unsigned>& particles,
    const BakeSettings& settings, Progress& progress, const Sink& sink,
    BakeCounters& counters) const override;

  /// Textures are handed over while they are made; what is at work at a time takes below 100 MB,
  /// however many particles there are.
  [[nodiscard]] double bytesPerTexel() const override { return 0; }

  [[nodiscard]] double estimatedError() const override { return report_.estimatedError; }

  /// Of the last estimate.
  [[nodiscard]] const EmbreeReport& report() const { return report_; }

private:
  EmbreeOptions options_;
  mutable EmbreeReport report_;
};

/// The directions whose error is that of so many jittered rays a texel.
[[nodiscard]] int embreeDirectionsForSamples(int samplesPerTexel);
}

#endif
