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

/// Where particles are and how large they may be. Kept by process, then joined.
struct Extent
{
  Vec3d low{ +HUGE_VAL, +HUGE_VAL, +HUGE_VAL };
  Vec3d high{ -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  double largestRadius = 0;
  double smallestRadius = HUGE_VAL;

  void include(Vec3d p, double radius)
  {
    low = { std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z) };
    high = { std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z) };
    largestRadius = std::max(largestRadius, radius);
    smallestRadius = std::min(smallestRadius, radius);
  }

  void join(const ProcessGroup& group)
  {
    for (double* number : { &high.x, &high.y, &high.z, &largestRadius })
    {
      *number = group.largest(*number);
    }
    for (double* number : { &low.x, &low.y, &low.z, &smallestRadius })
    {
      *number = -group.largest(-*number);
    }
  }

  /// Halves before adding, so that the sum of two huge coordinates stays finite.
  [[nodiscard]] Vec3d middle() const { return 0.5 * low + 0.5 * high; }

  [[nodiscard]] double halfWidth() const
  {
    const Vec3d half = 0.5 * high - 0.5 * low;
    return std::max({ half.x, half.y, half.z });
  }
};

/// The mean of radii, summed as integers: exact to 2^-62 of the largest, so that neither the order
/// nor the processes they are on matter, and without overflow.
class MeanRadius
{
public:
  explicit MeanRadius(double largest)
    : exponent_(std::ilogb(largest) + 1)
  {
  }

  void include(double radius)
  {
    const auto fraction = static_cast<std::uint64_t>(std::scalbn(radius, Bits - exponent_));
    upper_ += fraction >> HalfBits;
    lower_ += fraction & ((std::uint64_t(1) << HalfBits) - 1);
    ++count_;
  }

  /// Of all processes.
  [[nodiscard]] double get(const ProcessGroup& group) const
  {
    const auto upper = static_cast<double>(group.sum(upper_));
    const auto lower = static_cast<double>(group.sum(lower_));
    const auto count = static_cast<double>(group.sum(count_));
    return std::scalbn((std::scalbn(upper, HalfBits) + lower) / count, exponent_ - Bits);
  }

private:
  static constexpr int Bits = 62;
  static constexpr int HalfBits = 31;

