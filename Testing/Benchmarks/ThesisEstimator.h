// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ThesisEstimator_h
#define po_ThesisEstimator_h

#include "OcclusionEstimator.h"

namespace po
{
/// The thesis' way to the letter (Bigler 2004, chapter 3), to compare with: `samplesPerTexel`
/// stratified jittered rays from every texel, each of them traced. It knows nothing of surfaces
/// that lie inside other particles, which method Reference leaves out: there it shoots as many rays
/// as anywhere, and texels that are inside in part come out too dark. Shares are all 1.
class ThesisEstimator : public OcclusionEstimator
{
public:
  void estimate(const BakeScene& scene, const std::vector<unsigned>& particles,
    const BakeSettings& settings, Progress& progress, const Sink& sink,
    BakeCounters& counters) const override;

  [[nodiscard]] double bytesPerTexel() const override { return 2 * sizeof(float); }
};
}

#endif
