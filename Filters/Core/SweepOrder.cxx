// SPDX-License-Identifier: BSD-3-Clause
#include "SweepOrder.h"

#include "BrickOrder.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

namespace po
{
namespace
{
using Octaves = std::array<std::size_t, 256>;

/// The octave of a radius, counted down from the largest: equal radii must never fall on both sides
/// of an edge.
std::size_t octaveOf(float radius, float largest)
{
  return static_cast<std::size_t>(std::min(255.0f, std::floor(std::log2(largest / radius))));
}

/// The band of each octave. A band spans a factor of four, or more where the smaller spheres are
/// few: they use larger cells than they need, but no passes of their own.
std::array<std::int16_t, 256> bandsOfOctaves(const Octaves& counts)
{
  constexpr std::size_t span = 2;     // octaves
  constexpr std::size_t widest = 6;   // octaves
  constexpr std::size_t fewTimes = 4; // so many times more spheres are in the larger octaves
  std::array<std::int16_t, 256> bands{};
  std::size_t first = 0;
  std::size_t count = 0;
  for (std::size_t octave = 0; octave < counts.size(); ++octave)
  {
    const std::size_t width = octave + 1 - first;
    const bool joins = width <= span || (width <= widest && fewTimes * counts[octave] <= count);
    first = joins ? first : octave;
    count = joins ? count + counts[octave] : counts[octave];
    bands[octave] = static_cast<std::int16_t>(-static_cast<int>(first));
  }
  return bands;
}

template <typename Element>
std::vector<Element> inOrder(
  const std::vector<Element>& elements, const std::vector<SweepOrder::Place>& places)
{
  std::vector<Element> ordered;
  ordered.reserve(elements.size());
  if (!elements.empty())
  {
    std::transform(places.begin(), places.end(), std::back_inserter(ordered),
      [&elements](const SweepOrder::Place& place) { return elements[place.source]; });
  }
  return ordered;
}
}

SweepOrder::SweepOrder(const SphereSet& set)
  : set_(set)
{
  for (const Sphere& s : set.spheres())
  {
    largest_ = std::max(largest_, s.radius);
  }
  Octaves counts{};
  for (const Sphere& s : set.spheres())
  {
    ++counts[octaveOf(s.radius, largest_)];
  }
  bands_ = bandsOfOctaves(counts);
  if (set.size() > 0)
  {
    std::transform(
      set.bricks().begin(), set.bricks().end(), std::back_inserter(curves_), curveThrough);
  }
}

SweepOrder::Place SweepOrder::placeOf(unsigned source) const
{
  const std::size_t brick = set_.brickOf(source);
  return { curves_[brick](set_.inBrick(source).center()), source,
    bands_[octaveOf(set_.spheres()[source].radius, largest_)], static_cast<std::uint16_t>(brick) };
}

bool SweepOrder::isBefore(const Place& a, const Place& b) const
{
  if (a.band != b.band)
  {
    return a.band < b.band;
  }
  if (a.brick != b.brick)
  {
    return a.brick < b.brick;
  }
  if (a.morton != b.morton)
  {
    return a.morton < b.morton;
  }
  const auto numbers = [this](const Place& place)
  {
    const Sphere& s = set_.spheres()[place.source];
    return std::tuple(s.x, s.y, s.z, s.radius, place.source);
  };
  return numbers(a) < numbers(b);
}

bool SweepOrder::areEqual(unsigned a, unsigned b) const
{
  return set_.center(a) == set_.center(b) && set_.spheres()[a].radius == set_.spheres()[b].radius;
}

std::vector<SweepOrder::Place> SweepOrder::sorted() const
{
  std::vector<Place> places(set_.size());
  tbb::parallel_for(std::size_t(0), places.size(),
    [&](std::size_t i) { places[i] = placeOf(static_cast<unsigned>(i)); });
  tbb::parallel_sort(places.begin(), places.end(),
    [this](const Place& a, const Place& b) { return isBefore(a, b); });
  return places;
}

void sortForSweep(SphereCloud& cloud, std::vector<unsigned>& particles)
{
  const SphereSet set(std::move(cloud.spheres), std::move(cloud.centers));
  const std::vector<SweepOrder::Place> places = SweepOrder(set).sorted();
  cloud.spheres = inOrder(set.spheres(), places);
  cloud.centers = inOrder(set.centers(), places);
  cloud.ids = inOrder(cloud.ids, places);
  std::vector<unsigned> placeOf(places.size());
  for (unsigned place = 0; place < places.size(); ++place)
  {
    placeOf[places[place].source] = place;
  }
  std::transform(particles.begin(), particles.end(), particles.begin(),
    [&placeOf](unsigned particle) { return placeOf[particle]; });
}
}
