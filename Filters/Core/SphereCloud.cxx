// SPDX-License-Identifier: BSD-3-Clause
#include "SphereCloud.h"

#include "SphereSet.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace po
{
namespace
{
/// Embree leaves out primitives beyond 1.844e18 (FLT_LARGE); stay well inside, so that squares of
/// distances stay finite floats too.
constexpr double LargestLocalLength = 1e18;

/// Radii below this square to zero in single precision.
constexpr double SmallestLocalRadius = 1e-18;

struct Extent
{
  Vec3d low{ +HUGE_VAL, +HUGE_VAL, +HUGE_VAL };
  Vec3d high{ -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  double meanRadius = 0;

  void include(Vec3d p)
  {
    low = { std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z) };
    high = { std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z) };
  }

  /// Halves before adding, so that the sum of two huge coordinates stays finite.
  [[nodiscard]] Vec3d middle() const { return 0.5 * low + 0.5 * high; }
};

/// Counts the particle under the first reason that makes it unusable; true if there is none.
bool accept(Vec3d position, double radius, RejectedParticles& rejected)
{
  if (!isFinite(position))
  {
    ++rejected.nonFinitePosition;
    return false;
  }
  if (!std::isfinite(radius))
  {
    ++rejected.nonFiniteRadius;
    return false;
  }
  if (!(radius > 0))
  {
    ++rejected.nonPositiveRadius;
    return false;
  }
  return true;
}

bool isWithin(Vec3d local, double margin)
{
  const double reach =
    std::max({ std::abs(local.x), std::abs(local.y), std::abs(local.z) }) + margin;
  return reach < LargestLocalLength;
}

bool fitsFloat(Vec3d local, double radius)
{
  return isWithin(local, radius) && radius > SmallestLocalRadius;
}

/// Is one frame of floats too coarse?
bool isWide(const std::vector<Sphere>& spheres)
{
  return std::any_of(spheres.begin(), spheres.end(),
    [](const Sphere& s)
    {
      const double reach = std::max({ std::abs(s.x), std::abs(s.y), std::abs(s.z) });
      return reach > SphereSet::LargestBrick;
    });
}

void addCenters(SphereCloud& cloud, const std::function<Vec3d(std::size_t)>& positionAt)
{
  cloud.centers.reserve(cloud.sourceIds.size());
  for (const std::int64_t id : cloud.sourceIds)
  {
    cloud.centers.push_back(cloud.toLocal(positionAt(static_cast<std::size_t>(id))));
  }
}

/// Chooses the middle and the mean radius of the usable particles; no sphere is made.
SphereCloud emptyCloudAround(std::size_t count, const std::function<Vec3d(std::size_t)>& positionAt,
  const std::function<double(std::size_t)>& radiusAt)
{
  SphereCloud cloud;
  Extent extent;
  RejectedParticles ignored;
  std::size_t accepted = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vec3d position = positionAt(i);
    const double radius = radiusAt(i);
    if (accept(position, radius, ignored))
    {
      extent.include(position);
      // A running mean, since a sum of radii could overflow.
      extent.meanRadius += (radius - extent.meanRadius) / static_cast<double>(++accepted);
    }
  }
  if (accepted > 0)
  {
    cloud.origin = extent.middle();
    cloud.scale = extent.meanRadius;
  }
  return cloud;
}
}

bool SphereCloud::inRange(Vec3d local)
{
  return isFinite(local) && isWithin(local, 0);
}

SphereCloud makeSphereCloud(std::size_t count, const std::function<Vec3d(std::size_t)>& positionAt,
  const std::function<double(std::size_t)>& radiusAt)
{
  return makeSphereCloudLike(
    emptyCloudAround(count, positionAt, radiusAt), count, positionAt, radiusAt);
}

SphereCloud makeSphereCloudLike(const SphereCloud& other, std::size_t count,
  const std::function<Vec3d(std::size_t)>& positionAt,
  const std::function<double(std::size_t)>& radiusAt)
{
  SphereCloud cloud;
  cloud.origin = other.origin;
  cloud.scale = other.scale;
  cloud.spheres.reserve(count);
  cloud.sourceIds.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vec3d position = positionAt(i);
    const double radius = radiusAt(i);
    if (!accept(position, radius, cloud.rejected))
    {
      continue;
    }
    const Vec3d local = cloud.toLocal(position);
    const double localRadius = radius / cloud.scale;
    if (!fitsFloat(local, localRadius))
    {
      ++cloud.rejected.outOfRange;
      continue;
    }
    const Vec3f center = local.as<float>();
    cloud.spheres.push_back({ center.x, center.y, center.z, static_cast<float>(localRadius) });
    cloud.sourceIds.push_back(static_cast<std::int64_t>(i));
  }
  if (isWide(cloud.spheres))
  {
    addCenters(cloud, positionAt);
  }
  return cloud;
}
}
