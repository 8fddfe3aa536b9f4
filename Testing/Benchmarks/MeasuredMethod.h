// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_MeasuredMethod_h
#define po_MeasuredMethod_h

#include "OcclusionEstimator.h"

#include <memory>
#include <string>

namespace po
{
/// An estimator at one level of quality.
struct MeasuredMethod
{
  std::unique_ptr<OcclusionEstimator> estimator;
  int samplesPerTexel;
  bool allAtOnce; ///< the time does not depend on how many particles are asked for
};

/// The one place to add another estimator (and its levels to METHODS in run_error_benchmark.py).
/// @param level samples a texel of Reference and Thesis, directions of the others
/// @param without one of the SweepSkips, which is switched off; none if empty
/// Throws std::runtime_error if there is no such method or skip.
[[nodiscard]] MeasuredMethod makeMethod(
  const std::string& name, int level, const std::string& without);
}

#endif
