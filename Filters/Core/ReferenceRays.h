// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ReferenceRays_h
#define po_ReferenceRays_h

#include "BakeSettings.h"
#include "OcclusionEstimator.h"
#include "OverlapFinder.h"
#include "Random.h"
#include "Sampling.h"
#include "SurfaceRay.h"

#include <cstdint>
#include <vector>

namespace po
{
class TexelPatch;

/// Makes the rays of the Reference estimator: stratified jittered points of a texel, each paired
/// with a stratified jittered direction, cosine-weighted about the normal (Bigler 2004, chapter 3).
///
/// Points inside another particle are found exactly and get no ray. Rays depend on the seed, the
/// particle's id and the texel alone. All functions are safe to call from several threads, each
/// with a workspace of its own.
class ReferenceRays
{
public:
  /// Memory that a thread uses again and again.
  struct Workspace
  {
    Overlaps overlaps;                  ///< of the particle at hand
    std::vector<BuriedCap> cuttingCaps; ///< caps whose rim crosses the texel at hand
    std::vector<std::uint32_t> pairing; ///< stratum of the direction for each of the texel
  };

  /// Both arguments must outlive this.
  ReferenceRays(const BakeScene& scene, const BakeSettings& settings);

  /// Finds what covers the particle; false if all of it is inside another one.
  [[nodiscard]] bool beginParticle(unsigned id, Workspace& work) const;

  /// Adds the rays of a texel of the particle that was begun.
  /// @return the number of sample points, those inside other particles included; 0 if the texel
  /// lies inside one other particle with all of its area
  [[nodiscard]] int makeRays(
    unsigned id, int row, int column, Workspace& work, std::vector<SurfaceRay>& rays) const;

private:
  /// What all texels of a row have in common.
  struct TexelRow
  {
    double angularRadius; ///< of a texel, radians
    int sharedColumns;    ///< so many neighbouring texels use the same random numbers
  };

  [[nodiscard]] bool isCovered(int row, int column, Workspace& work) const;
  void addSet(unsigned id, const TexelPatch& patch, Random& random, Workspace& work,
    std::vector<SurfaceRay>& rays) const;

  const BakeScene& scene_;
  const BakeSettings& settings_;
  StratifiedSquare strata_;
  std::vector<TexelRow> rows_;
};
}

#endif
