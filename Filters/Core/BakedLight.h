// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakedLight_h
#define po_BakedLight_h

#include "LightSweep.h"
#include "OcclusionEstimator.h"
#include "ParticleView.h"
#include "RimFinder.h"
#include "SharedDirections.h"
#include "SweepTexels.h"
#include "TextureFormula.h"

#include <tbb/enumerable_thread_specific.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace po
{
/// Mixes the direct light of a distant light into textures (Bigler 2004, section 3.4: shadows that
/// are baked cost nothing when a picture is made).
///
/// A texel becomes (A + I D) / (1 + I): A is what it was, the light of the background, I the
/// intensity, and D the mean of V max(0, n.l) over the part of its area that is outside all other
/// spheres, with l the direction towards the light and V = 1 where nothing is in the way. A surface
/// that is open and faces the light is thus 1 under the uniform background whatever the intensity;
/// what neither light reaches is exactly 0.
///
/// D is a mean over 32 points of each texel, each tested along the one direction by itself, and
/// exactly: by a sweep along the light or, where there are triangles, which a sweep does not see,
/// against near spheres and by a ray against what is farther. It does not depend on the estimator,
/// and a particle gets the same bits whatever else is baked.
class BakedLight
{
public:
  /// Sweeps, if it can; returns early when `progress` says so.
  /// @param particles whose textures are made, by their number in the scene
  /// @param settings with a light. All must outlive this.
  /// @param outOfCore what the light reaches is kept in a temporary file
  BakedLight(const BakeScene& scene, const std::vector<unsigned>& particles,
    const BakeSettings& settings, bool outOfCore, Progress& progress);

  /// The textures with the light in them, in parallel; good until the next call. Outside shares are
  /// found anew: where an estimator finds no light it need not look for them.
  /// Returns early when `progress` says so: the textures are not complete then.
  [[nodiscard]] RawTextures addTo(const RawTextures& textures, Progress& progress);

  /// Rays traced so far.
  [[nodiscard]] std::uint64_t rays() const;

private:
  /// Memory that a thread uses again and again.
  struct Workspace
  {
    ParticleView view;
    Overlaps overlaps;
    RimFinder rims;
    TexelExposure exposure;
    std::vector<GroupMask> mask;
    std::vector<float> sums, weights; ///< [slots]
    std::vector<float> light, shares; ///< of one texture
  };

  [[nodiscard]] Workspace makeWorkspace() const;
  void addTo(const RawTextures& textures, std::size_t place);
  void look(unsigned id, Workspace& work) const;
  [[nodiscard]] const float* sumsOf(unsigned id, Workspace& work) const;
  void trace(unsigned id, Workspace& work) const;

  const BakeScene& scene_;
  const std::vector<unsigned>& particles_;
  float intensity_;
  float distance_; ///< local, infinite where unbounded
  SweepTexels texels_;
  TexelPatterns patterns_;
  std::vector<SharedDirection> directions_; ///< the one direction, for each point of the texels
  TextureFormula formula_;
  std::optional<LightSweep> sweep_; ///< none where there are triangles
  tbb::enumerable_thread_specific<Workspace> workspaces_;
  std::vector<float> values_, shares_; ///< of the last call
};
}

#endif
