// SPDX-License-Identifier: BSD-3-Clause
#include "DepthTiles.h"

#include <algorithm>
#include <cmath>
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

void DepthTiles::build(float reach)
{
  starts_.clear();
  reach_ = reach;
  const std::size_t receivers = findExtent();
  if (receivers > 0)
  {
    layOut(receivers);
    sortIntoTiles();
  }
}

std::size_t DepthTiles::findExtent()
{
  lowX_ = lowY_ = std::numeric_limits<float>::max();
  highX_ = highY_ = std::numeric_limits<float>::lowest();
  std::size_t receivers = 0;
  for (const Member& m : members_)
  {
    if (m.sameBand)
    {
      ++receivers;
      lowX_ = std::min(lowX_, m.sphere->x);
      lowY_ = std::min(lowY_, m.sphere->y);
      highX_ = std::max(highX_, m.sphere->x);
      highY_ = std::max(highY_, m.sphere->y);
    }
  }
  return receivers;
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
  perWidth_ = 1 / width_;
  columns_ = 1 + static_cast<int>(extentX * perWidth_);
  rows_ = 1 + static_cast<int>(extentY * perWidth_);
}

std::size_t DepthTiles::homeOf(const ProjectedSphere& s) const
{
  const int column = static_cast<int>((s.x - lowX_) * perWidth_);
  const int row = static_cast<int>((s.y - lowY_) * perWidth_);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
    static_cast<std::size_t>(column);
}

DepthTiles::Range DepthTiles::tilesWithin(const ProjectedSphere& s, float reach) const
{
  // Rounding of a tile's edge must not lose a neighbour that just touches a receiver beyond it.
  const float wide = reach * (1 + 1e-5f) + width_ * 1e-5f;
  const auto first = [this](float position, int end)
  { return static_cast<int>(std::clamp(position * perWidth_, 0.0f, static_cast<float>(end))); };
  const auto last = [this](float position, int end) // one past the last, 0 left of all
  {
    const float tile = std::clamp(position * perWidth_ + 1, 0.0f, static_cast<float>(end));
    return static_cast<int>(tile);
  };
  return { first(s.x - wide - lowX_, columns_), last(s.x + wide - lowX_, columns_),
    first(s.y - wide - lowY_, rows_), last(s.y + wide - lowY_, rows_) };
}

/// Calls action(tile) for every tile whose receivers the member can hide, its own included.
template <typename Action>
void DepthTiles::visitTiles(const Member& m, Action action) const
{
  const Range range = tilesWithin(*m.sphere, m.sphere->radius + reach_);
  for (int row = range.bottom; row < range.top; ++row)
  {
    const std::size_t start = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
    for (int column = range.left; column < range.right; ++column)
    {
      const std::size_t tile = start + static_cast<std::size_t>(column);
      if (hasReceivers_[tile] != 0)
      {
        action(tile);
      }
    }
  }
}

void DepthTiles::sortIntoTiles()
{
  const auto tiles = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  hasReceivers_.assign(tiles, 0);
  for (const Member& m : members_)
  {
    if (m.sameBand)
    {
      hasReceivers_[homeOf(*m.sphere)] = 1;
    }
  }
  starts_.assign(tiles + 1, 0);
  for (const Member& m : members_)
  {
    visitTiles(m, [this](std::size_t tile) { ++starts_[tile + 1]; });
  }
  for (std::size_t tile = 0; tile < tiles; ++tile)
  {
    starts_[tile + 1] += starts_[tile];
  }
  entries_.resize(starts_[tiles]);
  next_.assign(starts_.begin(), starts_.end() - 1);
  for (const Member& m : members_)
  {
    const std::size_t home = m.sameBand ? homeOf(*m.sphere) : tiles;
    const TileRole elsewhere = m.sameBand ? TileRole::Halo : TileRole::Other;
    visitTiles(m,
      [&](std::size_t tile) {
        entries_[next_[tile]++] = { *m.sphere, tile == home ? TileRole::Receiver : elsewhere };
      });
  }
}

DepthTile DepthTiles::tile(std::size_t index) const
{
  const auto columns = static_cast<std::size_t>(columns_);
  const std::size_t row = index / columns;
  const std::size_t column = index % columns;
  return { lowX_ + static_cast<float>(column) * width_, lowY_ + static_cast<float>(row) * width_,
    width_, entries_.data() + starts_[index], entries_.data() + starts_[index + 1] };
}
}
