// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ReferenceEstimator_h
#define po_ReferenceEstimator_h

#include "OcclusionEstimator.h"

namespace po
{
/// The estimator of Bigler's thesis (2004, chapter 3), kept simple and right: it judges all others.
///
/// A texel is the mean of `samplesPerTexel` rays. Both the starting points (uniform over the
/// texel's area) and the directions (cosine-weighted about the normal) are stratified and jittered;
/// a random permutation pairs the strata. The cosine and the density of the directions cancel, so
/// every ray counts alike: value = mean of V(x, w) L(w).
///
/// Samples whose starting point lies inside another sphere get no ray and no weight. The thesis
/// found such texels by counting back-face hits against a threshold; here the neighbours' caps
/// decide exactly.
class ReferenceEstimator : public OcclusionEstimator
{
public:
  void estimate(const BakeScene& scene, const std::vector<unsigned>& particles,
    const BakeSettings& settings, Progress& progress, const Sink& sink,
    BakeCounters& counters) const override;

  /// Textures are handed over while they are made.
  [[nodiscard]] double bytesPerTexel() const override { return 0; }
};
}

#endif
