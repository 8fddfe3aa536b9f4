// SPDX-License-Identifier: BSD-3-Clause
#include "SharedSpheres.h"

#include "MortonCurve.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <tuple>

namespace po
{
namespace
{
using Words = ProcessGroup::Words;

constexpr std::size_t NumbersPerBox = 6;

/// Values of a trivial type as words, and back.
template <typename Value>
void append(const Value& value, Words& words)
{
  static_assert(sizeof(Value) % sizeof(std::uint64_t) == 0);
  const std::size_t end = words.size();
  words.resize(end + sizeof(Value) / sizeof(std::uint64_t));
  std::memcpy(words.data() + end, &value, sizeof(Value));
}

template <typename Value>
std::vector<Value> valuesOf(const Words& words)
{
  std::vector<Value> values(words.size() * sizeof(std::uint64_t) / sizeof(Value));
  if (!values.empty())
  {
    std::memcpy(values.data(), words.data(), values.size() * sizeof(Value));
  }
  return values;
}

/// Three corners, and a number that makes the size even.
using TravellingTriangle = std::array<float, 10>;

Vec3f corner(const TravellingTriangle& triangle, std::size_t k)
{
  return { triangle[3 * k], triangle[3 * k + 1], triangle[3 * k + 2] };
}

Vec3f lowest(Vec3f a, Vec3f b)
{
  return { std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z) };
}

Vec3f highest(Vec3f a, Vec3f b)
{
  return { std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z) };
}

/// Sends everything that matters to a process there, and returns what arrives here.
template <typename Value, typename Matters>
std::vector<Value> distribute(
  const std::vector<Value>& own, const ProcessGroup& group, bool toAll, const Matters& matters)
{
  std::vector<Value> arrived;
  for (int process = 0; process < (toAll ? 1 : group.size()); ++process)
  {
    Words words;
    for (const Value& value : own)
    {
      if (toAll || matters(static_cast<std::size_t>(process), value))
      {
        append(value, words);
      }
    }
    const Words all = toAll ? group.gather(words) : group.gatherAt(process, words);
    if (toAll || process == group.rank())
    {
      arrived = valuesOf<Value>(all);
    }
  }
  return arrived;
}

/// A sphere with its place along a curve. The radius of a ghost travels negative.
struct Place
{
  std::uint64_t morton;
  Sphere sphere;

  [[nodiscard]] bool isGhost() const { return sphere.radius < 0; }

  [[nodiscard]] auto identity() const
  {
    return std::make_tuple(morton, sphere.x, sphere.y, sphere.z, std::abs(sphere.radius));
  }

  /// Of equal spheres ghosts come last.
  bool operator<(const Place& other) const
  {
    return identity() != other.identity() ? identity() < other.identity()
                                          : isGhost() < other.isGhost();
  }
};

/// The curve must be the same everywhere, whatever part of the spheres is at hand.
MortonCurve commonCurve(const std::vector<Sphere>& own, const ProcessGroup& group)
{
  double reach = 0;
  for (const Sphere& s : own)
  {
    reach =
      std::max({ reach, std::abs(double(s.x)), std::abs(double(s.y)), std::abs(double(s.z)) });
  }
  const auto half = static_cast<float>(group.largest(reach));
  return { { -half, -half, -half }, 2 * half };
}

std::vector<Place> sortedPlaces(const std::vector<Sphere>& spheres, const MortonCurve& curve)
{
  std::vector<Place> places(spheres.size());
  tbb::parallel_for(std::size_t(0), spheres.size(),
    [&](std::size_t i) {
      places[i] = { curve(spheres[i].center()), spheres[i] };
    });
  tbb::parallel_sort(places.begin(), places.end());
  return places;
}

/// A ghost goes if its original, or another copy, is there.
void removeGhosts(std::vector<Place>& places)
{
  std::size_t kept = 0;
  for (const Place& place : places)
  {
    const bool copy =
      place.isGhost() && kept > 0 && places[kept - 1].identity() == place.identity();
    if (!copy)
    {
      places[kept++] = place;
    }
  }
  places.resize(kept);
  for (Place& place : places)
  {
    place.sphere.radius = std::abs(place.sphere.radius);
  }
}

unsigned placeOf(const Sphere& sphere, const std::vector<Place>& places, const MortonCurve& curve)
{
  const Place wanted{ curve(sphere.center()), sphere };
  return static_cast<unsigned>(
    std::lower_bound(places.begin(), places.end(), wanted) - places.begin());
}

