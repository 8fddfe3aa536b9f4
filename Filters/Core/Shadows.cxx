// SPDX-License-Identifier: BSD-3-Clause
#include "ForEachHit.h"
#include "Shading.h"

namespace po
{
namespace
{
/// Does the light reach the hit? One ray at most; counts what was done.
bool isLit(const SphereScene& scene, const std::uint8_t* hidden, const PrimaryRays& rays,
  const TracedFrame& frame, const Light& light, int x, int y, std::size_t pixel, bool& traced)
{
  const IncidentLight incident =
    illuminate(light, rays.worldPoint(x + frame.sampleX, y + frame.sampleY, frame.t[pixel]));
  const Vec3d normal = frame.normal[pixel].as<double>();
  const Vec3d toLight = transformVector(rays.worldToLocal(), incident.direction);
  // A surface that faces away is dark by itself. The sign is the same in local and world space.
  traced = incident.strength > 0 && dot(normal, toLight) > 0;
  if (!traced)
  {
    return false;
  }
  const Sphere sphere = scene.set().inBrick(frame.sphere[pixel]);
  const Vec3d origin = sphere.center().as<double>() + static_cast<double>(sphere.radius) * normal;
  const double localPerWorld = length(toLight);
  return !scene.occluded(origin.as<float>(), ((1 / localPerWorld) * toLight).as<float>(),
    static_cast<float>(incident.distance * localPerWorld), frame.sphere[pixel], hidden);
}
}

ShadowCounters traceShadows(const SphereScene& scene, const std::uint8_t* hidden,
  const PrimaryRays& rays, const TracedFrame& frame, const Light& light,
  std::vector<std::uint8_t>& lit)
{
  constexpr std::uint8_t Skipped = 2;
  lit.assign(frame.pixels(), 0);
  forEachHit(frame,
    [&](int x, int y, std::size_t pixel)
    {
      bool traced = false;
      const bool reached = isLit(scene, hidden, rays, frame, light, x, y, pixel, traced);
      lit[pixel] = traced ? reached : Skipped;
    });
  ShadowCounters counters;
  for (std::size_t pixel = 0; pixel < lit.size(); ++pixel)
  {
    const bool hit = frame.sphere[pixel] != SphereScene::None;
    const bool skipped = lit[pixel] == Skipped;
    counters.rays += hit && !skipped;
    counters.skipped += skipped;
    lit[pixel] = skipped ? 0 : lit[pixel];
  }
  return counters;
}
}
