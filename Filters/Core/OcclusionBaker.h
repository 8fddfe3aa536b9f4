// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OcclusionBaker_h
#define po_OcclusionBaker_h

#include "OcclusionEstimator.h"
#include "TextureMemory.h"
#include "TextureTable.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// The textures of particles. Vectors are in the order in which these were listed.
struct BakeResult
{
  EncodedTable table;
  std::vector<std::int32_t> rowOf; ///< row of each particle's texture in the table
  std::vector<float> mean; ///< mean visibility over the area outside other particles, linear
  BakeCounters counters;
  bool aborted = false; ///< the other members are then incomplete
};

/// The share of an estimator's estimatedError() that is surely noise: without a target error,
/// estimates are up to three times too large.
inline constexpr double SureShareOfError = 1.0 / 3;

/// Upper bound of the memory that a bake of `particles` needs at once, in bytes.
///
/// Equal textures are stored once, so that the real need is often much smaller.
[[nodiscard]] double bakeMemory(
  std::size_t particles, const BakeSettings& settings, const OcclusionEstimator& estimator);

/// The same of what only occludes: particles of other processes, and occluders.
[[nodiscard]] double occluderMemory(std::size_t spheres, std::size_t triangles);

/// Bakes the visibility of the background onto the listed particles of a scene, in parallel.
///
/// The same input, settings and seed give the same bits for any number of threads. The counters are
/// those of this process; the table's maximum is that of all processes.
/// Throws std::runtime_error or std::bad_alloc when memory or Embree fails, and WorkStopped.
[[nodiscard]] BakeResult bakeOcclusion(const BakeScene& scene,
  const std::vector<unsigned>& particles, const BakeSettings& settings,
  const OcclusionEstimator& estimator, Progress& progress);

/// The same, with the textures of particles that were baked before.
/// @param kept has begun; takes up what is baked, and holds the textures between which that belongs
[[nodiscard]] BakeResult bakeOcclusion(const BakeScene& scene,
  const std::vector<unsigned>& particles, const BakeSettings& settings,
  const OcclusionEstimator& estimator, Progress& progress, TextureMemory& kept);

/// The same for all particles.
[[nodiscard]] BakeResult bakeOcclusion(const BakeScene& scene, const BakeSettings& settings,
  const OcclusionEstimator& estimator, Progress& progress);
}

#endif
