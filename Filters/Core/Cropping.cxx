// SPDX-License-Identifier: BSD-3-Clause
#include "Cropping.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace po
{
namespace
{
bool keeps(const Cropping& cropping, Vec3d center, std::int64_t particle)
{
  const auto holds = [&](const HalfSpace& h) { return dot(h.normal, center) + h.offset >= 0; };
  const auto contains = [&](const ValueRange& range)
  {
    const double value = range.valueOf(particle);
    return value >= range.low && value <= range.high;
  };
  return std::all_of(cropping.halfSpaces.begin(), cropping.halfSpaces.end(), holds) &&
    std::all_of(cropping.ranges.begin(), cropping.ranges.end(), contains);
}
}

std::vector<std::uint8_t> hideSpheres(const SphereCloud& cloud, const Cropping& cropping)
{
  std::vector<std::uint8_t> hidden(cropping.empty() ? 0 : cloud.spheres.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, hidden.size(), 4096),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i < range.end(); ++i)
      {
        const Vec3d center = cloud.toWorld(cloud.center(i));
        hidden[i] = keeps(cropping, center, cloud.sourceIds[i]) ? 0 : 1;
      }
    });
  return hidden;
}
}
