// SPDX-License-Identifier: BSD-3-Clause
#include "SweepDirections.h"

#include "Constants.h"
#include "Random.h"
#include "Sampling.h"

#include <algorithm>
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

/// Beyond so many axes little is gained, and time grows with the square: 0.1 s there.
constexpr std::size_t MostSpread = 1024;
/// Nine tenths of what there is to gain, with this length of the steps.
constexpr int SpreadSteps = 20;
constexpr double StepLength = 3;

/// Moves axes apart until the sum of the distances of all pairs of directions, both of each axis,
/// is nearly the largest. The discrepancy of directions over all caps of the sphere is least then
/// (Stolarsky 1973), and with it the error of the mean of what caps hide. Where a lattice meets its
/// own opposite it has a seam: without it that discrepancy falls by a tenth.
void spreadApart(std::vector<Vec3d>& axes)
{
  if (axes.size() > MostSpread)
  {
    return;
  }
  // Of axes a and b, with c = a . b, the distances are sqrt(2 - 2 c) and sqrt(2 + 2 c).
  const auto slope = [](double c)
  {
    constexpr double least = 1e-12;
    return 1 / std::sqrt(std::max(2 + 2 * c, least)) - 1 / std::sqrt(std::max(2 - 2 * c, least));
  };
  std::vector<Vec3d> pulls(axes.size());
  for (int step = 0; step < SpreadSteps; ++step)
  {
    std::fill(pulls.begin(), pulls.end(), Vec3d());
    for (std::size_t i = 0; i < axes.size(); ++i)
    {
      for (std::size_t k = i + 1; k < axes.size(); ++k)
      {
        const double pull = slope(dot(axes[i], axes[k]));
        pulls[i] = pulls[i] + pull * axes[k];
        pulls[k] = pulls[k] + pull * axes[i];
      }
    }
    for (std::size_t i = 0; i < axes.size(); ++i)
    {
      const Vec3d across = pulls[i] - dot(pulls[i], axes[i]) * axes[i];
      axes[i] = normalized(axes[i] + (StepLength / static_cast<double>(axes.size())) * across);
    }
  }
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
  std::vector<Vec3d> spread;
  for (int i = 0; i < count; ++i)
  {
    spread.push_back(fibonacciPoint(static_cast<std::uint32_t>(i), count));
  }
  spreadApart(spread);
  std::vector<Vec3d> axes;
  axes.reserve(spread.size());
  for (std::uint32_t k = 0; k < (std::uint64_t(1) << bits); ++k)
  {
    const std::uint32_t index = scrambledVanDerCorput(k, bits, mixBits(seed + 1));
    if (index < static_cast<std::uint32_t>(count))
    {
      axes.push_back(normalized(rotation.apply(spread[index])));
    }
  }
  return axes;
}

PlaneBasis planeBasis(Vec3d direction)
{
  return { aboutNormal(direction, { 1, 0, 0 }), aboutNormal(direction, { 0, 1, 0 }) };
}
}
