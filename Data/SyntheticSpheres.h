// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SyntheticSpheres_h
#define po_SyntheticSpheres_h

/// Synthetic particle data for tests and benchmarks: five families of spheres at any size.
///
/// Every family gives exactly the count that is asked for, equal radii, finite coordinates (lengths
/// are in spacings of the lattice, and a gas particle has the diameter 1) and, for one seed, the
/// same bits on every run. The families differ in what they ask of an occlusion baker: from "nearly
/// all is buried" (Pack, Overlap) over "all is near a surface" (Shell, Foam) to "nearly all sees
/// nearly all" (Gas).

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace po
{
enum class SyntheticFamily
{
  /// A ball of touching spheres on the face-centred cubic lattice: integer coordinates of even sum,
  /// radius 1/sqrt(2) rounded down, so that 12 neighbours touch to one rounding and none overlaps.
  Pack,

  /// A tube along z as the material point method fills one: simple cubic lattice of spacing 1,
  /// every coordinate moved by up to OverlapJitter, OverlapRadius > 1/2. The bore is OverlapBore
  /// times the outer radius, the length twice the outer radius; the last layer may be incomplete.
  Overlap,

  /// Independent uniform positions in a cube, not periodic, radius 1/2, GasVolumeFraction of the
  /// cube's volume. As in any ideal gas, some spheres overlap: about 8 * GasVolumeFraction of them.
  Gas,

  /// A thin spherical shell of touching spheres, radius 1/2, thickness ShellThickness of its
  /// radius, torn by an explosion at the origin into ShellFragments pieces that fly and tumble each
  /// at its own speed, amid a dust of single particles (a share ShellDust of all).
  Shell,

  /// A cube of open-cell foam: spheres of radius 1/2 touching on a simple cubic lattice, as from a
  /// segmented tomogram, along the struts (edges) of a Voronoi diagram. The seeds of its cells are
  /// a body-centred cubic lattice of edge FoamCubeEdge, each coordinate moved by up to FoamJitter
  /// of that edge. About FoamRelativeDensity of the lattice sites hold a sphere, whatever the
  /// count.
  Foam
};

inline constexpr float OverlapRadius = 0.62F; // the sphere that has the volume of a lattice cell
inline constexpr float OverlapJitter = 0.05F;
inline constexpr double OverlapBore = 0.6;
inline constexpr double GasVolumeFraction = 0.01;
inline constexpr double ShellThickness = 0.04;
inline constexpr std::size_t ShellFragments = 80;
inline constexpr double ShellDust = 0.06;
inline constexpr double FoamRelativeDensity = 0.1;
inline constexpr float FoamCubeEdge = 32.0F;
inline constexpr float FoamJitter = 0.18F;

inline constexpr std::size_t LargestSyntheticCount = 1'000'000'000;

struct SyntheticSpheres
{
  std::vector<std::array<float, 3>> centers; ///< [N] x, y, z
  std::vector<float> radii;                  ///< [N]
};

/// "pack", "overlap", "gas", "shell" or "foam"; nothing for any other name.
[[nodiscard]] std::optional<SyntheticFamily> syntheticFamilyFromName(std::string_view name);

/// `count` spheres of a family, 0 to LargestSyntheticCount; Pack has nothing random and ignores the
/// seed. Throws std::length_error for a larger count and std::bad_alloc when memory does not
/// suffice (Foam needs most: about 100 bytes a sphere).
[[nodiscard]] SyntheticSpheres makeSyntheticSpheres(
  SyntheticFamily family, std::size_t count, std::uint64_t seed);
}

#endif
