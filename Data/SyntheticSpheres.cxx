// SPDX-License-Identifier: BSD-3-Clause
#include "SyntheticSpheres.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

namespace po
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr float Outside = std::numeric_limits<float>::infinity();

using Vec3 = std::array<float, 3>;

Vec3 operator+(const Vec3& a, const Vec3& b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

Vec3 operator-(const Vec3& a, const Vec3& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Vec3 operator*(float s, const Vec3& a)
{
  return { s * a[0], s * a[1], s * a[2] };
}

float dot(const Vec3& a, const Vec3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vec3 cross(const Vec3& a, const Vec3& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// The standard fixes the bits of mt19937_64 but not of its distributions: hence our own.
class Random
{
public:
  explicit Random(std::uint64_t seed)
    : engine_(seed)
  {
  }

  /// Uniform in [low, high).
  double uniform(double low, double high)
  {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

  /// Each component uniform in [-half, half), in the order x, y, z.
  Vec3 inCube(double half)
  {
    Vec3 v;
    for (float& component : v)
    {
      component = static_cast<float>(uniform(-half, half));
    }
    return v;
  }

  /// Uniform on the unit sphere (by rejection: a square root is rounded alike everywhere).
  Vec3 direction()
  {
    for (;;)
    {
      const Vec3 v = inCube(1.0);
      const float square = dot(v, v);
      if (square <= 1.0F && square > 1e-4F)
      {
        return (1.0F / std::sqrt(square)) * v;
      }
    }
  }

private:
  std::mt19937_64 engine_;
};

/// Sites of a simple cubic lattice in a box that is centred at the origin, numbered x first.
struct Lattice
{
  std::array<std::size_t, 3> size;

  [[nodiscard]] std::size_t count() const { return size[0] * size[1] * size[2]; }

  [[nodiscard]] Vec3 site(std::size_t index) const
  {
    const std::array<std::size_t, 3> ijk = { index % size[0], index / size[0] % size[1],
      index / (size[0] * size[1]) };
    Vec3 site;
    for (int axis = 0; axis < 3; ++axis)
    {
      site[axis] = static_cast<float>(ijk[axis]) - static_cast<float>(size[axis] / 2);
    }
    return site;
  }
};

/// The `count` sites of least level, in lattice order; among equals the first ones.
/// `level(site)` is a float, +infinity where no sphere may be; the caller offers enough sites.
template <typename Level>
std::vector<Vec3> selectSites(const Lattice& lattice, std::size_t count, Level level)
{
  std::vector<float> levels(lattice.count());
  for (std::size_t i = 0; i < levels.size(); ++i)
  {
    levels[i] = level(lattice.site(i));
  }
  std::vector<float> sorted = levels;
  const auto last = sorted.begin() + static_cast<std::ptrdiff_t>(count) - 1;
  std::nth_element(sorted.begin(), last, sorted.end());
  const float highest = *last;
  auto ties = static_cast<std::size_t>(
    count - std::count_if(sorted.begin(), last, [=](float l) { return l < highest; }));

  std::vector<Vec3> sites;
  sites.reserve(count);
  for (std::size_t i = 0; i < levels.size(); ++i)
  {
    if (levels[i] < highest || (levels[i] == highest && ties > 0))
    {
      ties -= levels[i] == highest ? 1 : 0;
      sites.push_back(lattice.site(i));
    }
  }
  return sites;
}

/// A cube of sites that holds [-half, half]^3.
Lattice cubeLattice(double half)
{
  const std::size_t size = 2 * static_cast<std::size_t>(std::ceil(half)) + 1;
  return { { size, size, size } };
}

SyntheticSpheres equalSpheres(std::vector<Vec3> centers, float radius)
{
  SyntheticSpheres spheres;
  spheres.radii.assign(centers.size(), radius);
  spheres.centers = std::move(centers);
  return spheres;
}

/// A piece of the shell: how it has moved since the explosion.
struct Fragment
{
  Vec3 direction; ///< unit vector from the explosion to the piece's seed
  Vec3 tumble;    ///< rotation vector q of the unit quaternion (w, q)
  float tumbleW;  ///< its scalar part
  float flight;   ///< distance flown, in radii of the shell
};

std::vector<Fragment> makeFragments(Random& random)
{
  constexpr double LargestTumble = 0.2; // half the tangent of the angle: up to about 40 degrees
  std::vector<Fragment> fragments(ShellFragments);
  for (Fragment& fragment : fragments)
  {
    fragment.direction = random.direction();
    const auto tangent = static_cast<float>(random.uniform(0.0, 2.0 * LargestTumble));
    const float norm = 1.0F / std::sqrt(1.0F + tangent * tangent);
    fragment.tumble = (tangent * norm) * random.direction();
    fragment.tumbleW = norm;
    fragment.flight = static_cast<float>(random.uniform(0.3, 0.9));
  }
  return fragments;
}

const Fragment& fragmentOf(const Vec3& site, const std::vector<Fragment>& fragments)
{
  return *std::max_element(fragments.begin(), fragments.end(),
    [&](const Fragment& a, const Fragment& b)
    { return dot(a.direction, site) < dot(b.direction, site); });
}

/// v rotated by the unit quaternion (w, q): v + 2 w (q x v) + 2 q x (q x v).
Vec3 rotated(const Vec3& v, float w, const Vec3& q)
{
  const Vec3 t = 2.0F * cross(q, v);
  return v + w * t + cross(q, t);
}

Vec3 flownWithFragment(const Vec3& site, const Fragment& fragment, float shellRadius)
{
  const Vec3 pivot = shellRadius * fragment.direction;
  return rotated(site - pivot, fragment.tumbleW, fragment.tumble) +
    (1.0F + fragment.flight) * pivot;
}

Vec3 flownAsDust(const Vec3& site, float shellRadius, Random& random)
{
  const auto flight = static_cast<float>(random.uniform(0.2, 1.4));
  return (1.0F + flight) * site + random.inCube(0.15 * shellRadius);
}

/// Seeds of the foam's cells: two in every cube, with one layer of cubes around the foam.
class FoamCells
{
public:
  FoamCells(float foamWidth, Random& random)
    : origin_(-0.5F * foamWidth - FoamCubeEdge)
    , cubes_(static_cast<std::size_t>(std::ceil(foamWidth / FoamCubeEdge)) + 2)
  {
    seeds_.reserve(2 * cubes_ * cubes_ * cubes_);
    for (std::size_t cube = 0; cube < cubes_ * cubes_ * cubes_; ++cube)
    {
      const std::array<std::size_t, 3> ijk = { cube % cubes_, cube / cubes_ % cubes_,
        cube / (cubes_ * cubes_) };
      for (const float offset : { 0.25F, 0.75F })
      {
        const Vec3 unit = { ijk[0] + offset, ijk[1] + offset, ijk[2] + offset };
        seeds_.push_back(FoamCubeEdge * (unit + random.inCube(FoamJitter)));
      }
    }
  }

  /// How much farther the third nearest seed is than the nearest: 0 on a Voronoi edge, where three
  /// cells meet, and growing with distance from it. What lies below a level is thus a net of struts
  /// that thicken where they meet, as in a real foam.
  [[nodiscard]] float strutLevel(const Vec3& point) const
  {
    const Vec3 local = point - Vec3{ origin_, origin_, origin_ };
    std::array<float, 3> nearest = { Outside, Outside, Outside };
    visitNeighbours(local,
      [&](const Vec3& seed)
      {
        const Vec3 offset = local - seed;
        const float square = dot(offset, offset);
        const float second = std::max(nearest[0], square);
        const float third = std::max(nearest[1], second);
        nearest = { std::min(nearest[0], square), std::min(nearest[1], second),
          std::min(nearest[2], third) };
      });
    return std::sqrt(nearest[2]) - std::sqrt(nearest[0]);
  }

private:
  /// The seeds of the 27 cubes around a point. They hold its three nearest: in the undisturbed
  /// lattice four seeds lie within 0.71 edges of any point, all others that are not visited at 1.25
  /// edges or more, and the jitter moves a seed by 0.18 sqrt(3) = 0.31 edges at most, along an axis
  /// by 0.18: 0.71 + 0.31 < 1.25 - 0.18.
  template <typename Visit>
  void visitNeighbours(const Vec3& local, Visit visit) const
  {
    const auto cubeOf = [](float x) { return static_cast<std::size_t>(x / FoamCubeEdge); };
    for (std::size_t k = cubeOf(local[2]) - 1; k <= cubeOf(local[2]) + 1; ++k)
    {
      for (std::size_t j = cubeOf(local[1]) - 1; j <= cubeOf(local[1]) + 1; ++j)
      {
        // Three cubes in a row along x: six seeds that follow each other in memory.
        const Vec3* row = &seeds_[2 * ((k * cubes_ + j) * cubes_ + cubeOf(local[0]) - 1)];
        std::for_each(row, row + 6, visit);
      }
    }
  }

  float origin_;
  std::size_t cubes_;
  std::vector<Vec3> seeds_;
};

SyntheticSpheres makePack(std::size_t count)
{
  // Half of the integer points have an even sum.
  const double ballRadius = std::cbrt(2.0 * static_cast<double>(count) * 3.0 / (4.0 * Pi)) + 2.0;
  const auto level = [](const Vec3& site)
  {
    const auto sum = static_cast<std::int64_t>(site[0] + site[1] + site[2]);
    return sum % 2 == 0 ? dot(site, site) : Outside;
  };
  return equalSpheres(
    selectSites(cubeLattice(ballRadius), count, level), static_cast<float>(std::sqrt(0.5)));
}

SyntheticSpheres makeOverlap(std::size_t count, std::uint64_t seed)
{
  // count = pi R^2 (1 - bore^2) 2 R; a layer more makes good what the lattice rounds away.
  const double outer =
    1.0 + std::cbrt(static_cast<double>(count) / (2.0 * Pi * (1.0 - OverlapBore * OverlapBore)));
  const auto inner = static_cast<float>(OverlapBore * outer);
  const auto level = [=](const Vec3& site)
  {
    const float r = std::sqrt(site[0] * site[0] + site[1] * site[1]);
    return r >= inner && r <= static_cast<float>(outer) ? site[2] : Outside;
  };
  std::vector<Vec3> centers = selectSites(cubeLattice(outer), count, level);

  Random random(seed);
  for (Vec3& center : centers)
  {
    center = center + random.inCube(OverlapJitter);
  }
  return equalSpheres(std::move(centers), OverlapRadius);
}

SyntheticSpheres makeGas(std::size_t count, std::uint64_t seed)
{
  constexpr double SphereVolume = Pi / 6.0;
  const double width = std::cbrt(static_cast<double>(count) * SphereVolume / GasVolumeFraction);
  Random random(seed);
  std::vector<Vec3> centers(count);
  std::generate(centers.begin(), centers.end(), [&] { return random.inCube(0.5 * width); });
  return equalSpheres(std::move(centers), 0.5F);
}

SyntheticSpheres makeShell(std::size_t count, std::uint64_t seed)
{
  // count = 4 pi R^2 thickness R
  const double radius = std::cbrt(static_cast<double>(count) / (4.0 * Pi * ShellThickness));
  const auto shellRadius = static_cast<float>(radius);
  const auto level = [=](const Vec3& site)
  { return std::abs(std::sqrt(dot(site, site)) - shellRadius); };
  std::vector<Vec3> centers =
    selectSites(cubeLattice((1.0 + ShellThickness) * radius + 1.0), count, level);

  Random random(seed);
  const std::vector<Fragment> fragments = makeFragments(random);
  for (Vec3& center : centers)
  {
    center = random.uniform(0.0, 1.0) < ShellDust
      ? flownAsDust(center, shellRadius, random)
      : flownWithFragment(center, fragmentOf(center, fragments), shellRadius);
  }
  return equalSpheres(std::move(centers), 0.5F);
}

SyntheticSpheres makeFoam(std::size_t count, std::uint64_t seed)
{
  const double width = std::cbrt(static_cast<double>(count) / FoamRelativeDensity);
  const Lattice lattice = cubeLattice(0.5 * (width - 1.0));
  Random random(seed);
  const FoamCells cells(static_cast<float>(lattice.size[0]), random);
  return equalSpheres(
    selectSites(lattice, count, [&](const Vec3& site) { return cells.strutLevel(site); }), 0.5F);
}
}

std::optional<SyntheticFamily> syntheticFamilyFromName(std::string_view name)
{
  using Entry = std::pair<std::string_view, SyntheticFamily>;
  constexpr std::array<Entry, 5> Families = { Entry{ "pack", SyntheticFamily::Pack },
    Entry{ "overlap", SyntheticFamily::Overlap }, Entry{ "gas", SyntheticFamily::Gas },
    Entry{ "shell", SyntheticFamily::Shell }, Entry{ "foam", SyntheticFamily::Foam } };
  const auto* found = std::find_if(
    Families.begin(), Families.end(), [=](const Entry& entry) { return entry.first == name; });
  return found == Families.end() ? std::nullopt : std::make_optional(found->second);
}

SyntheticSpheres makeSyntheticSpheres(SyntheticFamily family, std::size_t count, std::uint64_t seed)
{
  if (count > LargestSyntheticCount)
  {
    throw std::length_error(
      "at most " + std::to_string(LargestSyntheticCount) + " synthetic spheres can be made");
  }
  if (count == 0)
  {
    return {};
  }
  switch (family)
  {
    case SyntheticFamily::Pack:
      return makePack(count);
    case SyntheticFamily::Overlap:
      return makeOverlap(count, seed);
    case SyntheticFamily::Gas:
      return makeGas(count, seed);
    case SyntheticFamily::Shell:
      return makeShell(count, seed);
    case SyntheticFamily::Foam:
      return makeFoam(count, seed);
  }
  return {};
}
}
