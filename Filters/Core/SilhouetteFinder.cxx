// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteFinder.h"

#include "EdgePixels.h"
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
    , reach_(reachOf(rule))
    , margin_(reach_ + (rule.samples == 1 ? 2 : 1)) // an edge looks at two samples
    , finder_(rule, rule.samples)
  {
  }

  /// Pixels from which a line can reach into a tile.
  static int reachOf(const SilhouetteRule& rule)
  {
    const bool spreads = rule.samples > 1 || rule.maximumWidth > 1;
    return spreads ? static_cast<int>(std::ceil(rule.maximumWidth)) + (rule.samples == 1 ? 2 : 1)
                   : 0;
  }

  void paint(const SearchedTiles& tiles, SilhouetteImage& image)
  {
    if (reach_ == 0)
    {
      paintEdges(tiles, image);
      return;
    }
    for (int x = tiles.x; x < tiles.x + tiles.count; ++x)
    {
      const SearchedTiles tile{ x, tiles.y, 1, tiles.nearest };
      writeRows(lines_, paintTile(tile), tile.x, tile.y, image);
    }
  }

private:
  /// Lines of one pixel: the edges themselves.
  void paintEdges(const SearchedTiles& tiles, SilhouetteImage& image)
  {
    const PixelRange all = tiles.pixels(source_.width(), source_.height());
    finder_.find(source_, all, grow(all, margin_), tiles.nearest);
    writeEdges(finder_, tiles, image);
    if (rule_.greyByJump)
    {
      forEachEdge(finder_.groups(), [&](const SilhouetteEdge& edge) { darkenByJump(edge, image); });
    }
  }

  void darkenByJump(const SilhouetteEdge& edge, SilhouetteImage& image) const
  {
    const SampleBlock& block = finder_.block();
    const auto behind = static_cast<std::size_t>(block.indexOf(edge.i, edge.j));
    const float jump = block.depth[behind] - block.depth[static_cast<std::size_t>(frontOf(edge))];
    const auto pixel = static_cast<std::size_t>(block.y + edge.j) * image.width + block.x + edge.i;
    image.strength[pixel] = rule_.ramp.at(jump);
  }

  /// @return the rows that have lines, one bit each
  std::uint32_t paintTile(const SearchedTiles& tile)
  {
    // What is beside the picture counts too, and all of the tile: lines come from everywhere.
    const PixelRange all = tile.pixels(source_.width(), source_.height());
    if (!finder_.find(source_, grow(all, reach_), grow(all, margin_), tile.nearest))
    {
      return 0;
    }
    cover_.assign(finder_.block().depth.size(), InfinityF);
    fronts_.resize(findFronts_ ? cover_.size() : 0);
    spread_.assign(cover_.size(), 0);
    forEachEdge(finder_.groups(),
      [&](const SilhouetteEdge& edge)
      {
        cover(finder_.block().indexOf(edge.i, edge.j), frontOf(edge));
        spread(edge);
      });
    return setCovered(all.x1 - all.x0, all.y1 - all.y0);
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
    const int end = start + std::min(block.columns * block.samples, frontI + half + 1);
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

  std::uint32_t setCovered(int columns, int rows)
  {
    std::uint32_t rowsWithLines = 0;
    for (int j = 0; j < rows; ++j)
    {
      for (int i = 0; i < columns; ++i)
      {
        const auto at = static_cast<std::size_t>(TileLines::indexOf(i, j));
        const PixelLine line = lineIn(i, j);
        lines_.strength[at] = line.strength / static_cast<float>(rule_.samples * rule_.samples);
        if (line.covered > 0)
        {
          rowsWithLines |= 1U << static_cast<unsigned>(j);
        }
        if (findFronts_ && line.front >= 0)
        {
          setFront(i, j, line);
        }
      }
    }
    return rowsWithLines;
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
    const int margin = margin_, samples = rule_.samples;
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
  void setFront(int i, int j, const PixelLine& line)
  {
    const auto at = static_cast<std::size_t>(TileLines::indexOf(i, j));
    const int frontI = line.front % finder_.block().stride();
    const int frontJ = line.front / finder_.block().stride();
    if (rule_.samples == 1)
    {
      lines_.front[at] = pixelOf(frontI, frontJ);
      return;
    }
    lines_.inside[at] = 0;
    const float behind = line.farthest + static_cast<float>(rule_.jump);
    if (showsFront(i, j, behind))
    {
      lines_.front[at] = pixelAt(i, j);
      return;
    }
    const int front = pixelThatShows(i, j, behind);
    lines_.front[at] = front >= 0 ? front : pixelAbout(frontI, frontJ, behind);
    if (front >= 0)
    {
      float uncovered = 0;
      forEachSample(i, j, 0, rule_.samples,
        [&](std::size_t sample) { uncovered += isFront(sample, behind) ? 1.0F : 0.0F; });
      lines_.inside[at] = uncovered * line.strength /
        (line.covered * static_cast<float>(rule_.samples * rule_.samples));
    }
  }

  [[nodiscard]] bool isFront(std::size_t at, float behind) const
  {
    return cover_[at] == InfinityF && finder_.block().depth[at] <= behind;
  }

  /// Are all four samples about the centre of a pixel in front? Of those that are known.
  [[nodiscard]] bool showsFront(int i, int j, float behind) const
  {
    const SampleBlock& block = finder_.block();
    if (std::min(i, j) < -margin_ || i + margin_ >= block.columns || j + margin_ >= block.rows)
    {
      return false;
    }
    bool all = true;
    const int middle = rule_.samples / 2;
    forEachSample(
      i, j, middle - 1, middle + 1, [&](std::size_t at) { all = all && isFront(at, behind); });
    return all;
  }

  /// One of the pixels around one that shows what is in front; -1 if none does.
  [[nodiscard]] int pixelThatShows(int i, int j, float behind) const
  {
    for (const auto& [di, dj] : { std::pair(-1, 0), { 1, 0 }, { 0, -1 }, { 0, 1 }, { -1, -1 },
           { 1, -1 }, { -1, 1 }, { 1, 1 } })
    {
      if (showsFront(i + di, j + dj, behind))
      {
        return pixelAt(i + di, j + dj);
      }
    }
    return -1;
  }

  /// The pixel of a front sample, or one around it that shows what is in front if that does not.
  [[nodiscard]] int pixelAbout(int sampleI, int sampleJ, float behind) const
  {
    const int i = sampleI / rule_.samples - margin_, j = sampleJ / rule_.samples - margin_;
    const int shown = showsFront(i, j, behind) ? -1 : pixelThatShows(i, j, behind);
    return shown >= 0 ? shown : pixelOf(sampleI, sampleJ);
  }

  /// Pixel of the picture at pixel (i, j) of the tile.
  [[nodiscard]] int pixelAt(int i, int j) const
  {
    const int samples = rule_.samples;
    return pixelOf((margin_ + i) * samples, (margin_ + j) * samples);
  }

  /// Pixel of the picture that a sample of the block belongs to.
  [[nodiscard]] int pixelOf(int sampleI, int sampleJ) const
  {
    return finder_.block().pixelOf(sampleI, sampleJ, source_.width(), source_.height());
  }

  const DepthSource& source_;
  const SilhouetteRule& rule_;
  bool findFronts_;
  int reach_;
  int margin_; ///< pixels around a tile that are read
  EdgeFinder finder_;
  TileLines lines_{};
  std::vector<float> cover_;  ///< depth of the nearest front that covers a sample
  std::vector<int> fronts_;   ///< and its sample
  std::vector<float> spread_; ///< radius that a front sample has covered
};
}

SilhouetteCounters findSilhouettes(const DepthSource& source, const SilhouetteRule& rule,
  SilhouetteImage& image, const SilhouetteOptions& options)
{
  const auto pixels = static_cast<std::size_t>(source.width()) * source.height();
  image.inside.resize(options.findFronts && rule.samples > 1 ? pixels : 0);
  return paintTiles(source, rule, SamplePainter::reachOf(rule), image, options,
    [&] { return SamplePainter(source, rule, options.findFronts); });
}
}
