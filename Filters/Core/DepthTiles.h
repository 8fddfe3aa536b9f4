// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_DepthTiles_h
#define po_DepthTiles_h

#include "SweepScene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// A sphere seen along an axis: x, y across, z along it.
struct ProjectedSphere
{
  float x, y, z, radius;
  unsigned index; ///< in the SweepScene
};

/// What a sphere is to a tile.
enum class TileRole : std::uint8_t
{
  Receiver, ///< its centre lies in the tile
  Halo,     ///< of the tile's band, centre outside: may hide receivers
  Other,    ///< of another band: may hide receivers
};

struct TileSphere
{
  ProjectedSphere sphere;
  TileRole role;
};

/// A square of the projection with all spheres that can hide its receivers.
struct DepthTile
{
  float x, y, width;
  const TileSphere* first;
  const TileSphere* last;

  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(last - first); }
};

/// The spheres of one band, as receivers, cut into square tiles; each receiver is in one tile.
class DepthTiles
{
public:
  /// @param spheres in the order of their indices
  /// @param leftOut whether a sphere of another band can hide nothing, by its index
  template <typename LeftOut>
  void build(
    const std::vector<ProjectedSphere>& spheres, const SweepScene::Band& band, LeftOut leftOut)
  {
    members_.clear();
    for (const ProjectedSphere& s : spheres)
    {
      const bool same = s.index >= band.first && s.index < band.last;
      if (same || !leftOut(s.index))
      {
        members_.push_back({ &s, same });
      }
    }
    build(band.largestRadius);
  }

  [[nodiscard]] std::size_t size() const { return starts_.empty() ? 0 : starts_.size() - 1; }
  [[nodiscard]] DepthTile tile(std::size_t index) const;

private:
  struct Member
  {
    const ProjectedSphere* sphere;
    bool sameBand;
  };

  /// Half-open range of tiles.
  struct Range
  {
    int left, right, bottom, top;
  };

  void build(float reach);
  std::size_t findExtent();
  void layOut(std::size_t receivers);
  void sortIntoTiles();
  [[nodiscard]] std::size_t homeOf(const ProjectedSphere& sphere) const;
  [[nodiscard]] Range tilesWithin(const ProjectedSphere& sphere, float reach) const;
  template <typename Action>
  void visitTiles(const Member& member, Action action) const;

  std::vector<Member> members_;
  std::vector<std::uint8_t> hasReceivers_; ///< by tile
  std::vector<std::size_t> starts_;
  std::vector<std::size_t> next_;
  std::vector<TileSphere> entries_;
  float lowX_ = 0, lowY_ = 0, highX_ = 0, highY_ = 0; ///< of the receivers' centres
  float reach_ = 0;                                   ///< largest radius of a receiver
  float width_ = 0, perWidth_ = 0;
  int columns_ = 0, rows_ = 0;
};
}

#endif
