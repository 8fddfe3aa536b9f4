// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteRims.h"

#include "RimFronts.h"
#include "SilhouetteEdges.h"
#include "SilhouetteTiles.h"

#include <hwy/cache_control.h>

#include <array>
#include <cstdint>

namespace po
{
namespace
{
/// The rims in front of the edges of one tile, each once: a hash table that is emptied quickly.
class RimList
{
public:
  RimList() { table_.fill({ SphereScene::None, 0 }); }

  void clear()
  {
    for (const Rim& rim : rims_)
    {
      table_[rim.slot].sphere = SphereScene::None;
    }
    rims_.clear();
  }

  /// The rim of the sphere of a number.
  Rim& find(const SphereDepth& depth, std::uint32_t sphere)
  {
    std::size_t slot = sphere % Size;
    while (table_[slot].sphere != sphere && table_[slot].sphere != SphereScene::None)
    {
      slot = (slot + 1) % Size;
    }
    Entry& entry = table_[slot];
    if (entry.sphere != sphere)
    {
      entry = { sphere, static_cast<std::uint32_t>(rims_.size()) };
      hwy::Prefetch(depth.sphereOf(sphere).sphere);
      rims_.emplace_back(sphere, slot);
    }
    return rims_[entry.place];
  }

  [[nodiscard]] std::vector<Rim>& rims() { return rims_; }

private:
  /// A power of two, larger than twice the edges that there can be.
  static constexpr std::size_t Size = 2048;
  static_assert(Size >= 2 * Rim::Side * Rim::Side);

  struct Entry
  {
    std::uint32_t sphere;
    std::uint32_t place; ///< in rims_
  };

  std::array<Entry, Size> table_{};
  std::vector<Rim> rims_;
};

/// Paints the lines of one tile after the other along the rims of spheres.
class RimPainter
{
public:
  RimPainter(const SphereDepth& depth, const SilhouetteRule& rule)
    : depth_(depth)
    , brush_(rule)
    , finder_(rule, 1)
  {
  }

  std::uint32_t paint(const SearchedTile& searched)
  {
    x_ = searched.x * DepthTileSize;
    y_ = searched.y * DepthTileSize;
    columns_ = std::min(DepthTileSize, depth_.width() - x_);
    rows_ = std::min(DepthTileSize, depth_.height() - y_);
    const PixelRange read = pixelsAround();
    depth_.prefetchSpheres(read);
    if (!finder_.find(depth_, searched.edges, read, searched.range.nearest))
    {
      return 0;
    }
    placeEdges();
    const SampleBlock& block = finder_.block();
    const RimTile tile{ x_, y_, columns_, rows_, depth_.width(), depth_.height(),
      block.depth.data(), spheres_.data(), fronts_.data(), toFront_.data(),
      block.indexOf(x_ - block.x, y_ - block.y), block.stride() };
    painted_.lines.strength.fill(0);
    placeRims(block.origin);
    brush_.paint(tile, rims_.rims(), painted_);
    return setFronts(tile, brush_.reach(), painted_);
  }

  [[nodiscard]] const TileLines& lines() const { return painted_.lines; }

private:
  /// Where the rays of the tile are expanded: the centre of the pixel in the middle.
  static constexpr double Middle = DepthTileSize / 2 + 0.5;

  /// From edges, which are as far away as lines reach, two pixels more are looked at.
  [[nodiscard]] PixelRange pixelsAround() const
  {
    const int around = brush_.reach() + 2;
    return { x_ - around, y_ - around, x_ + columns_ + around, y_ + rows_ + around };
  }

  /// Sorts the edges by the spheres in front of them.
  void placeEdges()
  {
    const SampleBlock& block = finder_.block();
    depth_.fillSpheres(block, spheres_);
    rims_.clear();
    fronts_.assign(spheres_.size(), SphereScene::None);
    toFront_.resize(spheres_.size());
    forEachEdge(finder_.groups(),
      [&](const SilhouetteEdge& edge)
      {
        const auto front = static_cast<std::size_t>(block.indexOf(edge.frontI, edge.frontJ));
        const std::uint32_t sphere = spheres_[front];
        if (sphere == SphereScene::None)
        {
          return; // a background that is placed before the spheres has no rim
        }
        const auto at = static_cast<std::size_t>(block.indexOf(edge.i, edge.j));
        fronts_[at] = sphere;
        toFront_[at] = edge.front;
        Rim& rim = rims_.find(depth_, sphere);
        const auto i = static_cast<unsigned>(block.x + edge.i - x_ + Rim::Border);
        const auto j = static_cast<unsigned>(block.y + edge.j - y_ + Rim::Border);
        rim.edges[j] |= 1U << i;
        rim.rows |= 1U << j;
      });
  }

  void placeRims(double depthOrigin)
  {
    patches_.clear();
    for (std::size_t layer = 0; layer < depth_.layerCount(); ++layer)
    {
      patches_.push_back(makeRayPatch(depth_.raysOf(layer).around(x_ + Middle, y_ + Middle)));
    }
    for (Rim& rim : rims_.rims())
    {
      const SphereDepth::NumberedSphere front = depth_.sphereOf(rim.shown);
      rim.patch = &patches_[front.layer];
      rim.squaredMoment = squaredMoment(*rim.patch, *front.sphere);
      rim.depth = static_cast<float>(rimDepth(*rim.patch, *front.sphere) - depthOrigin);
    }
  }

  const SphereDepth& depth_;
  RimBrush brush_;
  EdgeFinder finder_;
  RimList rims_;
  std::vector<RayPatch> patches_;      ///< one a layer
  std::vector<std::uint32_t> spheres_; ///< that the pixels of the block show
  // Of the pixels of the block, see RimTile.
  std::vector<std::uint32_t> fronts_;
  std::vector<std::int32_t> toFront_;
  RimLines painted_{};
  int x_ = 0, y_ = 0, columns_ = 0, rows_ = 0;
};
}

SilhouetteCounters findTracedSilhouettes(const SphereDepth& depth, const SilhouetteRule& rule,
  SilhouetteImage& image, const SilhouetteOptions& options)
{
  if (rule.samples == 1)
  {
    return findSilhouettes(depth, rule, image, options);
  }
  const auto pixels = static_cast<std::size_t>(depth.width()) * depth.height();
  image.inside.resize(options.findFronts ? pixels : 0);
  return paintTiles(
    depth, rule, RimBrush(rule).reach(), image, options, [&] { return RimPainter(depth, rule); });
}
}
