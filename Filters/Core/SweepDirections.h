// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SweepDirections_h
#define po_SweepDirections_h

#include "Vec3.h"

#include <cstdint>
#include <vector>

namespace po
{
/// `count` axes spread evenly over all lines through the origin, each named by one of its two unit
/// vectors: a spherical Fibonacci lattice on a hemisphere (heights in equal steps, azimuths in
/// steps of the golden angle), moved apart where it meets its opposite (up to 1024 axes), and
/// turned by a rotation that is uniform over the seeds. Together with their opposites they are 2
/// count directions of which every normal faces half.
///
/// They come in an order in which the heights of every prefix, and of every aligned run of 2^k, are
/// spread evenly (a van der Corput sequence with Owen's nested scrambling); the azimuths of a
/// prefix are no better than random ones.
[[nodiscard]] std::vector<Vec3d> sweepAxes(int count, std::uint64_t seed);

/// Two unit vectors that complete `direction` to a right-handed orthonormal frame (x, y,
/// direction).
struct PlaneBasis
{
  Vec3d x, y;
};
[[nodiscard]] PlaneBasis planeBasis(Vec3d direction);
}

#endif
