// SPDX-License-Identifier: BSD-3-Clause
#include "SweepScene.h"

#include "MortonCurve.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace po
{
namespace
{
/// Place of a sphere in the order; the source makes it unique.
struct Place
{
  int band;
  std::uint64_t morton;
  unsigned source;

  bool operator<(const Place& other) const
  {
    if (band != other.band)
    {
      return band < other.band;
    }
    return morton != other.morton ? morton < other.morton : source < other.source;
  }
};

/// Through the bounding box of the spheres.
MortonCurve curveThrough(const std::vector<Sphere>& spheres)
{
  Vec3f low = spheres.front().center();
  Vec3f high = low;
  for (const Sphere& s : spheres)
  {
    low = { std::min(low.x, s.x), std::min(low.y, s.y), std::min(low.z, s.z) };
    high = { std::max(high.x, s.x), std::max(high.y, s.y), std::max(high.z, s.z) };
  }
  return { low, std::max({ high.x - low.x, high.y - low.y, high.z - low.z }) };
}

/// The octave of a radius, counted down from the largest: equal radii must never fall on both sides
/// of an edge.
std::size_t octaveOf(float radius, float largest)
{
  return static_cast<std::size_t>(std::min(255.0f, std::floor(std::log2(largest / radius))));
}

/// The band of each octave. A band spans a factor of four, or more where the smaller spheres are
/// few: they use larger cells than they need, but no passes of their own.
std::array<int, 256> bandsOfOctaves(const std::array<std::size_t, 256>& counts)
{
  constexpr std::size_t span = 2;     // octaves
  constexpr std::size_t widest = 6;   // octaves
  constexpr std::size_t fewTimes = 4; // so many times more spheres are in the larger octaves
  std::array<int, 256> bands{};
  std::size_t first = 0;
  std::size_t count = 0;
  for (std::size_t octave = 0; octave < counts.size(); ++octave)
  {
    const std::size_t width = octave + 1 - first;
    const bool joins = width <= span || (width <= widest && fewTimes * counts[octave] <= count);
    first = joins ? first : octave;
    count = joins ? count + counts[octave] : counts[octave];
    bands[octave] = -static_cast<int>(first);
  }
  return bands;
}

std::vector<Place> sortedPlaces(const std::vector<Sphere>& spheres)
{
  float largest = 0;
  for (const Sphere& s : spheres)
  {
    largest = std::max(largest, s.radius);
  }
  std::array<std::size_t, 256> counts{};
  for (const Sphere& s : spheres)
  {
    ++counts[octaveOf(s.radius, largest)];
  }
  const std::array<int, 256> bands = bandsOfOctaves(counts);
  const MortonCurve morton = curveThrough(spheres);
  std::vector<Place> places(spheres.size());
  for (unsigned i = 0; i < places.size(); ++i)
  {
    places[i] = { bands[octaveOf(spheres[i].radius, largest)], morton(spheres[i].center()), i };
  }
  tbb::parallel_sort(places.begin(), places.end());
  return places;
}
}

SweepScene::SweepScene(const std::vector<Sphere>& spheres)
  : indexOf_(spheres.size())
{
  if (spheres.empty())
  {
    return;
  }
  const std::vector<Place> places = sortedPlaces(spheres);
  spheres_.reserve(places.size());
  source_.reserve(places.size());
  for (unsigned i = 0; i < places.size(); ++i)
  {
    const Sphere& s = spheres[places[i].source];
    spheres_.push_back(s);
    source_.push_back(places[i].source);
    indexOf_[places[i].source] = i;
    if (i == 0 || places[i].band != places[i - 1].band)
    {
      bands_.push_back({ i, i, s.radius, s.radius });
    }
    Band& band = bands_.back();
    band.last = i + 1;
    band.smallestRadius = std::min(band.smallestRadius, s.radius);
    band.largestRadius = std::max(band.largestRadius, s.radius);
  }
}
}
