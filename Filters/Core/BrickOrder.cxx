// SPDX-License-Identifier: BSD-3-Clause
#include "BrickOrder.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace po
{
MortonCurve curveThrough(const Brick& brick)
{
  Vec3f low = brick.spheres->center();
  Vec3f high = low;
  for (const Sphere* s = brick.spheres; s != brick.spheres + brick.count; ++s)
  {
    low = { std::min(low.x, s->x), std::min(low.y, s->y), std::min(low.z, s->z) };
    high = { std::max(high.x, s->x), std::max(high.y, s->y), std::max(high.z, s->z) };
  }
  return { low, std::max({ high.x - low.x, high.y - low.y, high.z - low.z }) };
}

std::vector<unsigned> orderInSpace(const Brick& brick)
{
  if (brick.count == 0)
  {
    return {};
  }
  const MortonCurve curve = curveThrough(brick);
  const float largest = std::max_element(brick.spheres, brick.spheres + brick.count,
    [](const Sphere& a, const Sphere& b) {
      return a.radius < b.radius;
    })->radius;
  const auto keyOf = [&](const Sphere& s)
  {
    constexpr int positionBits = 60; // of a MortonCurve
    constexpr float mostOctaves = 15;
    const float octave = std::min(mostOctaves, std::floor(std::log2(largest / s.radius)));
    return static_cast<std::uint64_t>(octave) << positionBits | curve(s.center());
  };
  if (std::is_sorted(brick.spheres, brick.spheres + brick.count,
        [&](const Sphere& a, const Sphere& b) { return keyOf(a) < keyOf(b); }))
  {
    return {};
  }
  std::vector<std::pair<std::uint64_t, unsigned>> keys(brick.count);
  tbb::parallel_for(std::size_t(0), keys.size(),
    [&](std::size_t i) {
      keys[i] = { keyOf(brick.spheres[i]), static_cast<unsigned>(i) };
    });
  tbb::parallel_sort(keys.begin(), keys.end());
  std::vector<unsigned> places(keys.size());
  std::transform(
    keys.begin(), keys.end(), places.begin(), [](const auto& key) { return key.second; });
  return places;
}
}
