// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereInput_h
#define po_SphereInput_h

// From a VTK data set and the user's choice of radii to the spheres of the core. The filter and the
// mapper share these functions, so that both see the same particles.

#include "ParticleOcclusionFiltersModule.h"
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

/// The first of the arrays radius, Radius, rad, r, diameter that exists, or an empty string.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::string defaultRadiusArray(vtkPointData& data);

/// Half the median distance of a particle to its nearest neighbour, taken over a fixed subset: the
/// radius at which most particles of an even packing just touch. 0 where no two distinct finite
/// points exist.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT double estimateRadius(vtkPointSet& points);

/// The usable particles of `points` as spheres; sourceIds are point ids.
///
/// Nothing is returned, and `error` says which array or parameter is wrong and what to do, if there
/// are no points, the array is missing, not numeric, of the wrong length or number of components, a
/// parameter is out of range, no radius can be estimated, or no particle at all is usable.
/// Particles that are left out are counted in SphereCloud::rejected. With `frame` the spheres are
/// put into the local coordinates of that cloud.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::optional<SphereCloud> readSphereCloud(
  vtkPointSet& points, const RadiusSettings& settings, std::string& error,
  const SphereCloud* frame = nullptr);

/// One sentence on the particles that were left out and why; empty if there are none.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::string describe(
  const RejectedParticles& rejected);
}

#endif