std::vector<TravellingTriangle> travelling(const OccluderMesh& mesh)
{
  std::vector<TravellingTriangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const std::array<unsigned, 3>& ids : mesh.triangles)
  {
    TravellingTriangle triangle{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      std::memcpy(&triangle[3 * k], &mesh.vertices[ids[k]].x, 3 * sizeof(float));
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

OccluderMesh meshOf(const std::vector<TravellingTriangle>& triangles)
{
  OccluderMesh mesh;
  for (const TravellingTriangle& triangle : triangles)
  {
    const auto first = static_cast<unsigned>(mesh.vertices.size());
    for (std::size_t k = 0; k < 3; ++k)
    {
      mesh.vertices.push_back(corner(triangle, k));
    }
    mesh.triangles.push_back({ first, first + 1, first + 2 });
  }
  return mesh;
}

auto mattersTo(const Neighbourhood& neighbourhood)
{
  return [&neighbourhood](std::size_t process, const Sphere& s)
  {
    const float r = std::abs(s.radius);
    const Vec3f half{ r, r, r };
    return neighbourhood.matters(process, s.center() - half, s.center() + half);
  };
}
}

Neighbourhood::Neighbourhood(
  const std::vector<Sphere>& own, float distance, const ProcessGroup& group)
  : reach(distance)
{
  if (group.size() == 1 || !std::isfinite(reach))
  {
    return;
  }
  // A process without spheres has an empty box, which nothing meets.
  Vec3d low{ HUGE_VAL, HUGE_VAL, HUGE_VAL };
  Vec3d high{ -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  for (const Sphere& s : own)
  {
    const Vec3d c = s.center().as<double>();
    // Wider than rounding at that distance from the origin.
    const double margin = reach + s.radius + 1e-5 * (reach + length(c));
    low = { std::min(low.x, c.x - margin), std::min(low.y, c.y - margin),
      std::min(low.z, c.z - margin) };
    high = { std::max(high.x, c.x + margin), std::max(high.y, c.y + margin),
      std::max(high.z, c.z + margin) };
  }
  Words words;
  for (const double number : { low.x, low.y, low.z, high.x, high.y, high.z })
  {
    words.push_back(wordOf(number));
  }
  boxes = valuesOf<double>(group.gather(words));
}

bool Neighbourhood::matters(std::size_t process, Vec3f low, Vec3f high) const
{
  const double* box = boxes.data() + NumbersPerBox * process;
  const float* from = &low.x;
  const float* to = &high.x;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (to[axis] < box[axis] || from[axis] > box[axis + 3])
    {
      return false;
    }
  }
  return true;
}

SharedSpheres shareSpheres(const std::vector<Sphere>& own, const std::vector<std::uint8_t>& ghosts,
  const Neighbourhood& neighbourhood, const ProcessGroup& group)
{
  const MortonCurve curve = commonCurve(own, group);
  std::vector<Sphere> marked = own;
  for (std::size_t i = 0; i < ghosts.size(); ++i)
  {
    marked[i].radius = ghosts[i] != 0 ? -own[i].radius : own[i].radius;
  }
  const std::vector<Sphere> all =
    distribute(marked, group, neighbourhood.boxes.empty(), mattersTo(neighbourhood));
  std::vector<Place> places = sortedPlaces(all, curve);
  removeGhosts(places);

  SharedSpheres shared;
  shared.places.resize(own.size());
  tbb::parallel_for(std::size_t(0), own.size(),
    [&](std::size_t i) { shared.places[i] = placeOf(own[i], places, curve); });
  shared.spheres.reserve(places.size());
  std::transform(places.begin(), places.end(), std::back_inserter(shared.spheres),
    [](const Place& place) { return place.sphere; });
  return shared;
}

Occluders shareOccluders(
  Occluders own, const Neighbourhood& neighbourhood, const ProcessGroup& group)
{
  Occluders all;
  all.spheres = shareSpheres(own.spheres, {}, neighbourhood, group).spheres;
  if (group.size() == 1)
  {
    all.mesh = std::move(own.mesh);
    return all;
  }
  all.mesh = meshOf(distribute(travelling(own.mesh), group, neighbourhood.boxes.empty(),
    [&](std::size_t process, const TravellingTriangle& t)
    {
      const Vec3f low = lowest(corner(t, 0), lowest(corner(t, 1), corner(t, 2)));
      const Vec3f high = highest(corner(t, 0), highest(corner(t, 1), corner(t, 2)));
      return neighbourhood.matters(process, low, high);
    }));
  return all;
}
}
