// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ErrorPilot_h
#define po_ErrorPilot_h

#include "OcclusionEstimator.h"

namespace po
{
/// How many samples a texel reach an error, and the error that was found with them.
struct PilotResult
{
  int samplesPerTexel = 0;
  double estimatedError = 0; ///< RMS error of linear visibility, weighted by visible area
  bool reached = false;      ///< false: not even MaximumSamplesPerTexel would do, or aborted
};

/// Finds the samples per texel at which the RMS error of a set falls below `targetError`.
///
/// 128 of the listed particles, of all processes together, are baked twice with different seeds,
/// with more and more samples. Two independent estimates with error e differ by e sqrt(2) RMS,
/// which needs no other reference. With 128 particles of 16 x 16 texels the error is known to a few
/// percent. The choice depends on the particles alone.
[[nodiscard]] PilotResult samplesForError(const BakeScene& scene,
  const std::vector<unsigned>& particles, const BakeSettings& settings,
  const OcclusionEstimator& estimator, double targetError, Progress& progress);
}

#endif
