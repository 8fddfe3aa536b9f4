// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteRims.h"

#include "RimShares.h"
#include "SilhouetteEdges.h"
#include "SilhouetteTiles.h"

#include <hwy/cache_control.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace po
{
namespace
{
/// A sphere that lies in front of edges.
struct FrontSphere
{
  SphereDepth::NumberedSphere sphere;
  Rim rim;
  std::size_t slot; ///< in the table of FrontSpheres
};

/// The spheres in front of the edges of one tile, each once: a hash table that is emptied quickly.
class FrontSpheres
{
public:
  FrontSpheres() { table_.fill({ SphereScene::None, 0 }); }

  void clear()
  {
    for (const FrontSphere& one : all_)
    {
      table_[one.slot].number = SphereScene::None;
    }
    all_.clear();
  }

  /// The rim of the sphere of a number.
  Rim& find(const SphereDepth& depth, std::uint32_t number)
  {
    std::size_t slot = number % Size;
    while (table_[slot].number != number && table_[slot].number != SphereScene::None)
    {
      slot = (slot + 1) % Size;
    }
    Entry& entry = table_[slot];
    if (entry.number != number)
    {
      entry = { number, static_cast<std::uint32_t>(all_.size()) };
      FrontSphere& front = all_.emplace_back();
      front.sphere = depth.sphereOf(number);
      front.rim.number = static_cast<std::int32_t>(entry.place);
      front.rim.shown = number;
      front.slot = slot;
      hwy::Prefetch(front.sphere.sphere);
    }
    return all_[entry.place].rim;
  }

  [[nodiscard]] std::vector<FrontSphere>& all() { return all_; }

private:
  /// Twice the edges that there can be.
  static constexpr std::size_t Size =
    2 * (DepthTileSize + 2 * RimTile::Border) * (DepthTileSize + 2 * RimTile::Border);

  struct Entry
  {
    std::uint32_t number;
    std::uint32_t place; ///< in all_
  };

  std::array<Entry, Size> table_{};
  std::vector<FrontSphere> all_;
};

/// Paints the lines of one tile after the other along the rims of spheres.
class RimPainter
{
public:
  RimPainter(const SphereDepth& depth, const SilhouetteRule& rule, bool findFronts)
    : depth_(depth)
    , rule_(rule)
    , findFronts_(findFronts)
    , reach_(reachOfLines(rule))
    , finder_(rule, 1, reach_)
  {
  }

  bool paint(int tileX, int tileY, const DepthRange& range, SilhouetteImage& image)
  {
    x_ = tileX * DepthTileSize;
    y_ = tileY * DepthTileSize;
    columns_ = std::min(DepthTileSize, image.width - x_);
    rows_ = std::min(DepthTileSize, image.height - y_);
    if (!finder_.find(depth_, x_, y_, columns_, rows_, range))
    {
      return false;
    }
    const SampleBlock& block = finder_.block();
    const int first = block.indexOf(finder_.margin(), finder_.margin());
    depth_.fillSpheres(block, spheres_);
    tile_.depth = block.depth.data() + first;
    tile_.shown = spheres_.data() + first;
    tile_.pitch = block.stride();
    placeEdges(image);
    patches_.clear();
    for (std::size_t layer = 0; layer < depth_.layerCount(); ++layer)
    {
      patches_.push_back(makeRayPatch(depth_.raysOf(layer).around(x_ + Middle, y_ + Middle)));
    }
    tile_.strength.fill(0);
    bool any = false;
    for (FrontSphere& front : fronts_.all())
    {
      const RayPatch& patch = patches_[front.sphere.layer];
      front.rim.squaredMoment = squaredMoment(patch, *front.sphere.sphere);
      any |= paintRim(patch, front.rim, rule_, tile_);
    }
    if (any)
    {
      write(image);
    }
    return any;
  }

private:
  /// Where the rays of the tile are expanded: the centre of the pixel in the middle.
  static constexpr double Middle = DepthTileSize / 2 + 0.5;

  /// Puts the edges into the tile, with the spheres in front of them.
  void placeEdges(const SilhouetteImage& image)
  {
    fronts_.clear();
    const int begin = RimTile::edgeIndexOf(-reach_, -reach_);
    const int end = RimTile::edgeIndexOf(DepthTileSize + reach_, DepthTileSize + reach_);
    std::fill(
      tile_.rims.begin() + begin, tile_.rims.begin() + std::min<int>(end, tile_.rims.size()), -1);
    const SampleBlock& block = finder_.block();
    for (const SilhouetteEdge& edge : finder_.edges())
    {
      const int front = block.indexOf(edge.frontI, edge.frontJ);
      const std::uint32_t sphere = spheres_[static_cast<std::size_t>(front)];
      if (sphere == SphereScene::None)
      {
        continue; // a background that is placed before the spheres has no rim
      }
      Rim& rim = fronts_.find(depth_, sphere);
      const int i = edge.i - finder_.margin(), j = edge.j - finder_.margin();
      const auto at = static_cast<std::size_t>(RimTile::edgeIndexOf(i, j));
      tile_.rims[at] = rim.number;
      tile_.fronts[at] = edge.front;
      tile_.jumps[at] = edge.behind - edge.front;
      tile_.frontPixels[at] = block.pixelOf(edge.frontI, edge.frontJ, image.width, image.height);
      addReach(rim, i, j);
    }
  }

  /// Notes the pixels that the line of an edge can cover.
  void addReach(Rim& rim, int i, int j) const
  {
    const int first = std::max(0, i - reach_), end = std::min(columns_, i + reach_ + 1);
    const std::uint32_t bits = first < end ? (1U << end) - (1U << first) : 0;
    for (int row = std::max(0, j - reach_); row < std::min(rows_, j + reach_ + 1); ++row)
    {
      rim.pixels[static_cast<std::size_t>(row)] |= bits;
    }
  }

  void write(SilhouetteImage& image) const
  {
    for (int row = 0; row < rows_; ++row)
    {
      writeRow(tile_.strength, row, image, image.strength);
      if (findFronts_)
      {
        writeRow(tile_.inside, row, image, image.inside);
        writeRow(tile_.front, row, image, image.front);
      }
    }
  }

  template <typename T>
  void writeRow(
    const RimTile::Pixels<T>& from, int row, const SilhouetteImage& image, std::vector<T>& to) const
  {
    const T* first = from.data() + RimTile::indexOf(0, row);
    T* target = to.data() + static_cast<std::ptrdiff_t>(y_ + row) * image.width + x_;
    if (columns_ == DepthTileSize)
    {
      std::copy(first, first + DepthTileSize, target); // of a length that the compiler knows
    }
    else
    {
      std::copy(first, first + columns_, target);
    }
  }

  const SphereDepth& depth_;
  const SilhouetteRule& rule_;
  bool findFronts_;
  int reach_; ///< pixels beyond an edge that its line can cover
  EdgeFinder finder_;
  FrontSpheres fronts_;
  std::vector<RayPatch> patches_;      ///< one a layer
  std::vector<std::uint32_t> spheres_; ///< that the pixels of the block show
  int x_ = 0, y_ = 0, columns_ = 0, rows_ = 0;
  RimTile tile_{};
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
    depth, rule, image, options, [&] { return RimPainter(depth, rule, options.findFronts); });
}
}
