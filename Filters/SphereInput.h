// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereInput_h
#define po_SphereInput_h

// From a VTK data set and the user's choice of radii to the spheres of the core. The filter and the
// mapper share these functions, so that both see the same particles.

#include "ParticleOcclusionFiltersModule.h"
#include "ProcessGroup.h"
#include "SphereCloud.h"

#include <optional>
#include <string>

class vtkPointData;
class vtkPointSet;

namespace po
{
/// Where the radii of the particles come from.
struct RadiusSettings
{
  /// Value of `array` that asks for no array: all radii are `constant`.
  static constexpr const char* NoArray = "(none)";

  /// Value of `array` that asks for defaultRadiusArray, like an empty one.
  static constexpr const char* Automatic = "(automatic)";

  /// Point array of one component; empty: the choice of defaultRadiusArray. Of an array named
  /// "diameter" (in any case) half the value is the radius.
  std::string array;

  /// Every radius is multiplied by this, whatever it comes from; positive and finite.
  double scale = 1;

  /// Radius of all particles where no array is used, in world units; 0: estimateRadius.
  double constant = 0;
};

/// What the settings come to for all points of the group: the name of an array that every process
/// with points has, or NoArray and a constant radius. Automatic is the first of the arrays radius,
/// Radius, rad, r, diameter that all have. A constant of 0 is replaced by estimateRadius of all
/// points, and stays 0 where that finds none.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT RadiusSettings resolveRadii(
  vtkPointSet& points, const RadiusSettings& settings, const ProcessGroup& group);

/// The usable particles of `points` as spheres; sourceIds are point ids, ghosts the duplicate
/// points of vtkGhostType.
///
/// Nothing is returned, and `error` says which array or parameter is wrong and what to do, if there
/// are no points, the array is missing, not numeric, of the wrong length or number of components, a
/// parameter is out of range, no radius can be estimated, or no particle at all is usable: both of
/// all processes together. Particles that are left out are counted in SphereCloud::rejected.
/// @param frame the spheres are put into the local coordinates of that cloud, or, if null, into
/// those of all particles of the group
/// @param group the processes whose particles make up one set; all must call
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::optional<SphereCloud> readSphereCloud(
  vtkPointSet& points, const RadiusSettings& settings, std::string& error,
  const SphereCloud* frame = nullptr, const ProcessGroup& group = ProcessGroup::alone());

/// One sentence on the particles that were left out and why; empty if there are none.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::string describe(
  const RejectedParticles& rejected);
}

#endif
