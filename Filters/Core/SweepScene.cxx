// SPDX-License-Identifier: BSD-3-Clause
#include "SweepScene.h"

#include "BrickOrder.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <tuple>

namespace po
{
namespace
{
/// Place of a sphere in the order; equal spheres follow each other, and the source makes it unique.
struct Place
{
  int band;
  std::size_t brick;
  std::uint64_t morton;
  const Sphere* sphere;
  unsigned source;

  bool operator<(const Place& other) const
  {
    if (band != other.band)
    {
      return band < other.band;
    }
    if (brick != other.brick)
    {
      return brick < other.brick;
    }
    if (morton != other.morton)
    {
      return morton < other.morton;
    }
    const auto numbers = [](const Place& p)
    { return std::tuple(p.sphere->x, p.sphere->y, p.sphere->z, p.sphere->radius, p.source); };
    return numbers(*this) < numbers(other);
  }
};

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

std::vector<Place> sortedPlaces(const SphereSet& set)
{
  const std::vector<Sphere>& spheres = set.spheres();
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
  std::vector<MortonCurve> curves;
  std::transform(
    set.bricks().begin(), set.bricks().end(), std::back_inserter(curves), curveThrough);
  std::vector<Place> places(spheres.size());
  for (unsigned i = 0; i < places.size(); ++i)
  {
    const std::size_t brick = set.brickOf(i);
    places[i] = { bands[octaveOf(spheres[i].radius, largest)], brick,
      curves[brick](set.inBrick(i).center()), &spheres[i], i };
  }
  tbb::parallel_sort(places.begin(), places.end());
  return places;
}
}

namespace
{
bool areEqual(const SphereSet& set, unsigned a, unsigned b)
{
  return set.center(a) == set.center(b) && set.spheres()[a].radius == set.spheres()[b].radius;
}
}

SweepScene::SweepScene(const SphereSet& set)
  : set_(set)
  , indexOf_(set.size())
{
  const std::vector<Sphere>& spheres = set.spheres();
  if (spheres.empty())
  {
    return;
  }
  const std::vector<Place> places = sortedPlaces(set);
  spheres_.reserve(places.size());
  source_.reserve(places.size());
  for (unsigned i = 0; i < places.size(); ++i)
  {
    const Sphere& s = spheres[places[i].source];
    if (i > 0 && areEqual(set, places[i - 1].source, places[i].source))
    {
      indexOf_[places[i].source] = indexOf_[places[i - 1].source];
      continue;
    }
    const auto index = static_cast<unsigned>(spheres_.size());
    spheres_.push_back(s);
    source_.push_back(places[i].source);
    indexOf_[places[i].source] = index;
    if (i == 0 || places[i].band != places[i - 1].band || places[i].brick != places[i - 1].brick)
    {
      bands_.push_back({ index, index, s.radius, s.radius, set.bricks()[places[i].brick].origin });
    }
    Band& band = bands_.back();
    band.last = index + 1;
    band.smallestRadius = std::min(band.smallestRadius, s.radius);
    band.largestRadius = std::max(band.largestRadius, s.radius);
  }
  for (unsigned first = 0; first < size(); first += BlockSize)
  {
    addBlock(first, std::min(first + BlockSize, static_cast<unsigned>(size())));
  }
}

void SweepScene::addBlock(unsigned first, unsigned last)
{
  Vec3d low = center(first);
  Vec3d high = low;
  float radius = 0;
  for (unsigned i = first; i < last; ++i)
  {
    const Vec3d c = center(i);
    low = { std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z) };
    high = { std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z) };
    radius = std::max(radius, sphere(i).radius);
  }
  const double distance = 0.5 * length(high - low);
  blocks_.push_back({ 0.5 * (low + high), static_cast<float>(distance * (1 + 1e-6)), radius });
}

std::vector<std::uint8_t> SweepScene::flagsOf(const std::vector<unsigned>& sources) const
{
  std::vector<std::uint8_t> flags(size(), 0);
  for (const unsigned source : sources)
  {
    flags[indexOf(source)] = 1;
  }
  return flags;
}
}
