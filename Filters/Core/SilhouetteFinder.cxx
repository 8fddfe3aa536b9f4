// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteFinder.h"

#include "SilhouetteEdges.h"
#include "SilhouetteTiles.h"

#include <cmath>
#include <utility>

namespace po
{
namespace
{
constexpr float InfinityF = std::numeric_limits<float>::infinity();

/// Paints the lines of one tile after the other from samples.
class SamplePainter
{
public:
  SamplePainter(const DepthSource& source, const SilhouetteRule& rule, bool findFronts)
    : source_(source)
    , rule_(rule)
    , findFronts_(findFronts)
    , spreads_(rule.samples > 1 || rule.maximumWidth > 1)
    , finder_(rule, rule.samples, spreads_ ? reachOf(rule) : 0)
  {
  }

  bool paint(int tileX, int tileY, const DepthRange& range, SilhouetteImage& image)
  {
    const int x = tileX * DepthTileSize, y = tileY * DepthTileSize;
    const int columns = std::min(DepthTileSize, image.width - x);
    const int rows = std::min(DepthTileSize, image.height - y);
    if (!finder_.find(source_, x, y, columns, rows, range))
    {
      return false;
    }
    if (!spreads_)
    {
      writeEdges(x, y, image);
      return true;
    }
    cover_.assign(finder_.block().depth.size(), InfinityF);
    fronts_.resize(findFronts_ ? cover_.size() : 0);
    spread_.assign(cover_.size(), 0);
    for (const SilhouetteEdge& edge : finder_.edges())
    {
      cover(finder_.block().indexOf(edge.i, edge.j), frontOf(edge));
      spread(edge);
    }
    writeStrength(x, y, columns, rows, image);
    return true;
  }

private:
  /// Pixels from which a line can reach into a tile.
  static int reachOf(const SilhouetteRule& rule)
  {
    return static_cast<int>(std::ceil(rule.maximumWidth)) + (rule.samples == 1 ? 2 : 1);
  }

  /// Lines of one pixel: the edges themselves.
  void writeEdges(int x, int y, SilhouetteImage& image) const
  {
    const SampleBlock& block = finder_.block();
    clearTile(image, x / DepthTileSize, y / DepthTileSize);
    for (const SilhouetteEdge& edge : finder_.edges())
    {
      const int pixel = block.pixelOf(edge.i, edge.j, image.width, image.height);
      image.strength[static_cast<std::size_t>(pixel)] =
        rule_.greyByJump ? rule_.ramp.at(edge.behind - edge.front) : 1;
      if (findFronts_)
      {
        image.front[static_cast<std::size_t>(pixel)] =
          block.pixelOf(edge.frontI, edge.frontJ, image.width, image.height);
      }
    }
  }

  [[nodiscard]] int frontOf(const SilhouetteEdge& edge) const
  {
    return finder_.block().indexOf(edge.frontI, edge.frontJ);
  }

  void cover(int behind, int front)
  {
    const float depth = finder_.block().depth[static_cast<std::size_t>(front)];
    if (depth < cover_[static_cast<std::size_t>(behind)])
    {
      cover_[static_cast<std::size_t>(behind)] = depth;
      if (findFronts_)
      {
        fronts_[static_cast<std::size_t>(behind)] = front;
      }
    }
  }

  /// Covers the disc of a line's width about the front sample, as far as it lies behind it.
  void spread(const SilhouetteEdge& edge)
  {
    const float growth = rule_.ramp.at(edge.jump);
    const double width = rule_.width + growth * (rule_.maximumWidth - rule_.width);
    // The rim of the front lies, in the mean, half a sample beyond its last sample.
    const double radius = width * rule_.samples + 0.5;
    const int front = frontOf(edge);
    float& done = spread_[static_cast<std::size_t>(front)];
    if (static_cast<float>(radius) <= done)
    {
      return; // for another sample behind the same front
    }
    done = static_cast<float>(radius);
    const int height = static_cast<int>(radius);
    for (int dj = -height; dj <= height; ++dj)
    {
      const int half = static_cast<int>(std::sqrt(radius * radius - dj * dj));
      coverRow(front, edge.frontI, edge.frontJ + dj, half);
    }
  }

