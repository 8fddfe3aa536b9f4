// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_DepthTiles_h
#define po_DepthTiles_h

#include "SweepScene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace po
{
/// A sphere seen along an axis: x, y across, z along it.
struct ProjectedSphere
{
  float x, y, z, radius;
  unsigned index; ///< in the SweepScene
};

/// Of the two directions of an axis: the light comes from where z grows, or from the other side.
enum DirectionBit : std::uint8_t
{
  Upward = 1,
  Downward = 2
};

struct TileSphere
{
  ProjectedSphere sphere;
  bool receives;       ///< it is one of the tile's receivers; the others may hide these
  std::uint8_t hidden; ///< bits of the directions in which nothing of it shows
};

/// A rectangle of the projection.
struct PatchArea
{
  float lowX, lowY, highX, highY;
};

/// A square of the projection with all spheres that can hide its receivers.
struct DepthTile
{
  float x, y, width;
  const TileSphere* first;
  const TileSphere* last;

  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(last - first); }
};

/// Where the receivers of a projection lie, and how many they are.
struct ReceiverExtent
{
  float lowX = std::numeric_limits<float>::max();
  float lowY = std::numeric_limits<float>::max();
  float highX = std::numeric_limits<float>::lowest();
  float highY = std::numeric_limits<float>::lowest();
  std::size_t count = 0;

  /// Adds some that lie within a rectangle about a place.
  void add(float x, float y, float reachX, float reachY, std::size_t receivers)
  {
    // Rounding of a projection must not put one outside.
    const float slackX = 1e-6f * (std::abs(x) + reachX);
    const float slackY = 1e-6f * (std::abs(y) + reachY);
    lowX = std::min(lowX, x - reachX - slackX);
    lowY = std::min(lowY, y - reachY - slackY);
    highX = std::max(highX, x + reachX + slackX);
    highY = std::max(highY, y + reachY + slackY);
    count += receivers;
  }
};

/// The spheres of one band, as receivers, cut into square tiles; each receiver is in one tile. The
/// tiles of a patch are filled at a time, so that memory does not grow with the spheres.
class DepthTiles
{
public:
  /// Lays tiles over the receivers, and forgets those before.
  /// @param reach the largest radius of a receiver
  void layOut(const ReceiverExtent& receivers, float reach);

  [[nodiscard]] std::size_t patches() const;

  /// Empties the tiles and goes to a patch.
  void begin(std::size_t patch);

  /// Of the patch: where its receivers lie.
  [[nodiscard]] PatchArea area() const;

  /// May a sphere whose centre is up to `distance` from that place, and which is no larger than
  /// `radius`, hide a receiver of the patch, or be one?
  [[nodiscard]] bool mayReach(float x, float y, float distance, float radius) const;

  /// Adds a sphere, in the order of the indices, if it can hide a receiver of the patch or is one.
  /// @param hidden see TileSphere
  void add(const ProjectedSphere& sphere, bool sameBand, std::uint8_t hidden);

  /// Sorts what was added into the tiles of the patch.
  void sortIntoTiles();

  /// Tiles of the patch.
  [[nodiscard]] std::size_t size() const { return starts_.empty() ? 0 : starts_.size() - 1; }
  [[nodiscard]] DepthTile tile(std::size_t index) const;

private:
  struct Member
  {
    ProjectedSphere sphere;
    bool sameBand;
    std::uint8_t hidden;
    std::uint16_t left, right, bottom, top; ///< half-open range of tiles, counted in the patch
  };

  /// Half-open range of tiles.
  struct Range
  {
    int left, right, bottom, top;

    [[nodiscard]] bool isEmpty() const { return left >= right || bottom >= top; }
  };

  void choosePatches(double receivers);
  [[nodiscard]] std::size_t homeOf(const ProjectedSphere& sphere) const;
  [[nodiscard]] Range tilesWithin(float x, float y, float reach) const;
  template <typename Action>
  void visitTiles(const Member& member, Action action) const;

  std::vector<Member> members_;
  std::vector<std::uint8_t> hasReceivers_; ///< by tile
  std::vector<std::size_t> starts_;
  std::vector<std::size_t> next_;
  std::vector<TileSphere> entries_;
  float lowX_ = 0, lowY_ = 0; ///< of the receivers' centres
  float reach_ = 0;           ///< largest radius of a receiver
  float width_ = 0, perWidth_ = 0;
  int columns_ = 0, rows_ = 0;
  int patchSide_ = 1; ///< tiles
  Range patch_{};     ///< its tiles
};
}

#endif
