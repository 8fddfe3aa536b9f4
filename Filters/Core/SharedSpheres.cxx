// SPDX-License-Identifier: BSD-3-Clause
#include "SharedSpheres.h"

#include "MortonCurve.h"
#include "SharedWords.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <tuple>
#include <utility>

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
  return valuesAt<Value>(words.data(), words.size() * WordBytes / sizeof(Value));
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

/// One of a set that is wider than floats.
struct WideSphere
{
  Sphere sphere;
  std::array<double, 3> center; ///< in full
};

const Sphere& sphereOf(const Sphere& sphere)
{
  return sphere;
}

const Sphere& sphereOf(const WideSphere& wide)
{
  return wide.sphere;
}

/// As it is for all others, ghost or not.
Sphere withoutMark(Sphere sphere)
{
  sphere.radius = std::abs(sphere.radius);
  return sphere;
}

WideSphere withoutMark(const WideSphere& wide)
{
  return { withoutMark(wide.sphere), wide.center };
}

void appendCenter(const Sphere& /*narrow*/, std::vector<Vec3d>& /*centers*/) {}

void appendCenter(const WideSphere& wide, std::vector<Vec3d>& centers)
{
  centers.push_back({ wide.center[0], wide.center[1], wide.center[2] });
}

auto identityOf(const Sphere& s)
{
  return std::make_tuple(s.x, s.y, s.z, std::abs(s.radius));
}

/// The floats come first: they decide the place along a curve.
auto identityOf(const WideSphere& s)
{
  return std::tuple_cat(identityOf(s.sphere), std::make_tuple(s.center));
}

/// The curve must be the same everywhere, whatever part of the spheres is at hand.
MortonCurve commonCurve(const std::vector<Sphere>& own, FrameFit fit, const ProcessGroup& group)
{
  double reach = 0;
  for (const Sphere& s : own)
  {
    reach =
      std::max({ reach, std::abs(double(s.x)), std::abs(double(s.y)), std::abs(double(s.z)) });
  }
  reach = group.largest(reach);
  if (fit == FrameFit::Steady && reach > 0)
  {
    reach = std::exp2(std::ceil(std::log2(reach)));
  }
  const auto half = static_cast<float>(reach);
  return { { -half, -half, -half }, 2 * half };
}

/// The order of spheres along a curve, 16 bytes each. The radius of a ghost travels negative; of
/// equal spheres ghosts come last.
template <typename Travelling>
class OrderedSpheres
{
public:
  /// The spheres must outlive this.
  OrderedSpheres(const std::vector<Travelling>& spheres, const MortonCurve& curve)
    : spheres_(spheres)
    , curve_(curve)
    , places_(spheres.size())
  {
    tbb::parallel_for(std::size_t(0), spheres.size(),
      [this](std::size_t i) {
        places_[i] = { curve_(sphereOf(spheres_[i]).center()), static_cast<unsigned>(i) };
      });
    tbb::parallel_sort(places_.begin(), places_.end(),
      [this](const Place& a, const Place& b) { return isBefore(a, b); });
    removeGhosts();
  }

  [[nodiscard]] std::size_t size() const { return places_.size(); }
  [[nodiscard]] const Travelling& operator[](std::size_t place) const
  {
    return spheres_[places_[place].index];
  }

  /// The first place of spheres that are equal to this one, which is no ghost.
  [[nodiscard]] unsigned find(const Travelling& sphere) const
  {
    const std::uint64_t morton = curve_(sphereOf(sphere).center());
    const auto found = std::lower_bound(places_.begin(), places_.end(), sphere,
      [this, morton](const Place& place, const Travelling& wanted)
      {
        return place.morton != morton ? place.morton < morton
                                      : identityOf(spheres_[place.index]) < identityOf(wanted);
      });
    return static_cast<unsigned>(found - places_.begin());
  }

private:
  struct Place
  {
    std::uint64_t morton;
    unsigned index;
  };

  [[nodiscard]] bool isGhost(const Place& place) const
  {
    return sphereOf(spheres_[place.index]).radius < 0;
  }

  [[nodiscard]] bool isBefore(const Place& a, const Place& b) const
  {
    if (a.morton != b.morton)
    {
      return a.morton < b.morton;
    }
    const auto first = identityOf(spheres_[a.index]);
    const auto second = identityOf(spheres_[b.index]);
    return first != second ? first < second : isGhost(a) < isGhost(b);
  }

  /// A ghost goes if its original, or another copy, is there.
  void removeGhosts()
  {
    std::size_t kept = 0;
    for (const Place& place : places_)
    {
      const bool copy = isGhost(place) && kept > 0 &&
        identityOf(spheres_[places_[kept - 1].index]) == identityOf(spheres_[place.index]);
      if (!copy)
      {
        places_[kept++] = place;
      }
    }
    places_.resize(kept);
  }

  const std::vector<Travelling>& spheres_;
  MortonCurve curve_;
  std::vector<Place> places_;
};

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
  return [&neighbourhood](std::size_t process, const auto& travelling)
  {
    const Sphere& s = sphereOf(travelling);
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

namespace
{
/// @param marked the own ones, ghosts with a negative radius
template <typename Travelling>
SharedSpheres share(const std::vector<Travelling>& marked, const MortonCurve& curve,
  const Neighbourhood& neighbourhood, const ProcessGroup& group)
{
  std::vector<Travelling> arrived;
  if (group.size() > 1)
  {
    arrived = distribute(marked, group, neighbourhood.boxes.empty(), mattersTo(neighbourhood));
  }
  const OrderedSpheres<Travelling> all(group.size() > 1 ? arrived : marked, curve);

  SharedSpheres shared;
  shared.places.resize(marked.size());
  // Of equal spheres, ghosts among them, the first one stands for all.
  tbb::parallel_for(std::size_t(0), marked.size(),
    [&](std::size_t i) { shared.places[i] = all.find(withoutMark(marked[i])); });
  shared.spheres.reserve(all.size());
  for (std::size_t place = 0; place < all.size(); ++place)
  {
    shared.spheres.push_back(withoutMark(sphereOf(all[place])));
    appendCenter(all[place], shared.centers);
  }
  return shared;
}
}

SharedSpheres shareSpheres(std::vector<Sphere> own, const std::vector<std::uint8_t>& ghosts,
  const Neighbourhood& neighbourhood, const ProcessGroup& group, const std::vector<Vec3d>& centers,
  FrameFit fit)
{
  const MortonCurve curve = commonCurve(own, fit, group);
  for (std::size_t i = 0; i < ghosts.size(); ++i)
  {
    own[i].radius = ghosts[i] != 0 ? -own[i].radius : own[i].radius;
  }
  if (group.largest(centers.empty() ? 0.0 : 1.0) == 0)
  {
    return share(own, curve, neighbourhood, group);
  }
  std::vector<WideSphere> wide;
  wide.reserve(own.size());
  for (std::size_t i = 0; i < own.size(); ++i)
  {
    const Vec3d c = centers.empty() ? own[i].center().as<double>() : centers[i];
    wide.push_back({ own[i], { c.x, c.y, c.z } });
  }
  return share(wide, curve, neighbourhood, group);
}

Occluders shareOccluders(
  Occluders own, const Neighbourhood& neighbourhood, const ProcessGroup& group, FrameFit fit)
{
  Occluders all;
  SharedSpheres spheres =
    shareSpheres(std::move(own.spheres), {}, neighbourhood, group, own.centers, fit);
  all.spheres = std::move(spheres.spheres);
  all.centers = std::move(spheres.centers);
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
