// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SweepDirections_h
#define po_SweepDirections_h

#include "Vec3.h"

#include <cstdint>
#include <vector>

namespace po
{
/// `count` unit vectors spread evenly over the sphere: a spherical Fibonacci lattice (heights in
/// equal steps, azimuths in steps of the golden angle), turned by a rotation that is uniform over
/// the seeds.
///
/// They come in an order whose every prefix is well spread, and so is every aligned run of 2^k: the
/// heights follow a van der Corput sequence with Owen's nested scrambling.
[[nodiscard]] std::vector<Vec3d> sweepDirections(int count, std::uint64_t seed);

/// Two unit vectors that complete `direction` to a right-handed orthonormal frame (x, y,
/// direction).
struct PlaneBasis
{
  Vec3d x, y;
};
[[nodiscard]] PlaneBasis planeBasis(Vec3d direction);
}

#endif
