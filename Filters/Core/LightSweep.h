// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_LightSweep_h
#define po_LightSweep_h

#include "Background.h"
#include "OcclusionEstimator.h"
#include "SweepScene.h"
#include "SweepTexels.h"
#include "VisibilityRecords.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace po
{
/// What particles see of a distant light: a sweep of all spheres along its one direction, once for
/// each point of the texels. It sees no triangles.
class LightSweep
{
public:
  /// Upper bound of its memory, of all particles; out of core that is of what overlaps them.
  [[nodiscard]] static constexpr double bytesPerTexel(bool outOfCore) { return outOfCore ? 1 : 10; }

  /// Sweeps. Returns early when `progress` says so; sums() is incomplete then.
  /// @param particles whose sums are wanted, by their number in the scene
  /// @param texels with the points of TexelPatterns(texels, seed, 0). All must outlive this.
  /// @param direction unit vector towards the light
  /// @param distance spheres within it block light: local, infinite when unbounded
  /// @param outOfCore what is seen is kept in a temporary file (see LoggedVisibility)
  LightSweep(const BakeScene& scene, const std::vector<unsigned>& particles,
    const SweepTexels& texels, std::uint64_t seed, Vec3d direction, float distance, bool outOfCore,
    Progress& progress);

  /// Makes the sums of a place of the list known, in place of those of others.
  /// @return of how many places from there on they are; may be more than there are
  [[nodiscard]] std::size_t loadFor(std::size_t place);

  /// [slots] max(0, n.l), summed over those points of a texel that are outside all spheres and that
  /// the light reaches; null for a particle that it does not reach. It must be known, see above.
  [[nodiscard]] const float* sums(unsigned particle) const;

private:
  SweepScene order_;
  Background white_;
  std::vector<std::uint8_t> alone_;          ///< none
  std::optional<VisibilityRecords> records_; ///< in memory
  std::unique_ptr<LoggedVisibility> log_;    ///< out of core
};
}

#endif
