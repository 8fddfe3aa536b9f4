// SPDX-License-Identifier: BSD-3-Clause
#include "SweepDirections.h"

#include "Constants.h"
#include "Random.h"
#include "Sampling.h"

#include <cmath>

namespace po
{
namespace
{
/// A rotation matrix by its columns.
struct Rotation
{
  Vec3d x, y, z;

  [[nodiscard]] Vec3d apply(Vec3d v) const { return v.x * x + v.y * y + v.z * z; }
};

/// Uniform over all rotations: from a uniform unit quaternion (Shoemake 1992).
Rotation randomRotation(Random& random)
{
  const double u = random.uniform();
  const double alpha = 2 * Pi * random.uniform();
  const double beta = 2 * Pi * random.uniform();
  const double a = std::sqrt(1 - u) * std::sin(alpha);
  const double b = std::sqrt(1 - u) * std::cos(alpha);
  const double c = std::sqrt(u) * std::sin(beta);
  const double d = std::sqrt(u) * std::cos(beta);
  return { { 1 - 2 * (b * b + c * c), 2 * (a * b + c * d), 2 * (a * c - b * d) },
    { 2 * (a * b - c * d), 1 - 2 * (a * a + c * c), 2 * (b * c + a * d) },
    { 2 * (a * c + b * d), 2 * (b * c - a * d), 1 - 2 * (a * a + b * b) } };
}

/// Number `index` of a van der Corput sequence of `bits` bits, times 2^bits: every bit of the
/// result is flipped or not by a hash of the bits above it, which is Owen's scrambling.
std::uint32_t scrambledVanDerCorput(std::uint32_t index, int bits, std::uint64_t seed)
{
  std::uint32_t result = 0;
  for (int bit = 0; bit < bits; ++bit)
  {
    const std::uint64_t above = result | (std::uint64_t(1) << bit); // unique for each node
    const auto flip = static_cast<std::uint32_t>(mixBits(seed ^ mixBits(above)) & 1);
    result = (result << 1) | (((index >> bit) & 1) ^ flip);
  }
  return result;
}

/// Of a lattice on the upper hemisphere.
Vec3d fibonacciPoint(std::uint32_t index, int count)
{
  const double golden = Pi * (3 - std::sqrt(5.0));
  const double z = 1 - (index + 0.5) / count;
  const double radius = std::sqrt((1 - z) * (1 + z));
  const double azimuth = std::fmod(golden * index, 2 * Pi);
  return { radius * std::cos(azimuth), radius * std::sin(azimuth), z };
}
}

std::vector<Vec3d> sweepAxes(int count, std::uint64_t seed)
{
  Random random(seed, 0, 0);
  const Rotation rotation = randomRotation(random);
  int bits = 0;
  while ((std::int64_t(1) << bits) < count)
  {
    ++bits;
  }
  std::vector<Vec3d> axes;
  axes.reserve(static_cast<std::size_t>(count));
  for (std::uint32_t k = 0; k < (std::uint64_t(1) << bits); ++k)
  {
    const std::uint32_t index = scrambledVanDerCorput(k, bits, mixBits(seed + 1));
    if (index < static_cast<std::uint32_t>(count))
    {
      axes.push_back(normalized(rotation.apply(fibonacciPoint(index, count))));
    }
  }
  return axes;
}

PlaneBasis planeBasis(Vec3d direction)
{
  return { aboutNormal(direction, { 1, 0, 0 }), aboutNormal(direction, { 0, 1, 0 }) };
}
}
