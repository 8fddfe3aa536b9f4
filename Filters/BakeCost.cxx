// SPDX-License-Identifier: BSD-3-Clause
#include "BakeCost.h"

#include "BakeMethods.h"
#include "EmbreeEstimator.h"
#include "OcclusionBaker.h"
#include "ReferenceEstimator.h"
#include "SweepEstimator.h"
#include "TextureMemory.h"
#include "vtkSphereAmbientOcclusion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace po
{
namespace
{
// Seconds of one core, measured.
constexpr double SweepVisit = 2.2e-7; ///< a particle in a direction
constexpr double EmbreeTexel = 6e-9;  ///< a texel in a direction
constexpr double ReferenceRay = 2.5e-7;
constexpr double LightParticle = 1.5e-5; ///< of a baked light, at 16 x 16 texels

/// Of sets that are mostly buried to open ones, either way.
constexpr double Spread = 3;

/// Of a sweep, against 16 x 16 texels.
double resolutionFactor(int resolution)
{
  return std::pow(std::max(1.0, resolution / 16.0), 1.6);
}

double lightSeconds(const BakeWork& work)
{
  return work.settings.light ? static_cast<double>(work.particles) * LightParticle *
      resolutionFactor(work.settings.textureResolution)
                             : 0;
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
      options.outOfCore = work.outOfCore;
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

std::string time(double seconds, int cores)
{
  const std::string on = " on " + std::to_string(cores) + (cores == 1 ? " core" : " cores");
  const double elapsed = seconds / cores;
  if (elapsed * Spread < 1.5)
  {
    return "A second" + on;
  }
  return "About " + duration(elapsed) + on + "\n(" + duration(elapsed / Spread) + " to " +
    duration(elapsed * Spread) + ")";
}

/// All texels and the row of a texture; the storages between only ever take less.
double textureMemoryOf(const BakeWork& work)
{
  const double side = work.settings.textureResolution;
  const double texel = work.settings.encoding == Encoding::Float32Linear ? 4 : 1;
  const double texels = work.settings.storage == Storage::OneValue ? 0 : side * side * texel;
  return static_cast<double>(work.particles) * (texels + sizeof(std::int32_t));
}
}

BakeCost estimateCost(const BakeWork& asked)
{
  BakeWork work = asked;
  const bool keeps =
    work.reuseUnchanged && mayReuse(work.method, work.settings.maximumDistance, work.targetError);
  if (keeps && work.method == vtkSphereAmbientOcclusion::Automatic)
  {
    work.method = vtkSphereAmbientOcclusion::Embree;
  }
  const double side = work.settings.textureResolution;
  const double texels = side * side;
  const double seconds = occlusionSeconds(work, texels) + lightSeconds(work);
  const Storage storage = work.settings.storage;
  const double kept = keeps ? TextureMemory::BytesPerTexel * texels * double(work.particles) : 0;
  return { work.targetError > 0 ? 0 : seconds, memoryOf(work) + kept, textureMemoryOf(work),
    storage == Storage::VariableSize || storage == Storage::Compressed };
}

std::string describe(const BakeCost& cost, std::size_t particles, int cores, double freeBytes)
{
  if (particles == 0)
  {
    return {};
  }
  return (cost.coreSeconds > 0 ? time(cost.coreSeconds, cores) : "Time: by Target Error") +
    "\nUses up to " + amount(cost.bytes) + "\n(" + amount(freeBytes) +
    (cost.bytes > freeBytes ? " free: too little)" : " free)") +
    (cost.texturesPacked ? "\nKeeps less than " : "\nKeeps up to ") + amount(cost.textureBytes);
}
}
