// SPDX-License-Identifier: BSD-3-Clause
#include "FreeLength.h"

#include "Constants.h"
#include "Random.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

namespace po
{
namespace
{
/// Edge of a cell in mean radii: so wide that particles that touch have others in their cell, and
/// so narrow that most cells of a small or thin heap lie within it.
constexpr double CellRadii = 4;
/// Where the grid begins, in cells: not where particles of a lattice lie.
constexpr double Shift = 0.381966;
/// Particles to count.
constexpr double Wanted = 1 << 16;

/// By hash of the cell.
using Counts = std::unordered_map<std::uint64_t, std::uint64_t>;

struct Counted
{
  Counts cells;
  double squares = 0; ///< sum of squared radii
};

std::uint64_t hashOf(const Vec3d& place, double cell)
{
  std::uint64_t hash = 0;
  for (const double x : { place.x, place.y, place.z })
  {
    hash = mixBits(hash ^ wordOf(std::floor(x / cell + Shift)));
  }
  return hash;
}

Counted countIn(const SphereCloud& cloud, double cell, double share)
{
  const double range = std::ldexp(share, 64);
  const auto last = range < std::ldexp(1.0, 64) ? static_cast<std::uint64_t>(range)
                                                : std::numeric_limits<std::uint64_t>::max();
  Counted counted;
  for (std::size_t i = 0; i < cloud.spheres.size(); ++i)
  {
    const bool isGhost = !cloud.ghosts.empty() && cloud.ghosts[i] != 0;
    const std::uint64_t hash = hashOf(cloud.toWorld(cloud.center(i)), cell);
    if (hash <= last && !isGhost)
    {
      const double radius = cloud.scale * cloud.spheres[i].radius;
      ++counted.cells[hash];
      counted.squares += radius * radius;
    }
  }
  return counted;
}

/// Of all processes.
Counts gatherCounts(const Counts& own, const ProcessGroup& group)
{
  ProcessGroup::Words words;
  for (const auto& [cell, count] : own)
  {
    words.push_back(cell);
    words.push_back(count);
  }
  words = group.gather(words);
  Counts all;
  for (std::size_t i = 0; i < words.size(); i += 2)
  {
    all[words[i]] += words[i + 1];
  }
  return all;
}
}

double meanFreeLength(const SphereCloud& cloud, const ParticleSet& all, const ProcessGroup& group)
{
  const double cell = CellRadii * all.meanRadius;
  const Counted own = countIn(cloud, cell, std::min(1.0, Wanted / std::max(1.0, all.count)));
  const double squares = group.sum(own.squares);
  std::uint64_t particles = 0, pairs = 0;
  for (const auto& [place, count] : gatherCounts(own.cells, group))
  {
    particles += count;
    pairs += count * (count - 1);
  }
  if (pairs == 0)
  {
    return std::numeric_limits<double>::infinity();
  }
  const auto counted = static_cast<double>(particles);
  const double density = static_cast<double>(pairs) / (counted * cell * cell * cell);
  const double crossSection = Pi * squares / counted;
  return std::max(0.0, 1 / (density * crossSection) - 4.0 / 3.0 * all.meanRadius);
}
}
