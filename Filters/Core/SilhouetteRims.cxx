// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteRims.h"

#include "RimFronts.h"
#include "SilhouetteEdges.h"
#include "SilhouetteTiles.h"

#include <hwy/cache_control.h>

#include <array>
#include <cstdint>
#include <cstring>

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

/// Edges of tiles side by side, one bit each.
class EdgeBits
{
public:
  void clear(int columns, int rows)
  {
    pitch_ = static_cast<std::size_t>(columns) / 8 + sizeof(std::uint64_t);
    bits_.assign(pitch_ * static_cast<std::size_t>(rows), 0);
  }

  void set(int i, int j)
  {
    bits_[placeOf(i, j)] |= static_cast<std::uint8_t>(1U << (static_cast<unsigned>(i) % 8));
  }

  /// The edges at i and the 31 columns behind it.
  [[nodiscard]] std::uint32_t at(int i, int j) const
  {
    std::uint64_t bits;
    std::memcpy(&bits, bits_.data() + placeOf(i, j), sizeof bits);
    return static_cast<std::uint32_t>(bits >> (static_cast<unsigned>(i) % 8));
  }

private:
  [[nodiscard]] std::size_t placeOf(int i, int j) const
  {
    return static_cast<std::size_t>(j) * pitch_ + static_cast<std::size_t>(i) / 8;
  }

  std::size_t pitch_ = 0; ///< bytes
  std::vector<std::uint8_t> bits_;
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

  void paint(const SearchedTiles& tiles, SilhouetteImage& image)
  {
    const bool any = findEdges(tiles);
    for (int x = tiles.x; x < tiles.x + tiles.count; ++x)
    {
      const std::uint32_t rows = any ? paintTile({ x, tiles.y, 1, tiles.nearest }) : 0;
      writeRows(painted_.lines, rows, x, tiles.y, image);
    }
  }

private:
  /// Where the rays of a tile are expanded: the centre of the pixel in the middle.
  static constexpr double Middle = DepthTileSize / 2 + 0.5;

  /// Finds the edges of which lines may reach into some tiles; false if there are none.
  bool findEdges(const SearchedTiles& tiles)
  {
    const PixelRange all = tiles.pixels(depth_.width(), depth_.height());
    const PixelRange lookedAt = grow(all, brush_.reach());
    // From edges two pixels more are looked at.
    const PixelRange read = grow(lookedAt, 2);
    if (!finder_.find(depth_, intersect(lookedAt, { 0, 0, depth_.width(), depth_.height() }), read,
          tiles.nearest))
    {
      return false;
    }
    placeEdges();
    return true;
  }

  /// Finds the spheres in front of the edges.
  void placeEdges()
  {
    const SampleBlock& block = finder_.block();
    depth_.fillSpheres(block, spheres_);
    edges_.clear(block.columns, block.rows);
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
        edges_.set(edge.i, edge.j);
      });
  }

  /// @return the rows that have lines, one bit each
  std::uint32_t paintTile(const SearchedTiles& searched)
  {
    const PixelRange pixels = searched.pixels(depth_.width(), depth_.height());
    const SampleBlock& block = finder_.block();
    const RimTile tile{ pixels.x0, pixels.y0, pixels.x1 - pixels.x0, pixels.y1 - pixels.y0,
      depth_.width(), depth_.height(), block.depth.data(), spheres_.data(), fronts_.data(),
      toFront_.data(), block.indexOf(pixels.x0 - block.x, pixels.y0 - block.y), block.stride() };
    listRims(tile);
    if (rims_.rims().empty())
    {
      return 0;
    }
    painted_.lines.strength.fill(0);
    placeRims(tile, block.origin);
    brush_.paint(tile, rims_.rims(), painted_);
    return setFronts(tile, brush_.reach(), painted_);
  }

  /// Sorts the edges around a tile by the spheres in front of them.
  void listRims(const RimTile& tile)
  {
    const SampleBlock& block = finder_.block();
    const int reach = brush_.reach();
    const int left = tile.x - block.x - reach, below = tile.y - block.y - reach;
    const std::uint64_t columns = (std::uint64_t(1) << (tile.columns + 2 * reach)) - 1;
    rims_.clear();
    for (int row = 0; row < tile.rows + 2 * reach; ++row)
    {
      auto edges = static_cast<std::uint32_t>(edges_.at(left, below + row) & columns);
      const auto j = static_cast<unsigned>(row + Rim::Border - reach);
      for (; edges != 0; edges &= edges - 1)
      {
        const auto column = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(edges));
        const auto at = static_cast<std::size_t>(block.indexOf(left + column, below + row));
        Rim& rim = rims_.find(depth_, fronts_[at]);
        rim.edges[j] |= 1U << static_cast<unsigned>(column + Rim::Border - reach);
        rim.rows |= 1U << j;
      }
    }
  }

  void placeRims(const RimTile& tile, double depthOrigin)
  {
    patches_.clear();
    for (std::size_t layer = 0; layer < depth_.layerCount(); ++layer)
    {
      patches_.push_back(
        makeRayPatch(depth_.raysOf(layer).around(tile.x + Middle, tile.y + Middle)));
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
  EdgeBits edges_; ///< of the pixels of the block
  RimList rims_;
  std::vector<RayPatch> patches_;      ///< one a layer
  std::vector<std::uint32_t> spheres_; ///< that the pixels of the block show
  // Of the pixels of the block, see RimTile.
  std::vector<std::uint32_t> fronts_;
  std::vector<std::int32_t> toFront_;
  RimLines painted_{};
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
