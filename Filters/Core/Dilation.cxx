// SPDX-License-Identifier: BSD-3-Clause
#include "Dilation.h"

#include "TexelMap.h"

#include <algorithm>

namespace po
{
namespace
{
/// Columns that row `row` has next to column `column`, seen from a row of the same texture.
std::vector<int> columnsAround(int resolution, int column, bool acrossPole)
{
  if (!acrossPole)
  {
    return { column - 1, column, column + 1 };
  }
  // With an odd number of columns the point half a turn away lies between two of them.
  const int half = resolution / 2;
  return resolution % 2 == 0
    ? std::vector<int>{ column + half - 1, column + half, column + half + 1 }
    : std::vector<int>{ column + half, column + half + 1 };
}

std::vector<std::uint32_t> neighboursOf(int resolution, int row, int column)
{
  std::vector<std::uint32_t> found;
  for (int r = row - 1; r <= row + 1; ++r)
  {
    const bool acrossPole = r < 0 || r >= resolution;
    const int inside = std::clamp(r, 0, resolution - 1);
    for (const int c : columnsAround(resolution, column, acrossPole))
    {
      const int wrapped = ((c % resolution) + resolution) % resolution;
      found.push_back(static_cast<std::uint32_t>(texelIndex(resolution, inside, wrapped)));
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  const auto self = static_cast<std::uint32_t>(texelIndex(resolution, row, column));
  found.erase(std::remove(found.begin(), found.end(), self), found.end());
  return found;
}
}

TexelNeighbours::TexelNeighbours(int resolution)
  : resolution_(resolution)
{
  neighbours_.reserve(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution));
  for (int row = 0; row < resolution; ++row)
  {
    for (int column = 0; column < resolution; ++column)
    {
      neighbours_.push_back(neighboursOf(resolution, row, column));
    }
  }
}

void dilate(const TexelNeighbours& neighbours, float* values, std::vector<std::uint8_t>& known)
{
  std::vector<std::uint32_t> unknown;
  for (std::size_t texel = 0; texel < known.size(); ++texel)
  {
    if (!known[texel])
    {
      values[texel] = 0;
      unknown.push_back(static_cast<std::uint32_t>(texel));
    }
  }
  std::vector<std::uint32_t> ring;
  while (!unknown.empty() && unknown.size() < known.size())
  {
    ring.clear();
    for (const std::uint32_t texel : unknown)
    {
      double sum = 0;
      int count = 0;
      for (const std::uint32_t neighbour : neighbours.of(texel))
      {
        if (known[neighbour])
        {
          sum += values[neighbour];
          ++count;
        }
      }
      if (count > 0)
      {
        values[texel] = static_cast<float>(sum / count);
        ring.push_back(texel);
      }
    }
    for (const std::uint32_t texel : ring)
    {
      known[texel] = 1;
    }
    unknown.erase(std::remove_if(unknown.begin(), unknown.end(),
                    [&](std::uint32_t texel) { return known[texel] != 0; }),
      unknown.end());
  }
}
}
