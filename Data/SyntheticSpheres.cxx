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

float Dot(const Vec3& a, const Vec3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vec3 Cross(const Vec3& a, const Vec3& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// The standard fixes the bits of mt19937_64 but not of its distributions: hence our own.
class Random
{
public:
  explicit Random(std::uint64_t seed)
    : Engine(seed)
  {
  }

  /// Uniform in [low, high).
  double Uniform(double low, double high)
  {
    return low + (high - low) * static_cast<double>(this->Engine() >> 11) * 0x1p-53;
  }

  /// Each component uniform in [-half, half), in the order x, y, z.
  Vec3 InCube(double half)
  {
    Vec3 v;
    for (float& component : v)
    {
      component = static_cast<float>(this->Uniform(-half, half));
    }
    return v;
  }

  /// Uniform on the unit sphere (by rejection: a square root is rounded alike everywhere).
  Vec3 Direction()
  {
    for (;;)
    {
      const Vec3 v = this->InCube(1.0);
      const float square = Dot(v, v);
      if (square <= 1.0F && square > 1e-4F)
      {
        return (1.0F / std::sqrt(square)) * v;
      }
    }
  }

private:
  std::mt19937_64 Engine;
};

/// Sites of a simple cubic lattice in a box that is centred at the origin, numbered x first.
struct Lattice
{
  std::array<std::size_t, 3> Size;

  [[nodiscard]] std::size_t Count() const { return this->Size[0] * this->Size[1] * this->Size[2]; }

  [[nodiscard]] Vec3 Site(std::size_t index) const
  {
    const std::array<std::size_t, 3> ijk = { index % this->Size[0],
      index / this->Size[0] % this->Size[1], index / (this->Size[0] * this->Size[1]) };
    Vec3 site;
    for (int axis = 0; axis < 3; ++axis)
    {
      site[axis] = static_cast<float>(ijk[axis]) - static_cast<float>(this->Size[axis] / 2);
    }
    return site;
  }
};

/// The `count` sites of least level, in lattice order; among equals the first ones.
/// `level(site)` is a float, +infinity where no sphere may be; the caller offers enough sites.
template <typename Level>
std::vector<Vec3> SelectSites(const Lattice& lattice, std::size_t count, Level level)
{
  std::vector<float> levels(lattice.Count());
  for (std::size_t i = 0; i < levels.size(); ++i)
  {
    levels[i] = level(lattice.Site(i));
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
      sites.push_back(lattice.Site(i));
    }
  }
  return sites;
}

/// A cube of sites that holds [-half, half]^3.
Lattice CubeLattice(double half)
{
  const std::size_t size = 2 * static_cast<std::size_t>(std::ceil(half)) + 1;
  return { { size, size, size } };
}

SyntheticSpheres EqualSpheres(std::vector<Vec3> centers, float radius)
{
  SyntheticSpheres spheres;
  spheres.Radii.assign(centers.size(), radius);
  spheres.Centers = std::move(centers);
  return spheres;
}

/// A piece of the shell: how it has moved since the explosion.
struct Fragment
{
  Vec3 Direction; ///< unit vector from the explosion to the piece's seed
  Vec3 Tumble;    ///< rotation vector q of the unit quaternion (w, q)
  float TumbleW;  ///< its scalar part
  float Flight;   ///< distance flown, in radii of the shell
};

std::vector<Fragment> MakeFragments(Random& random)
{
  constexpr double largestTumble = 0.2; // half the tangent of the angle: up to about 40 degrees
  std::vector<Fragment> fragments(ShellFragments);
  for (Fragment& fragment : fragments)
  {
    fragment.Direction = random.Direction();
    const auto tangent = static_cast<float>(random.Uniform(0.0, 2.0 * largestTumble));
    const float norm = 1.0F / std::sqrt(1.0F + tangent * tangent);
    fragment.Tumble = (tangent * norm) * random.Direction();
    fragment.TumbleW = norm;
    fragment.Flight = static_cast<float>(random.Uniform(0.3, 0.9));
  }
  return fragments;
}

const Fragment& FragmentOf(const Vec3& site, const std::vector<Fragment>& fragments)
{
  return *std::max_element(fragments.begin(), fragments.end(),
    [&](const Fragment& a, const Fragment& b)
    { return Dot(a.Direction, site) < Dot(b.Direction, site); });
}

/// v rotated by the unit quaternion (w, q): v + 2 w (q x v) + 2 q x (q x v).
Vec3 Rotated(const Vec3& v, float w, const Vec3& q)
{
  const Vec3 t = 2.0F * Cross(q, v);
  return v + w * t + Cross(q, t);
}

Vec3 FlownWithFragment(const Vec3& site, const Fragment& fragment, float shellRadius)
{
  const Vec3 pivot = shellRadius * fragment.Direction;
  return Rotated(site - pivot, fragment.TumbleW, fragment.Tumble) +
    (1.0F + fragment.Flight) * pivot;
}

Vec3 FlownAsDust(const Vec3& site, float shellRadius, Random& random)
{
  const auto flight = static_cast<float>(random.Uniform(0.2, 1.4));
  return (1.0F + flight) * site + random.InCube(0.15 * shellRadius);
}

/// Seeds of the foam's cells: two in every cube, with one layer of cubes around the foam.
class FoamCells
{
public:
  FoamCells(float foamWidth, Random& random)
    : Origin(-0.5F * foamWidth - FoamCubeEdge)
    , Cubes(static_cast<std::size_t>(std::ceil(foamWidth / FoamCubeEdge)) + 2)
  {
    this->Seeds.reserve(2 * this->Cubes * this->Cubes * this->Cubes);
    for (std::size_t cube = 0; cube < this->Cubes * this->Cubes * this->Cubes; ++cube)
    {
      const std::array<std::size_t, 3> ijk = { cube % this->Cubes, cube / this->Cubes % this->Cubes,
        cube / (this->Cubes * this->Cubes) };
      for (const float offset : { 0.25F, 0.75F })
      {
        const Vec3 unit = { ijk[0] + offset, ijk[1] + offset, ijk[2] + offset };
        this->Seeds.push_back(FoamCubeEdge * (unit + random.InCube(FoamJitter)));
      }
    }
  }

  /// How much farther the third nearest seed is than the nearest: 0 on a Voronoi edge, where three
  /// cells meet, and growing with distance from it. What lies below a level is thus a net of struts
  /// that thicken where they meet, as in a real foam.
  [[nodiscard]] float StrutLevel(const Vec3& point) const
  {
    const Vec3 local = point - Vec3{ this->Origin, this->Origin, this->Origin };
    std::array<float, 3> nearest = { Outside, Outside, Outside };
    this->VisitNeighbours(local,
      [&](const Vec3& seed)
      {
        const Vec3 offset = local - seed;
        const float square = Dot(offset, offset);
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
  void VisitNeighbours(const Vec3& local, Visit visit) const
  {
    const auto cubeOf = [](float x) { return static_cast<std::size_t>(x / FoamCubeEdge); };
    for (std::size_t k = cubeOf(local[2]) - 1; k <= cubeOf(local[2]) + 1; ++k)
    {
      for (std::size_t j = cubeOf(local[1]) - 1; j <= cubeOf(local[1]) + 1; ++j)
      {
        // Three cubes in a row along x: six seeds that follow each other in memory.
        const Vec3* row =
          &this->Seeds[2 * ((k * this->Cubes + j) * this->Cubes + cubeOf(local[0]) - 1)];
        std::for_each(row, row + 6, visit);
      }
    }
  }

  float Origin;
  std::size_t Cubes;
  std::vector<Vec3> Seeds;
};

SyntheticSpheres MakePack(std::size_t count)
{
  // Half of the integer points have an even sum.
  const double ballRadius = std::cbrt(2.0 * static_cast<double>(count) * 3.0 / (4.0 * Pi)) + 2.0;
  const auto level = [](const Vec3& site)
  {
    const auto sum = static_cast<std::int64_t>(site[0] + site[1] + site[2]);
    return sum % 2 == 0 ? Dot(site, site) : Outside;
  };
  return EqualSpheres(
    SelectSites(CubeLattice(ballRadius), count, level), static_cast<float>(std::sqrt(0.5)));
}

SyntheticSpheres MakeOverlap(std::size_t count, std::uint64_t seed)
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
  std::vector<Vec3> centers = SelectSites(CubeLattice(outer), count, level);

  Random random(seed);
  for (Vec3& center : centers)
  {
    center = center + random.InCube(OverlapJitter);
  }
  return EqualSpheres(std::move(centers), OverlapRadius);
}

SyntheticSpheres MakeGas(std::size_t count, std::uint64_t seed)
{
  constexpr double sphereVolume = Pi / 6.0;
  const double width = std::cbrt(static_cast<double>(count) * sphereVolume / GasVolumeFraction);
  Random random(seed);
  std::vector<Vec3> centers(count);
  std::generate(centers.begin(), centers.end(), [&] { return random.InCube(0.5 * width); });
  return EqualSpheres(std::move(centers), 0.5F);
}

SyntheticSpheres MakeShell(std::size_t count, std::uint64_t seed)
{
  // count = 4 pi R^2 thickness R
  const double radius = std::cbrt(static_cast<double>(count) / (4.0 * Pi * ShellThickness));
  const auto shellRadius = static_cast<float>(radius);
  const auto level = [=](const Vec3& site)
  { return std::abs(std::sqrt(Dot(site, site)) - shellRadius); };
  std::vector<Vec3> centers =
    SelectSites(CubeLattice((1.0 + ShellThickness) * radius + 1.0), count, level);

  Random random(seed);
  const std::vector<Fragment> fragments = MakeFragments(random);
  for (Vec3& center : centers)
  {
    center = random.Uniform(0.0, 1.0) < ShellDust
      ? FlownAsDust(center, shellRadius, random)
      : FlownWithFragment(center, FragmentOf(center, fragments), shellRadius);
  }
  return EqualSpheres(std::move(centers), 0.5F);
}

SyntheticSpheres MakeFoam(std::size_t count, std::uint64_t seed)
{
  const double width = std::cbrt(static_cast<double>(count) / FoamRelativeDensity);
  const Lattice lattice = CubeLattice(0.5 * (width - 1.0));
  Random random(seed);
  const FoamCells cells(static_cast<float>(lattice.Size[0]), random);
  return EqualSpheres(
    SelectSites(lattice, count, [&](const Vec3& site) { return cells.StrutLevel(site); }), 0.5F);
}

} // namespace

std::optional<SyntheticFamily> SyntheticFamilyFromName(std::string_view name)
{
  using Entry = std::pair<std::string_view, SyntheticFamily>;
  constexpr std::array<Entry, 5> families = { Entry{ "pack", SyntheticFamily::Pack },
    Entry{ "overlap", SyntheticFamily::Overlap }, Entry{ "gas", SyntheticFamily::Gas },
    Entry{ "shell", SyntheticFamily::Shell }, Entry{ "foam", SyntheticFamily::Foam } };
  const auto* found = std::find_if(
    families.begin(), families.end(), [=](const Entry& entry) { return entry.first == name; });
  return found == families.end() ? std::nullopt : std::make_optional(found->second);
}

SyntheticSpheres MakeSyntheticSpheres(SyntheticFamily family, std::size_t count, std::uint64_t seed)
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
      return MakePack(count);
    case SyntheticFamily::Overlap:
      return MakeOverlap(count, seed);
    case SyntheticFamily::Gas:
      return MakeGas(count, seed);
    case SyntheticFamily::Shell:
      return MakeShell(count, seed);
    case SyntheticFamily::Foam:
      return MakeFoam(count, seed);
  }
  return {};
}

} // namespace po
