// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakeParameters_h
#define po_BakeParameters_h

// From the parameters of the filter to the settings of the core, and to the record of a bake.

#include "BakeCache.h"
#include "BakeMethods.h"
#include "BakeSettings.h"
#include "CropSettings.h"
#include "OcclusionParameters.h"
#include "SphereInput.h"

class vtkSphereAmbientOcclusion;

namespace po
{
/// Throws std::invalid_argument naming the parameter that is out of range, and what
/// readLatLongImage throws.
[[nodiscard]] BakeSettings settingsOf(vtkSphereAmbientOcclusion& filter);

[[nodiscard]] RadiusSettings radiiOf(vtkSphereAmbientOcclusion& filter);

/// Throws std::invalid_argument if the plane has no normal.
[[nodiscard]] CropSettings cropOf(vtkSphereAmbientOcclusion& filter);

[[nodiscard]] std::string idArrayOf(vtkSphereAmbientOcclusion& filter);

/// ReuseUnchanged, where the other parameters let textures be reused.
[[nodiscard]] bool reusesTextures(vtkSphereAmbientOcclusion& filter);

[[nodiscard]] CacheSettings cacheOf(vtkSphereAmbientOcclusion& filter);

[[nodiscard]] const char* nameOfMethod(int method);

/// What the output keeps: all that decodes the table and repeats the bake.
[[nodiscard]] OcclusionParameters describeBake(
  vtkSphereAmbientOcclusion& filter, const BakeSettings& settings, const BakeReport& report);
}

#endif
