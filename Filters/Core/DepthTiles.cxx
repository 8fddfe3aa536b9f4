// SPDX-License-Identifier: BSD-3-Clause
#include "DepthTiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace po
{
namespace
{
/// Spheres a tile should hold: few enough for the cache, many enough that the halo is small.
constexpr double SpheresPerTile = 4096;
/// In radii of the largest receiver: the halo, two radii on each side, stays a small part.
constexpr float SmallestTileWidth = 16;
constexpr float LargestTileWidth = 60; ///< so that the cells stay small
constexpr double MostTilesPerSphere = 4;
}

RadiusOctaves::RadiusOctaves(const std::vector<Sphere>& spheres)
  : octaveOf_(spheres.size())
{
  if (spheres.empty())
  {
    return;
  }
  const auto [smallest, largest] = std::minmax_element(spheres.begin(), spheres.end(),
    [](const Sphere& a, const Sphere& b) { return a.radius < b.radius; });
  // Counted down from the largest sphere: equal radii must never fall on both sides of an edge.
  const float top = largest->radius;
  const auto below = [top](float radius)
  { return static_cast<int>(std::min(255.0f, std::floor(std::log2(top / radius)))); };
  const int count = below(smallest->radius) + 1;
  std::vector<float> radius(static_cast<std::size_t>(count), 0.0f);
  for (std::size_t i = 0; i < spheres.size(); ++i)
  {
    const int octave = count - 1 - below(spheres[i].radius);
    octaveOf_[i] = static_cast<std::uint8_t>(octave);
    float& r = radius[static_cast<std::size_t>(octave)];
    r = std::max(r, spheres[i].radius);
  }
  std::vector<std::uint8_t> number(radius.size());
  for (std::size_t octave = 0; octave < radius.size(); ++octave)
  {
    number[octave] = static_cast<std::uint8_t>(largestRadius_.size());
    if (radius[octave] > 0)
    {
      largestRadius_.push_back(radius[octave]);
    }
  }
  for (std::uint8_t& octave : octaveOf_)
  {
    octave = number[octave];
  }
}

void DepthTiles::build(const std::vector<ProjectedSphere>& spheres, const RadiusOctaves& octaves,
  std::size_t octave, const std::vector<std::uint8_t>& hidden)
{
  members_.clear();
  starts_.clear();
  reach_ = octaves.largestRadius(octave);
  lowX_ = lowY_ = std::numeric_limits<float>::max();
  highX_ = highY_ = std::numeric_limits<float>::lowest();
  std::size_t receivers = 0;
  for (const ProjectedSphere& s : spheres)
  {
    const bool same = octaves.of(s.id) == octave;
    if (same)
    {
      ++receivers;
      lowX_ = std::min(lowX_, s.x);
      lowY_ = std::min(lowY_, s.y);
      highX_ = std::max(highX_, s.x);
      highY_ = std::max(highY_, s.y);
    }
    if (same || hidden[s.id] == 0)
    {
      members_.push_back({ &s, same });
    }
  }
  if (receivers > 0)
  {
    layOut(receivers);
    sortIntoTiles();
  }
}

void DepthTiles::layOut(std::size_t receivers)
{
  const float extentX = highX_ - lowX_;
  const float extentY = highY_ - lowY_;
  const double area = static_cast<double>(extentX) * extentY;
  const auto count = static_cast<double>(receivers);
  const auto wanted = static_cast<float>(std::sqrt(area * SpheresPerTile / count));
  // A stray sphere far away must not make the tiles so wide that all others share one, as long as
  // the number of tiles stays in proportion to the spheres.
  const auto fewEnough = static_cast<float>(std::sqrt(area / (MostTilesPerSphere * count)));
  const float longest = std::max(extentX, extentY) / static_cast<float>(count + 1);
  width_ = std::max({ std::clamp(wanted, SmallestTileWidth * reach_, LargestTileWidth * reach_),
    fewEnough, longest });
  columns_ = 1 + static_cast<int>(extentX / width_);
  rows_ = 1 + static_cast<int>(extentY / width_);
}

DepthTiles::Range DepthTiles::tilesWithin(const ProjectedSphere& s, float reach) const
{
  const auto clamped = [this](float position, int end)
  {
    const float tile = std::floor(position / width_);
    return static_cast<int>(std::clamp(tile, -1.0f, static_cast<float>(end)));
  };
  return { std::max(0, clamped(s.x - reach - lowX_, columns_)),
    std::min(columns_, clamped(s.x + reach - lowX_, columns_) + 1),
    std::max(0, clamped(s.y - reach - lowY_, rows_)),
    std::min(rows_, clamped(s.y + reach - lowY_, rows_) + 1) };
}

void DepthTiles::sortIntoTiles()
{
  const auto tiles = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  const auto tileAt = [this](int column, int row)
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
      static_cast<std::size_t>(column);
  };
  hasReceivers_.assign(tiles, 0);
  for (const Member& m : members_)
  {
    if (m.sameOctave)
    {
      const Range home = tilesWithin(*m.sphere, 0);
      hasReceivers_[tileAt(home.left, home.bottom)] = 1;
    }
  }
  const auto visit = [&](const Member& m, auto&& action)
  {
    const Range range = tilesWithin(*m.sphere, m.sphere->radius + reach_);
    for (int row = range.bottom; row < range.top; ++row)
    {
      for (int column = range.left; column < range.right; ++column)
      {
        if (hasReceivers_[tileAt(column, row)] != 0)
        {
          action(column, row);
        }
      }
    }
  };
  starts_.assign(tiles + 1, 0);
  for (const Member& m : members_)
  {
    visit(m, [&](int column, int row) { ++starts_[tileAt(column, row) + 1]; });
  }
  for (std::size_t tile = 0; tile < tiles; ++tile)
  {
    starts_[tile + 1] += starts_[tile];
  }
  entries_.resize(starts_[tiles]);
  std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
  for (const Member& m : members_)
  {
    const Range home = tilesWithin(*m.sphere, 0);
    visit(m,
      [&](int column, int row)
      {
        const bool own = m.sameOctave && column == home.left && row == home.bottom;
        const TileRole role =
          own ? TileRole::Receiver : (m.sameOctave ? TileRole::Halo : TileRole::Other);
        entries_[next[tileAt(column, row)]++] = { *m.sphere, role };
      });
  }
}

DepthTile DepthTiles::tile(std::size_t index) const
{
  const auto columns = static_cast<std::size_t>(columns_);
  return { lowX_ + static_cast<float>(index % columns) * width_,
    lowY_ + static_cast<float>(index / columns) * width_, width_, entries_.data() + starts_[index],
    entries_.data() + starts_[index + 1] };
}

void sortByDepth(
  const DepthTile& tile, std::vector<std::uint64_t>& scratch, std::vector<std::uint32_t>& order)
{
  const auto count = static_cast<std::size_t>(tile.last - tile.first);
  scratch.resize(count);
  order.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &tile.first[i].sphere.z, sizeof(bits));
    // Floats sort like integers once negative ones are inverted; downward, so inverted again.
    const std::uint32_t key = (bits & 0x80000000u) != 0 ? bits : ~(bits | 0x80000000u);
    scratch[i] = (std::uint64_t(key) << 32) | i;
  }
  std::sort(scratch.begin(), scratch.end());
  std::transform(scratch.begin(), scratch.end(), order.begin(),
    [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
}
}
