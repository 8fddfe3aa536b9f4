// SPDX-License-Identifier: BSD-3-Clause
#include "DepthTiles.h"

#include <cmath>

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
/// Spheres a patch should hold: 100 bytes each, for every thread. The more patches there are the
/// more often spheres near their edges, and the bounds of all, are looked at.
constexpr double WantedPatches = 16;
constexpr double FewestPerPatch = 1 << 16;
constexpr double MostPerPatch = 1 << 17;
}

void DepthTiles::layOut(const ReceiverExtent& receivers, float reach)
{
  columns_ = rows_ = 0;
  if (receivers.count == 0)
  {
    return;
  }
  reach_ = reach;
  lowX_ = receivers.lowX;
  lowY_ = receivers.lowY;
  const float extentX = receivers.highX - receivers.lowX;
  const float extentY = receivers.highY - receivers.lowY;
  const double area = static_cast<double>(extentX) * extentY;
  const auto count = static_cast<double>(receivers.count);
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
  choosePatches(count);
}

void DepthTiles::choosePatches(double receivers)
{
  const double perTile = std::max(1.0, receivers / (static_cast<double>(columns_) * rows_));
  const double perPatch = std::clamp(receivers / WantedPatches, FewestPerPatch, MostPerPatch);
  patchSide_ = std::max(1, static_cast<int>(std::sqrt(perPatch / perTile)));
}

std::size_t DepthTiles::patches() const
{
  const auto along = [this](int tiles)
  { return static_cast<std::size_t>((tiles + patchSide_ - 1) / patchSide_); };
  return along(columns_) * along(rows_);
}

void DepthTiles::begin(std::size_t patch)
{
  const int across = (columns_ + patchSide_ - 1) / patchSide_;
  const int left = static_cast<int>(patch % static_cast<std::size_t>(across)) * patchSide_;
  const int bottom = static_cast<int>(patch / static_cast<std::size_t>(across)) * patchSide_;
  patch_ = { left, std::min(left + patchSide_, columns_), bottom,
    std::min(bottom + patchSide_, rows_) };
  members_.clear();
}

PatchArea DepthTiles::area() const
{
  const auto at = [this](float low, int tile) { return low + static_cast<float>(tile) * width_; };
  return { at(lowX_, patch_.left), at(lowY_, patch_.bottom), at(lowX_, patch_.right),
    at(lowY_, patch_.top) };
}

std::size_t DepthTiles::homeOf(const ProjectedSphere& s) const
{
  const int column = static_cast<int>((s.x - lowX_) * perWidth_);
  const int row = static_cast<int>((s.y - lowY_) * perWidth_);
  const bool isHere =
    column >= patch_.left && column < patch_.right && row >= patch_.bottom && row < patch_.top;
  const int place = (row - patch_.bottom) * (patch_.right - patch_.left) + column - patch_.left;
  return isHere ? static_cast<std::size_t>(place) : hasReceivers_.size();
}

/// Those of the patch that a square around a place meets.
DepthTiles::Range DepthTiles::tilesWithin(float x, float y, float reach) const
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
  return { std::max(patch_.left, first(x - wide - lowX_, columns_)),
    std::min(patch_.right, last(x + wide - lowX_, columns_)),
    std::max(patch_.bottom, first(y - wide - lowY_, rows_)),
    std::min(patch_.top, last(y + wide - lowY_, rows_)) };
}

bool DepthTiles::mayReach(float x, float y, float distance, float radius) const
{
  // Rounding of either place must not lose a sphere.
  const float slack = 1e-6f * (std::abs(x) + std::abs(y) + distance);
  return !tilesWithin(x, y, distance + slack + radius + reach_).isEmpty();
}

void DepthTiles::add(const ProjectedSphere& sphere, bool sameBand, std::uint8_t hidden)
{
  const Range range = tilesWithin(sphere.x, sphere.y, sphere.radius + reach_);
  if (!range.isEmpty())
  {
    const auto inPatch = [](int tile, int first)
    { return static_cast<std::uint16_t>(tile - first); };
    members_.push_back({ sphere, sameBand, hidden, inPatch(range.left, patch_.left),
      inPatch(range.right, patch_.left), inPatch(range.bottom, patch_.bottom),
      inPatch(range.top, patch_.bottom) });
  }
}

/// Calls action(tile) for every tile of the patch whose receivers the member can hide, its own
/// included.
template <typename Action>
void DepthTiles::visitTiles(const Member& m, Action action) const
{
  const auto columns = static_cast<std::size_t>(patch_.right - patch_.left);
  for (std::size_t row = m.bottom; row < m.top; ++row)
  {
    for (std::size_t tile = row * columns + m.left; tile < row * columns + m.right; ++tile)
    {
      if (hasReceivers_[tile] != 0)
      {
        action(tile);
      }
    }
  }
}

void DepthTiles::sortIntoTiles()
{
  const auto tiles = static_cast<std::size_t>(patch_.right - patch_.left) *
    static_cast<std::size_t>(patch_.top - patch_.bottom);
  hasReceivers_.assign(tiles, 0);
  for (const Member& m : members_)
  {
    const std::size_t home = m.sameBand ? homeOf(m.sphere) : tiles;
    if (home < tiles)
    {
      hasReceivers_[home] = 1;
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
    const std::size_t home = m.sameBand ? homeOf(m.sphere) : tiles;
    visitTiles(m,
      [&](std::size_t tile) {
        entries_[next_[tile]++] = { m.sphere, tile == home, m.hidden };
      });
  }
}

DepthTile DepthTiles::tile(std::size_t index) const
{
  const auto columns = static_cast<std::size_t>(patch_.right - patch_.left);
  const std::size_t row = index / columns + static_cast<std::size_t>(patch_.bottom);
  const std::size_t column = index % columns + static_cast<std::size_t>(patch_.left);
  return { lowX_ + static_cast<float>(column) * width_, lowY_ + static_cast<float>(row) * width_,
    width_, entries_.data() + starts_[index], entries_.data() + starts_[index + 1] };
}
}
