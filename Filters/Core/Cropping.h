// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Cropping_h
#define po_Cropping_h

// Which particles are shown: those in ranges of values and in front of planes.

#include "SphereCloud.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace po
{
/// Keeps the points with normal . p + offset >= 0, in the coordinates of the particles.
struct HalfSpace
{
  Vec3d normal;
  double offset = 0;
};

/// Keeps the particles with low <= value <= high; NaN is in no range.
struct ValueRange
{
  std::function<double(std::int64_t)> valueOf; ///< of a particle, by its index in the input
  double low = 0, high = 0;
};

/// Particles are kept or hidden as a whole: a half-space keeps those whose centre it holds.
struct Cropping
{
  std::vector<HalfSpace> halfSpaces;
  std::vector<ValueRange> ranges;

  [[nodiscard]] bool empty() const { return halfSpaces.empty() && ranges.empty(); }
};

/// Of each sphere of the cloud 1 if anything hides it, otherwise 0; nothing at all without
/// cropping. Computed in parallel.
[[nodiscard]] std::vector<std::uint8_t> hideSpheres(
  const SphereCloud& cloud, const Cropping& cropping);
}

#endif