  int exponent_; ///< of a power of two above all radii
  std::uint64_t upper_ = 0;
  std::uint64_t lower_ = 0;
  std::uint64_t count_ = 0;
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

/// Visits usable particles that are no ghosts.
template <typename Visit>
void forEachOwned(const ParticleSource& source, const Visit& visit)
{
  RejectedParticles ignored;
  for (std::size_t i = 0; i < source.count; ++i)
  {
    const Vec3d position = source.positionAt(i);
    const double radius = source.radiusAt(i);
    if (accept(position, radius, ignored) && !(source.isGhost && source.isGhost(i)))
    {
      visit(position, radius);
    }
  }
}

double medianOf(std::vector<double>& values)
{
  if (values.empty())
  {
    return -HUGE_VAL;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Does all that was included fit floats relative to the frame of a cloud?
bool fitsFrame(const SphereCloud& cloud, const Extent& extent)
{
  const double margin = extent.largestRadius / cloud.scale;
  return fitsFloat(cloud.toLocal(extent.low), margin) &&
    fitsFloat(cloud.toLocal(extent.high), margin) &&
    extent.smallestRadius / cloud.scale > SmallestLocalRadius;
}

/// A frame that a few absurd particles cannot spoil for the others: the medians, of several
/// processes the largest ones.
void useMedians(SphereCloud& cloud, const ParticleSource& source, const ProcessGroup& group)
{
  std::vector<double> x, y, z, radii;
  forEachOwned(source,
    [&](Vec3d position, double radius)
    {
      x.push_back(position.x);
      y.push_back(position.y);
      z.push_back(position.z);
      radii.push_back(radius);
    });
  cloud.origin = { group.largest(medianOf(x)), group.largest(medianOf(y)),
    group.largest(medianOf(z)) };
  cloud.scale = group.largest(medianOf(radii));
}

/// Rounds the frame to powers of two. The one of the origin is at least as large as the cloud, so
/// that a local coordinate grows to twice what it was at most.
void roundFrame(SphereCloud& cloud, const Extent& extent)
{
  cloud.scale = std::exp2(std::round(std::log2(cloud.scale)));
  const double step = std::exp2(std::ceil(std::log2(std::max(extent.halfWidth(), cloud.scale))));
  const auto rounded = [step](double x)
  { return step * std::round(x / step) + 0.0; }; // one zero, not two
  cloud.origin = { rounded(cloud.origin.x), rounded(cloud.origin.y), rounded(cloud.origin.z) };
}

/// Chooses the middle and the mean radius, or, where some particles would not fit, the medians; no
/// sphere is made.
SphereCloud emptyCloudAround(const ParticleSource& source, const ProcessGroup& group, FrameFit fit)
{
  SphereCloud cloud;
  Extent extent;
  forEachOwned(source, [&](Vec3d position, double radius) { extent.include(position, radius); });
  extent.join(group);
  if (extent.largestRadius > 0)
  {
    MeanRadius mean(extent.largestRadius);
    forEachOwned(source, [&](Vec3d, double radius) { mean.include(radius); });
    cloud.origin = extent.middle();
    cloud.scale = mean.get(group);
    if (fit == FrameFit::Steady)
    {
      roundFrame(cloud, extent);
    }
    if (!fitsFrame(cloud, extent))
    {
      useMedians(cloud, source, group);
    }
  }
  return cloud;
}
}

RejectedParticles RejectedParticles::summed(const ProcessGroup& group) const
{
  RejectedParticles all = *this;
  for (std::size_t* number :
    { &all.nonFinitePosition, &all.nonFiniteRadius, &all.nonPositiveRadius, &all.outOfRange })
  {
    *number = group.sum(std::uint64_t(*number));
  }
  return all;
}

float SphereCloud::toLocalReach(double maximumDistance) const
{
  return maximumDistance > 0 ? static_cast<float>(maximumDistance / scale)
                             : std::numeric_limits<float>::infinity();
}

bool SphereCloud::inRange(Vec3d local)
{
  return isFinite(local) && isWithin(local, 0);
}

SphereCloud makeSphereCloud(const ParticleSource& source, const ProcessGroup& group, FrameFit fit)
{
  return makeSphereCloudLike(emptyCloudAround(source, group, fit), source);
}

SphereCloud makeSphereCloud(std::size_t count, const std::function<Vec3d(std::size_t)>& positionAt,
  const std::function<double(std::size_t)>& radiusAt)
{
  return makeSphereCloud(ParticleSource{ count, positionAt, radiusAt, {} });
}

SphereCloud makeSphereCloudLike(const SphereCloud& other, const ParticleSource& source)
{
  SphereCloud cloud;
  RejectedParticles ignored; // ghosts count where they are at home
  cloud.origin = other.origin;
  cloud.scale = other.scale;
  cloud.spheres.reserve(source.count);
  cloud.sourceIds.reserve(source.count);
  for (std::size_t i = 0; i < source.count; ++i)
  {
    const Vec3d position = source.positionAt(i);
    const double radius = source.radiusAt(i);
    const bool ghost = source.isGhost && source.isGhost(i);
    RejectedParticles& rejected = ghost ? ignored : cloud.rejected;
    if (!accept(position, radius, rejected))
    {
      continue;
    }
    const Vec3d local = cloud.toLocal(position);
    const double localRadius = radius / cloud.scale;
    if (!fitsFloat(local, localRadius))
    {
      ++rejected.outOfRange;
      continue;
    }
    const Vec3f center = local.as<float>();
    cloud.spheres.push_back({ center.x, center.y, center.z, static_cast<float>(localRadius) });
    cloud.sourceIds.push_back(static_cast<std::int64_t>(i));
    if (source.isGhost)
    {
      cloud.ghosts.push_back(ghost ? 1 : 0);
    }
  }
  if (isWide(cloud.spheres))
  {
    addCenters(cloud, source.positionAt);
  }
  return cloud;
}
}
