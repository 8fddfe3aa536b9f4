// SPDX-License-Identifier: BSD-3-Clause
#include "SharedSilhouettes.h"

#include "SharedTiles.h"
#include "SilhouetteRims.h"
#include "SilhouetteTiles.h"

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
using Words = ProcessGroup::Words;

constexpr std::size_t WordBytes = sizeof(std::uint64_t);

/// What all processes together see in a tile, from the ranges of each.
struct SharedRange
{
  DepthRange all;
  /// Nothing farther is seen: there is a process whose spheres fill the tile.
  double closed = std::numeric_limits<double>::infinity();

  void add(const DepthRange& one)
  {
    all.add(one);
    if (!one.background)
    {
      closed = std::min(closed, one.farthest);
    }
  }

  /// May be too wide.
  [[nodiscard]] DepthRange bounds() const
  {
    const bool isClosed = std::isfinite(closed);
    return { all.nearest, isClosed ? std::min(closed, all.farthest) : all.farthest, !isClosed };
  }
};

/// Tiles that show spheres.
Words wordsOf(const std::vector<DepthRange>& ranges)
{
  Words words;
  for (std::size_t tile = 0; tile < ranges.size(); ++tile)
  {
    const DepthRange& range = ranges[tile];
    if (range.hasGeometry())
    {
      words.push_back(tile << 1U | (range.background ? 1U : 0U));
      words.push_back(wordOf(range.nearest));
      words.push_back(wordOf(range.farthest));
    }
  }
  return words;
}

std::vector<DepthRange> boundsOf(const Words& words, std::size_t tiles)
{
  std::vector<SharedRange> shared(tiles);
  for (std::size_t at = 0; at < words.size(); at += 3)
  {
    shared[words[at] >> 1U].add(
      { doubleOf(words[at + 1]), doubleOf(words[at + 2]), (words[at] & 1U) != 0 });
  }
  std::vector<DepthRange> bounds;
  bounds.reserve(tiles);
  std::transform(shared.begin(), shared.end(), std::back_inserter(bounds),
    [](const SharedRange& range) { return range.bounds(); });
  return bounds;
}

/// Divides the rows of tiles so that each process has about as many that are searched.
std::vector<int> divideRows(const std::vector<int>& searched, int columns, int rows, int processes)
{
  std::vector<std::size_t> before(static_cast<std::size_t>(rows) + 1, 0);
  for (const int tile : searched)
  {
    ++before[static_cast<std::size_t>(tile / columns) + 1];
  }
  for (std::size_t row = 1; row < before.size(); ++row)
  {
    before[row] += before[row - 1];
  }
  std::vector<int> first{ 0 };
  for (int process = 1; process < processes; ++process)
  {
    const std::size_t share =
      searched.size() * static_cast<std::size_t>(process) / static_cast<std::size_t>(processes);
    const auto row = std::lower_bound(before.begin(), before.end(), share);
    first.push_back(std::max(first.back(), static_cast<int>(row - before.begin())));
  }
  first.push_back(rows);
  return first;
}

/// Flags of the searched tiles and all around them.
std::vector<std::uint8_t> tilesAround(const std::vector<int>& searched, int columns, int rows)
{
  std::vector<std::uint8_t> needed(static_cast<std::size_t>(columns) * rows, 0);
  for (const int tile : searched)
  {
    const int x = tile % columns, y = tile / columns;
    for (int j = std::max(0, y - 1); j < std::min(rows, y + 2); ++j)
    {
      for (int i = std::max(0, x - 1); i < std::min(columns, x + 2); ++i)
      {
        needed[static_cast<std::size_t>(j) * columns + i] = 1;
      }
    }
  }
  return needed;
}

/// What a process has to say about some rows of tiles: those that are needed, unless others hide
/// them.
Words tilesOf(const std::vector<TracedLayer>& own, int process,
  const std::vector<std::uint8_t>& needed, const std::vector<DepthRange>& ranges, int begin,
  int end)
{
  Words words;
  for (const TracedLayer& layer : own)
  {
    std::vector<int> tiles;
    for (int tile = begin; tile < end; ++tile)
    {
      const auto at = static_cast<std::size_t>(tile);
      const DepthRange& range = layer.frame.tiles[at];
      if (needed[at] != 0 && range.hasGeometry() && range.nearest <= ranges[at].farthest)
      {
        tiles.push_back(tile);
      }
    }
    if (!tiles.empty())
    {
      appendTiles(layer, tiles, process, words);
    }
  }
  return words;
}
}

