// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SweepOrder_h
#define po_SweepOrder_h

#include "MortonCurve.h"
#include "SphereCloud.h"
#include "SphereSet.h"

#include <array>
#include <cstdint>
#include <vector>

namespace po
{
/// The order in which a SweepScene has the spheres of a set.
class SweepOrder
{
public:
  /// Place of a sphere in the order; equal spheres follow each other, and the source makes it
  /// unique.
  struct Place
  {
    std::uint64_t morton; ///< along a curve through the brick
    unsigned source;      ///< the sphere, by its number in the set
    std::int16_t band;    ///< of radii; ascending from large to small ones, in steps of any size
    std::uint16_t brick;
  };

  /// The set must outlive this.
  explicit SweepOrder(const SphereSet& set);

  [[nodiscard]] Place placeOf(unsigned source) const;
  [[nodiscard]] bool isBefore(const Place& a, const Place& b) const;

  /// Are two spheres the same, at one place?
  [[nodiscard]] bool areEqual(unsigned a, unsigned b) const;

  /// All spheres, in order.
  [[nodiscard]] std::vector<Place> sorted() const;

private:
  const SphereSet& set_;
  float largest_ = 0;                     ///< radius
  std::array<std::int16_t, 256> bands_{}; ///< of the octaves
  std::vector<MortonCurve> curves_;       ///< by brick
};

/// Brings the spheres of a cloud into that order, so that a SweepScene needs no copy of them.
/// @param cloud without sourceIds and ghosts
/// @param particles numbers of spheres, which change with it
void sortForSweep(SphereCloud& cloud, std::vector<unsigned>& particles);
}

#endif
