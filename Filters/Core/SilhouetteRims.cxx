// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteRims.h"

#include "RimShares.h"
#include "SilhouetteEdges.h"
#include "SilhouetteTiles.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace po
{
namespace
{
/// The rims of one tile that were met so far.
class RimCache
{
public:
  RimCache() { entries_.fill({ nullptr, 0 }); }

  void begin()
  {
    for (const Rim& rim : rims_)
    {
      entries_[slotOf(rim.sphere)] = { nullptr, 0 };
    }
    rims_.clear();
  }

  /// Number of a sphere's rim in rims().
  int numberOf(const RayPatch& patch, const Sphere& sphere)
  {
    Entry& entry = entries_[slotOf(&sphere)];
    if (entry.sphere != &sphere)
    {
      entry = { &sphere, static_cast<int>(rims_.size()) };
      rims_.push_back(makeRim(patch, sphere));
    }
    return entry.number;
  }

  [[nodiscard]] const std::vector<Rim>& rims() const { return rims_; }

private:
  static constexpr std::size_t Size = 256;

  struct Entry
  {
    const Sphere* sphere;
    int number;
  };

  static std::size_t slotOf(const Sphere* sphere)
  {
    return reinterpret_cast<std::uintptr_t>(sphere) / sizeof(Sphere) % Size;
  }

  std::array<Entry, Size> entries_;
  std::vector<Rim> rims_;
};

/// Paints the lines of one tile after the other along the rims of spheres.
class RimPainter
{
public:
  RimPainter(const TracedDepth& depth, const SilhouetteRule& rule, bool findFronts)
    : depth_(depth)
    , rule_(rule)
    , findFronts_(findFronts)
    , reach_(static_cast<int>(std::ceil(rule.maximumWidth)))
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
    cache_.begin();
    patches_.clear();
    work_.resize(depth_.layers().size());
    for (const TracedLayer& layer : depth_.layers())
    {
      work_[patches_.size()].count = 0;
      patches_.push_back(makeRayPatch(layer.rays.around(x_ + Middle, y_ + Middle)));
    }
    painted_.fill(nullptr);
    for (const SilhouetteEdge& edge : finder_.edges())
    {
      addEdge(edge, image);
    }
    clearTile(image, tileX, tileY);
    for (std::size_t layer = 0; layer < work_.size(); ++layer)
    {
      findShares(patches_[layer], cache_.rims(), work_[layer]);
      write(work_[layer], image);
    }
    return true;
  }

private:
  /// Where the rays of the tile are expanded: the centre of the pixel in the middle.
  static constexpr double Middle = DepthTileSize / 2 + 0.5;

  /// A line: behind an edge, along the rim of a sphere.
  struct Line
  {
    const Sphere* sphere;
    std::size_t layer;
    float front;  ///< depth before the jump
    float behind; ///< and after it
    int rim;
    std::int32_t frontPixel;
  };

  /// Notes all pixels that the line of an edge can cover.
  void addEdge(const SilhouetteEdge& edge, const SilhouetteImage& image)
  {
    const SampleBlock& block = finder_.block();
    const int frontPixel = block.pixelOf(edge.front, image.width, image.height);
    const TracedLayer& layer = depth_.layerAt(static_cast<std::size_t>(frontPixel));
    const Sphere& sphere = layer.spheres[layer.frame.sphere[static_cast<std::size_t>(frontPixel)]];
    const auto number = static_cast<std::size_t>(&layer - depth_.layers().data());
    const Line line{ &sphere, number, block.depth[static_cast<std::size_t>(edge.front)],
      block.depth[static_cast<std::size_t>(edge.behind)], cache_.numberOf(patches_[number], sphere),
      frontPixel };
    const int i = edge.behind % block.columns - finder_.margin();
    const int j = edge.behind / block.columns - finder_.margin();
    for (int v = std::max(0, j - reach_); v < std::min(rows_, j + reach_ + 1); ++v)
    {
      for (int u = std::max(0, i - reach_); u < std::min(columns_, i + reach_ + 1); ++u)
      {
        const bool isEdge = u == i && v == j;
        if (isEdge || painted_[static_cast<std::size_t>(v * DepthTileSize + u)] != &sphere)
        {
          addPixel(line, u, v, isEdge, image.width);
        }
      }
    }
  }

  void addPixel(const Line& line, int u, int v, bool isEdge, int width)
  {
    const float behind = isEdge ? line.behind : depthBehind(line, u, v, width);
    const float jump = behind - line.front;
    const bool isOutline = jump == std::numeric_limits<float>::infinity();
    if (!isEdge &&
      (!(jump > static_cast<float>(rule_.jump)) || (isOutline && !rule_.backgroundLines)))
    {
      return;
    }
    const int at = v * DepthTileSize + u;
    painted_[static_cast<std::size_t>(at)] = line.sphere;
    const float ramp = rule_.ramp.at(jump);
    work_[line.layer].add({ line.rim, at, static_cast<float>(u - DepthTileSize / 2),
      static_cast<float>(v - DepthTileSize / 2),
      static_cast<float>(rule_.width + ramp * (rule_.maximumWidth - rule_.width)),
      rule_.greyByJump ? ramp : 1, isEdge, line.frontPixel });
  }

  /// Depth of what lies behind the sphere at pixel (u, v). Pixels of the sphere itself are covered
  /// in part, by what lies behind it at the edge.
  [[nodiscard]] float depthBehind(const Line& line, int u, int v, int width) const
  {
    const std::size_t pixel = static_cast<std::size_t>(y_ + v) * width + x_ + u;
    const TracedLayer& layer = depth_.layerAt(pixel);
    const std::uint32_t shown = layer.frame.sphere[pixel];
    const bool isFront = shown != SphereScene::None && line.sphere == &layer.spheres[shown];
    const int margin = finder_.margin();
    const auto at = (v + margin) * finder_.block().columns + u + margin;
    return isFront ? line.behind : finder_.block().depth[static_cast<std::size_t>(at)];
  }

  void write(const RimWork& work, SilhouetteImage& image) const
  {
    for (std::size_t i = 0; i < work.count; ++i)
    {
      const std::size_t pixel =
        static_cast<std::size_t>(y_ + work.pixels[i] / DepthTileSize) * image.width + x_ +
        work.pixels[i] % DepthTileSize;
      if (work.strengths[i] > image.strength[pixel])
      {
        image.strength[pixel] = work.strengths[i];
        if (findFronts_)
        {
          image.front[pixel] = work.frontPixels[i];
          image.inside[pixel] = work.insides[i];
        }
      }
    }
  }

  const TracedDepth& depth_;
  const SilhouetteRule& rule_;
  bool findFronts_;
  int reach_; ///< pixels beyond an edge that its line can cover
  EdgeFinder finder_;
  RimCache cache_;
  std::vector<RimWork> work_;     ///< one a layer
  std::vector<RayPatch> patches_; ///< one a layer
  int x_ = 0, y_ = 0, columns_ = 0, rows_ = 0;
  std::array<const Sphere*, DepthTileSize * DepthTileSize> painted_{}; ///< whose line was last
};
}

SilhouetteCounters findTracedSilhouettes(const TracedDepth& depth, const SilhouetteRule& rule,
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
