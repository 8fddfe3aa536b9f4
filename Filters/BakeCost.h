// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakeCost_h
#define po_BakeCost_h

// What a bake will take, said before it begins.

#include "BakeSettings.h"
#include "ParticleOcclusionFiltersModule.h"

#include <cstddef>
#include <string>

namespace po
{
/// What the cost depends on and is known beforehand.
struct BakeWork
{
  std::size_t particles = 0;
  int method = 0; ///< vtkSphereAmbientOcclusion::MethodType; Automatic counts as Sweep,
                  ///< or as Embree where textures are kept
  BakeSettings settings;
  double targetError = 0;
  bool outOfCore = false;
  bool reuseUnchanged = false; ///< textures are kept for the next execution, if they may be
};

struct BakeCost
{
  double coreSeconds = 0;      ///< 0: not known beforehand, as with a target error
  double bytes = 0;            ///< upper bound of the memory while it bakes
  double textureBytes = 0;     ///< upper bound of the textures that stay
  bool texturesPacked = false; ///< whether they mostly take far less
};

/// Seconds of one core and memory of a bake.
///
/// The time is a constant a particle and direction (Sweep, Embree) or a ray (Reference), the middle
/// of what Testing/Benchmarks/README.md has for its sets on a server processor of 2023 with
/// AVX-512; the sets themselves lie within a factor of 3 of it, since what is buried or dark is
/// spared. Up to 16 x 16 texels a sweep takes the same time, beyond it grows with the 1.6th power
/// of the resolution; the other methods go by the number of texels. Distances, occluders and the
/// spread of radii (8 times the time at 1:10,000) are not looked at.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT BakeCost estimateCost(const BakeWork& work);

/// The estimate in words, for a machine with that many cores and so much free memory in bytes: in
/// lines of at most 24 characters, since ParaView's panel is narrow. Empty where there are no
/// particles.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT std::string describe(
  const BakeCost& cost, std::size_t particles, int cores, double freeBytes);
}

#endif