  void coverRow(int front, int frontI, int j, int half)
  {
    const SampleBlock& block = finder_.block();
    if (j < 0 || j >= block.rows * block.samples)
    {
      return;
    }
    const int start = j * block.stride();
    const int begin = start + std::max(0, frontI - half);
    const int end = start + std::min(block.stride(), frontI + half + 1);
    const float behind =
      block.depth[static_cast<std::size_t>(front)] + static_cast<float>(rule_.jump);
    const float farthest = rule_.backgroundLines ? InfinityF : std::numeric_limits<float>::max();
    for (int at = begin; at < end; ++at)
    {
      const float depth = block.depth[static_cast<std::size_t>(at)];
      if (depth > behind && depth <= farthest)
      {
        cover(at, front);
      }
    }
  }

  /// The line in one pixel.
  struct PixelLine
  {
    float covered = 0;  ///< number of samples
    float strength = 0; ///< sum over them
    float farthest = 0; ///< depth in front of one of them
    int front = -1;     ///< sample in front of one of them
  };

  void writeStrength(int x, int y, int columns, int rows, SilhouetteImage& image) const
  {
    for (int j = 0; j < rows; ++j)
    {
      for (int i = 0; i < columns; ++i)
      {
        const std::size_t pixel = static_cast<std::size_t>(y + j) * image.width + x + i;
        const PixelLine line = lineIn(i, j);
        image.strength[pixel] = line.strength / static_cast<float>(rule_.samples * rule_.samples);
        if (findFronts_ && line.front >= 0)
        {
          writeFront(i, j, line, pixel, image);
        }
      }
    }
  }

  [[nodiscard]] PixelLine lineIn(int i, int j) const
  {
    PixelLine line;
    forEachSample(i, j, 0, rule_.samples,
      [&](std::size_t at)
      {
        const float nearest = cover_[at];
        if (nearest < InfinityF)
        {
          const float jump = finder_.block().depth[at] - nearest;
          line.strength += rule_.greyByJump ? rule_.ramp.at(jump) : 1;
          line.covered += 1;
          line.farthest = std::max(line.farthest, nearest);
          line.front = findFronts_ ? fronts_[at] : -1;
        }
      });
    return line;
  }

  /// Calls f for samples [first, end) x [first, end) of pixel (i, j) of the tile.
  template <typename Function>
  void forEachSample(int i, int j, int first, int end, const Function& f) const
  {
    const int margin = finder_.margin(), samples = rule_.samples;
    for (int dj = first; dj < end; ++dj)
    {
      const int row = (margin + j) * samples + dj;
      const int at = finder_.block().indexOf((margin + i) * samples, row);
      for (int di = first; di < end; ++di)
      {
        f(static_cast<std::size_t>(at + di));
      }
    }
  }

  /// The pixel in front of a line, one of those around it that show it at their centre, and what it
  /// covers of the pixel of the line where that shows what is behind.
  void writeFront(
    int i, int j, const PixelLine& line, std::size_t pixel, SilhouetteImage& image) const
  {
    image.front[pixel] = pixelOf(line.front, image);
    if (rule_.samples == 1)
    {
      return;
    }
    image.inside[pixel] = 0;
    const float behind = line.farthest + static_cast<float>(rule_.jump);
    if (showsFront(i, j, behind))
    {
      image.front[pixel] = static_cast<std::int32_t>(pixel);
      return;
    }
    const int front = pixelThatShows(i, j, behind, image);
    if (front >= 0)
    {
      float uncovered = 0;
      forEachSample(i, j, 0, rule_.samples,
        [&](std::size_t at) { uncovered += isFront(at, behind) ? 1.0F : 0.0F; });
      image.front[pixel] = front;
      image.inside[pixel] = uncovered * line.strength /
        (line.covered * static_cast<float>(rule_.samples * rule_.samples));
    }
  }

  [[nodiscard]] bool isFront(std::size_t at, float behind) const
  {
    return cover_[at] == InfinityF && finder_.block().depth[at] <= behind;
  }

  /// Are all four samples about the centre of a pixel in front?
  [[nodiscard]] bool showsFront(int i, int j, float behind) const
  {
    bool all = true;
    const int middle = rule_.samples / 2;
    forEachSample(
      i, j, middle - 1, middle + 1, [&](std::size_t at) { all = all && isFront(at, behind); });
    return all;
  }

