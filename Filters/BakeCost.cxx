// SPDX-License-Identifier: BSD-3-Clause
#include "BakeCost.h"

#include "EmbreeEstimator.h"
#include "OcclusionBaker.h"
#include "ReferenceEstimator.h"
#include "SweepEstimator.h"
#include "vtkSphereAmbientOcclusion.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace po
{
namespace
{
// Seconds of one core, measured.
constexpr double SweepVisit = 2.2e-7; ///< a particle in a direction
constexpr double EmbreeTexel = 6e-9;  ///< a texel in a direction
constexpr double ReferenceRay = 2.5e-7;
constexpr double LightTexel = 5.6e-7; ///< of a baked light: 1.3e-7 (packings) to 2.3e-6 (gases)

/// Of sets that are mostly buried to open ones, either way.
constexpr double Spread = 3;

/// Of a sweep, against 16 x 16 texels.
double resolutionFactor(int resolution)
{
  return std::pow(std::max(1.0, resolution / 16.0), 1.6);
}

double lightSeconds(const BakeWork& work, double texels)
{
  return work.settings.light ? static_cast<double>(work.particles) * texels * LightTexel : 0;
}

double occlusionSeconds(const BakeWork& work, double texels)
{
  const double samples = work.settings.samplesPerTexel;
  const double directions = sweepDirectionsForSamples(work.settings.samplesPerTexel);
  const auto particles = static_cast<double>(work.particles);
  switch (work.method)
  {
    case vtkSphereAmbientOcclusion::Embree:
      return particles * texels * directions * EmbreeTexel;
    case vtkSphereAmbientOcclusion::Reference:
      return particles * texels * samples * ReferenceRay;
    default:
      return particles * directions * SweepVisit *
        resolutionFactor(work.settings.textureResolution);
  }
}

double memoryOf(const BakeWork& work)
{
  switch (work.method)
  {
    case vtkSphereAmbientOcclusion::Embree:
      return bakeMemory(work.particles, work.settings, EmbreeEstimator());
    case vtkSphereAmbientOcclusion::Reference:
      return bakeMemory(work.particles, work.settings, ReferenceEstimator());
    default:
    {
      SweepOptions options;
      options.targetError = work.targetError;
      return bakeMemory(work.particles, work.settings, SweepEstimator(options));
    }
  }
}

std::string format(const char* pattern, double value)
{
  char text[64];
  std::snprintf(text, sizeof(text), pattern, value);
  return text;
}

std::string duration(double seconds)
{
  if (seconds < 1)
  {
    return "1 s";
  }
  if (seconds < 90)
  {
    return format("%.0f s", seconds);
  }
  return seconds < 5400 ? format("%.0f min", seconds / 60) : format("%.0f h", seconds / 3600);
}

std::string amount(double bytes)
{
  return bytes < 1e9 ? format("%.0f MB", std::max(1.0, bytes / 1e6))
                     : format("%.1f GB", bytes / 1e9);
}

std::string time(double seconds)
{
  if (seconds * Spread < 1.5)
  {
    return "About a second";
  }
  return "About " + duration(seconds) + " (" + duration(seconds / Spread) + " to " +
    duration(seconds * Spread) + ")";
}
}

BakeCost estimateCost(const BakeWork& work)
{
  const double side = work.settings.textureResolution;
  const double texels = side * side;
  const double seconds = occlusionSeconds(work, texels) + lightSeconds(work, texels);
  return { work.targetError > 0 ? 0 : seconds, memoryOf(work) };
}

std::string describe(const BakeCost& cost, std::size_t particles, int cores, double freeBytes)
{
  if (particles == 0)
  {
    return {};
  }
  const std::string on = " on " + std::to_string(cores) + (cores == 1 ? " core" : " cores") +
    " for " + std::to_string(particles) + " particles; ";
  const std::string memory = "at most " + amount(cost.bytes) + " of memory, " + amount(freeBytes) +
    (cost.bytes > freeBytes ? " are free: too little" : " are free");
  return (cost.coreSeconds > 0 ? time(cost.coreSeconds / cores)
                               : "As long as the target error takes") +
    on + memory;
}
}
