// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereInput_h
#define po_SphereInput_h

// From a VTK data set and the user's choice of radii to the spheres of the core. The filter and the
// mapper share these functions, so that both see the same particles.

#include "ParticleOcclusionFiltersModule.h"
#include "ParticleRadii.h"
#include "ProcessGroup.h"
#include "SphereCloud.h"

#include <optional>
#include <string>

class vtkPointSet;

namespace po
{
/// The particles of a data set, and where their radii came from.
struct ParticleInput
{
  SphereCloud cloud;
  RadiusSettings radii; ///< as resolveRadii gives them
};

/// The local coordinates that particles are put into.
struct FrameChoice
{
  const SphereCloud* like = nullptr; ///< those of this cloud; null: of all particles of the group
  FrameFit fit = FrameFit::Exact;    ///< how these follow from the particles
};

/// The usable particles of `points` as spheres; sourceIds are point ids, ghosts the duplicate
/// points of vtkGhostType.
///
/// Nothing is returned, and `error` says which array or parameter is wrong and what to do, if there
/// are no points, the array is missing, not numeric, of the wrong length or number of components, a
/// parameter is out of range, no radius can be estimated, or no particle at all is usable: both of
/// all processes together. Particles that are left out are counted in SphereCloud::rejected.
/// @param group the processes whose particles make up one set; all must call
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::optional<ParticleInput> readSphereCloud(
  vtkPointSet& points, const RadiusSettings& settings, std::string& error,
  const FrameChoice& frame = {}, const ProcessGroup& group = ProcessGroup::alone());

/// One sentence on the particles that were left out and why; empty if there are none.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::string describe(
  const RejectedParticles& rejected);
}

#endif
