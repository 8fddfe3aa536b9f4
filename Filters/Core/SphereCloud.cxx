// SPDX-License-Identifier: BSD-3-Clause
#include "SphereCloud.h"

#include "SphereSet.h"

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
/// Embree leaves out primitives beyond 1.844e18 (FLT_LARGE); stay well inside, so that squares of
/// distances stay finite floats too.
constexpr double LargestLocalLength = 1e18;

/// Radii below this square to zero in single precision.
constexpr double SmallestLocalRadius = 1e-18;

/// What the usable particles span.
struct Extent
{
  Vec3d low{ +HUGE_VAL, +HUGE_VAL, +HUGE_VAL };
  Vec3d high{ -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  double smallest = HUGE_VAL; ///< radius
  double largest = 0;

  void include(Vec3d p, double radius)
  {
    low = { std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z) };
    high = { std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z) };
    smallest = std::min(smallest, radius);
    largest = std::max(largest, radius);
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

/// Calls use(position, radius) for all usable particles.
template <typename Use>
void forEachUsable(std::size_t count, const std::function<Vec3d(std::size_t)>& positionAt,
  const std::function<double(std::size_t)>& radiusAt, const Use& use)
{
  RejectedParticles ignored;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vec3d position = positionAt(i);
    const double radius = radiusAt(i);
    if (accept(position, radius, ignored))
    {
      use(position, radius);
    }
  }
}

/// The mean of radii, as whole parts of the largest one: such a sum depends on no order, and cannot
/// overflow.
class RadiusMean
{
public:
  explicit RadiusMean(double largest)
    : largest_(largest)
  {
  }
  void add(double radius)
  {
    const auto parts = static_cast<std::uint64_t>(std::llround(radius / largest_ * 0x1p52));
    high_ += parts >> 26;
    low_ += parts & ((1u << 26) - 1);
    ++count_;
  }
  [[nodiscard]] double get() const
  {
    const double sum = static_cast<double>(high_) * 0x1p26 + static_cast<double>(low_);
    return sum * 0x1p-52 / static_cast<double>(count_) * largest_;
  }

private:
  double largest_;
  std::uint64_t high_ = 0, low_ = 0; ///< the sum: 26 bits of each radius, exactly
  std::uint64_t count_ = 0;
};

double medianOf(std::vector<double>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Does all that was included fit floats relative to the frame of a cloud?
bool fitsFrame(const SphereCloud& cloud, const Extent& extent)
{
  const double margin = extent.largest / cloud.scale;
  return fitsFloat(cloud.toLocal(extent.low), margin) &&
    fitsFloat(cloud.toLocal(extent.high), margin) &&
    extent.smallest / cloud.scale > SmallestLocalRadius;
}

/// A frame that a few absurd particles cannot spoil for the others.
void useMedians(SphereCloud& cloud, std::size_t count,
  const std::function<Vec3d(std::size_t)>& positionAt,
  const std::function<double(std::size_t)>& radiusAt)
{
  std::vector<double> x, y, z, radii;
  forEachUsable(count, positionAt, radiusAt,
    [&](Vec3d position, double radius)
    {
      x.push_back(position.x);
      y.push_back(position.y);
      z.push_back(position.z);
      radii.push_back(radius);
    });
  cloud.origin = { medianOf(x), medianOf(y), medianOf(z) };
  cloud.scale = medianOf(radii);
}

/// Chooses the middle and the mean radius of the usable particles, or, where some of them would not
/// fit, the medians; no sphere is made.
SphereCloud emptyCloudAround(std::size_t count, const std::function<Vec3d(std::size_t)>& positionAt,
  const std::function<double(std::size_t)>& radiusAt)
{
  SphereCloud cloud;
  Extent extent;
  forEachUsable(count, positionAt, radiusAt,
    [&](Vec3d position, double radius) { extent.include(position, radius); });
  if (extent.largest > 0)
  {
    RadiusMean mean(extent.largest);
    forEachUsable(count, positionAt, radiusAt, [&](Vec3d, double radius) { mean.add(radius); });
    cloud.origin = extent.middle();
    cloud.scale = mean.get();
    if (!fitsFrame(cloud, extent))
    {
      useMedians(cloud, count, positionAt, radiusAt);
    }
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