  /// One of the pixels around one that shows what is in front; -1 if none does.
  [[nodiscard]] int pixelThatShows(int i, int j, float behind, const SilhouetteImage& image) const
  {
    for (const auto& [di, dj] : { std::pair(-1, 0), { 1, 0 }, { 0, -1 }, { 0, 1 }, { -1, -1 },
           { 1, -1 }, { -1, 1 }, { 1, 1 } })
    {
      if (showsFront(i + di, j + dj, behind))
      {
        const int sample = finder_.margin() * rule_.samples;
        return finder_.block().pixelOf(sample + (i + di) * rule_.samples,
          sample + (j + dj) * rule_.samples, image.width, image.height);
      }
    }
    return -1;
  }

  [[nodiscard]] int pixelOf(int sample, const SilhouetteImage& image) const
  {
    const SampleBlock& block = finder_.block();
    return block.pixelOf(
      sample % block.stride(), sample / block.stride(), image.width, image.height);
  }

  const DepthSource& source_;
  const SilhouetteRule& rule_;
  bool findFronts_;
  bool spreads_; ///< lines are wider than the edge samples
  EdgeFinder finder_;
  std::vector<float> cover_;  ///< depth of the nearest front that covers a sample
  std::vector<int> fronts_;   ///< and its sample
  std::vector<float> spread_; ///< radius that a front sample has covered
};
}

namespace
{
/// Can there be an edge between depths of this range? May err towards yes.
bool mayHaveEdge(const SilhouetteRule& rule, DepthRange range)
{
  if (!range.hasGeometry())
  {
    return false;
  }
  if (range.background && rule.backgroundLines)
  {
    if (!std::isfinite(rule.background))
    {
      return true;
    }
    range.add(rule.background);
  }
  // Depths are searched as floats relative to the nearest, which may round the difference up.
  return (range.farthest - range.nearest) * (1 + 1e-6) > smallestStep(rule);
}
}

std::vector<int> tilesToSearch(const std::vector<DepthRange>& ranges, const SilhouetteRule& rule,
  SilhouetteImage& image, bool skipTiles)
{
  const int columns = depthTiles(image.width), rows = depthTiles(image.height);
  std::vector<int> searched;
  std::vector<DepthRange> threeRows(static_cast<std::size_t>(columns));
  for (int y = 0; y < rows; ++y)
  {
    for (int x = 0; x < columns; ++x)
    {
      threeRows[static_cast<std::size_t>(x)] = rangeOf(ranges, columns, x, x + 1, y - 1, y + 2);
    }
    for (int x = 0; x < columns; ++x)
    {
      const int tile = y * columns + x;
      const DepthRange range = rangeOf(threeRows, columns, x - 1, x + 2, 0, 1);
      std::uint8_t& had = image.tileHasLines[static_cast<std::size_t>(tile)];
      if (range.hasGeometry() && !rule.drawsNothing() && (!skipTiles || mayHaveEdge(rule, range)))
      {
        searched.push_back(tile);
      }
      else if (had != 0)
      {
        clearTile(image, x, y);
        had = 0;
      }
    }
  }
  return searched;
}

void resizeFor(SilhouetteImage& image, const DepthSource& source, bool findFronts)
{
  const auto pixels = static_cast<std::size_t>(source.width()) * source.height();
  if (image.width != source.width() || image.height != source.height())
  {
    image.width = source.width();
    image.height = source.height();
    image.strength.assign(pixels, 0);
    image.tileHasLines.assign(
      static_cast<std::size_t>(depthTiles(image.width)) * depthTiles(image.height), 0);
  }
  image.front.resize(findFronts ? pixels : 0);
}

void clearTile(SilhouetteImage& image, int tileX, int tileY)
{
  const int x = tileX * DepthTileSize, y = tileY * DepthTileSize;
  for (int j = y; j < std::min(y + DepthTileSize, image.height); ++j)
  {
    float* row = image.strength.data() + static_cast<std::ptrdiff_t>(j) * image.width + x;
    if (image.width - x >= DepthTileSize)
    {
      std::fill_n(row, DepthTileSize, 0.0F); // of a length that the compiler knows
    }
    else
    {
      std::fill_n(row, image.width - x, 0.0F);
    }
  }
}

SilhouetteCounters findSilhouettes(const DepthSource& source, const SilhouetteRule& rule,
  SilhouetteImage& image, const SilhouetteOptions& options)
{
  const auto pixels = static_cast<std::size_t>(source.width()) * source.height();
  image.inside.resize(options.findFronts && rule.samples > 1 ? pixels : 0);
  return paintTiles(
    source, rule, image, options, [&] { return SamplePainter(source, rule, options.findFronts); });
}
}
