// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ParticleRadii_h
#define po_ParticleRadii_h

// The user's choice of where radii come from, and the radii.

#include "ParticleOcclusionFiltersModule.h"
#include "ProcessGroup.h"

#include <cstddef>
#include <functional>
#include <string>

class vtkPointSet;

namespace po
{
/// What the array of RadiusSettings holds. The numbers are those of the property RadiusFrom.
enum class RadiusSource
{
  Array = 0,    ///< radii
  Diameter = 1, ///< diameters
  Element = 2,  ///< chemical elements, as symbols or atomic numbers: see vanDerWaalsRadius
  Mass = 3      ///< masses of spheres whose density is known
};

/// Where the radii of the particles come from.
struct RadiusSettings
{
  /// Value of `array` that asks for no array: all radii are `constant`.
  static constexpr const char* NoArray = "(none)";

  /// Value of `array` that asks for the usual ones, like an empty one: see resolveRadii.
  static constexpr const char* Automatic = "(automatic)";

  /// Point array of one component. Of an array of radii that is named "diameter" (in any case) half
  /// the value is the radius.
  std::string array;

  /// Every radius is multiplied by this, whatever it comes from; positive and finite.
  double scale = 1;

  /// Radius of all particles where no array is used, in world units; 0: an estimate.
  double constant = 0;

  RadiusSource from = RadiusSource::Array;

  /// Of all particles, with masses: mass per volume, in the units of the masses and the points.
  double density = 1;

  bool operator==(const RadiusSettings& other) const
  {
    return array == other.array && scale == other.scale && constant == other.constant &&
      from == other.from && density == other.density;
  }
};

/// What the settings come to for all points of the group: the name of an array that every process
/// with points has, or NoArray and a constant radius.
///
/// Automatic is the first array of one component that all have, of
/// - radii: radius, Radius, rad, r, diameter; where none is and `constant` is 0, an array of
///   elements, if there is one;
/// - diameters: diameter, Diameter, d;
/// - elements: element, atom_type (of ParaView's PDB reader), Atomic Numbers (of its molecules),
///   atomic_number;
/// - masses: mass, Mass, m.
/// The names of the last three are kept as they are, for an error, where there is none. A constant
/// of 0 is replaced by estimateRadius of all points, and stays 0 where that finds none.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT RadiusSettings resolveRadii(
  vtkPointSet& points, const RadiusSettings& settings, const ProcessGroup& group);

/// Radius of a particle in world units, by point id; before `scale`.
using RadiusFunction = std::function<double(std::size_t)>;

/// The radii of the points, which must have some; empty, with a message in `error` that names the
/// array or parameter and what to do, under the conditions of readSphereCloud.
/// @param resolved as resolveRadii gives them
[[nodiscard]] RadiusFunction radiusFunction(
  vtkPointSet& points, const RadiusSettings& resolved, std::string& error);

/// Whether the numbers among the settings are in range; else a message in `error`.
[[nodiscard]] bool checkRange(const RadiusSettings& settings, std::string& error);

/// Says in a few words where radii come from, for the user.
/// @param asked what the user chose
/// @param resolved what resolveRadii made of it
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::string describe(
  const RadiusSettings& asked, const RadiusSettings& resolved);
}

#endif