void SharedSilhouettes::find(const std::vector<TracedLayer>& own, const Camera& camera,
  const SilhouetteRule& rule, const ProcessGroup& group, int destination, bool placed)
{
  bytes_ = {};
  width_ = camera.width;
  height_ = camera.height;
  std::vector<DepthRange> ranges = shareRanges(own, group);
  const std::vector<int> searched = searchedTiles(ranges, rule);
  rows_ = divideRows(searched, columns(), rows(), group.size());
  const Words tiles = exchangeTiles(own, ranges, searched, group);
  const int first = rowsOf(group.rank()).first, end = rowsOf(group.rank()).second;
  for (int tile = 0; tile < rows() * columns(); ++tile)
  {
    if (tile < (first - 1) * columns() || tile >= (end + 1) * columns())
    {
      ranges[static_cast<std::size_t>(tile)] = {}; // not looked at here
    }
  }
  depth_.assemble(camera, tiles, std::move(ranges));
  Words ownLines;
  if (!depth_.empty())
  {
    findTracedSilhouettes(depth_, rule, found_, { true, true });
    appendLines(found_, first, end, depth_, placed, ownLines);
  }
  const bool toAll = destination < 0;
  const int receivers = toAll ? group.size() - 1 : static_cast<int>(destination != group.rank());
  bytes_.lines = WordBytes * ownLines.size() * static_cast<std::size_t>(receivers);
  readLines(toAll ? group.gather(ownLines) : group.gatherAt(destination, ownLines), width_, height_,
    placed, lines_);
}

void SharedSilhouettes::shareColors(const std::uint8_t* own, bool all, const ProcessGroup& group)
{
  SilhouetteImage& image = lines_.image;
  Words words;
  for (std::size_t pixel = 0; pixel < image.strength.size(); ++pixel)
  {
    const bool isOwn = lines_.process[pixel] == group.rank() && image.strength[pixel] > 0;
    if (isOwn && own && (all || image.inside[pixel] > 0))
    {
      const std::uint8_t* rgb = own + 4 * static_cast<std::ptrdiff_t>(image.front[pixel]);
      words.push_back(pixel | std::uint64_t(rgb[0]) << 32U | std::uint64_t(rgb[1]) << 40U |
        std::uint64_t(rgb[2]) << 48U);
    }
  }
  bytes_.lines += WordBytes * words.size() * static_cast<std::size_t>(group.size() - 1);
  colors_.resize(4 * image.strength.size());
  for (const std::uint64_t word : group.gather(words))
  {
    const std::size_t pixel = word & 0xFFFFFFFFU;
    image.front[pixel] = static_cast<std::int32_t>(pixel);
    for (unsigned channel = 0; channel < 3; ++channel)
    {
      colors_[4 * pixel + channel] = static_cast<std::uint8_t>(word >> (32 + 8 * channel));
    }
  }
}

void SharedSilhouettes::keepOwn(int process)
{
  for (std::size_t pixel = 0; pixel < lines_.process.size(); ++pixel)
  {
    if (lines_.process[pixel] != process)
    {
      lines_.image.strength[pixel] = 0;
    }
  }
}

int SharedSilhouettes::columns() const
{
  return depthTiles(width_);
}

int SharedSilhouettes::rows() const
{
  return depthTiles(height_);
}

std::pair<int, int> SharedSilhouettes::rowsOf(int process) const
{
  const auto at = static_cast<std::size_t>(process);
  return { rows_[at], rows_[at + 1] };
}

/// Ranges that hold what all processes together see in each tile.
std::vector<DepthRange> SharedSilhouettes::shareRanges(
  const std::vector<TracedLayer>& own, const ProcessGroup& group)
{
  const Words words = own.empty() ? Words() : wordsOf(TracedDepth(own).ranges());
  bytes_.ranges = WordBytes * words.size() * static_cast<std::size_t>(group.size() - 1);
  return boundsOf(group.gather(words), static_cast<std::size_t>(columns()) * rows());
}

/// Tiles that may have lines: the same for all processes.
std::vector<int> SharedSilhouettes::searchedTiles(
  const std::vector<DepthRange>& ranges, const SilhouetteRule& rule) const
{
  SilhouetteImage nothing;
  nothing.width = width_;
  nothing.height = height_;
  nothing.tileRows.assign(ranges.size(), 0);
  const int reach = static_cast<int>(WidestLine); // of any line
  std::vector<int> numbers;
  for (const SearchedTiles& tiles : tilesToSearch(ranges, rule, reach, nothing, true))
  {
    for (int x = tiles.x; x < tiles.x + tiles.count; ++x)
    {
      numbers.push_back(tiles.y * columns() + x);
    }
  }
  return numbers;
}

/// Each process gets what all see in its rows and in one more on each side, which edges look at.
Words SharedSilhouettes::exchangeTiles(const std::vector<TracedLayer>& own,
  const std::vector<DepthRange>& ranges, const std::vector<int>& searched,
  const ProcessGroup& group)
{
  const std::vector<std::uint8_t> needed = tilesAround(searched, columns(), rows());
  Words arrived;
  for (int process = 0; process < group.size(); ++process)
  {
    const auto [first, end] = rowsOf(process);
    if (first == end || searched.empty())
    {
      continue; // all know that nothing is needed there
    }
    const int begin = std::max(0, first - 1) * columns();
    const Words words =
      tilesOf(own, group.rank(), needed, ranges, begin, std::min(rows(), end + 1) * columns());
    Words all = group.gatherAt(process, words);
    if (process == group.rank())
    {
      arrived = std::move(all);
    }
    else
    {
      bytes_.depths += WordBytes * words.size();
    }
  }
  return arrived;
}
}
