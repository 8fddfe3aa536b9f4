// SPDX-License-Identifier: BSD-3-Clause
#include "SharedSilhouettes.h"

#include "DividedSpheres.h"
#include "SharedWords.h"
#include "SilhouetteTiles.h"

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
using Words = ProcessGroup::Words;

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

/// Flags of tiles in which more than one process has something.
std::vector<std::uint8_t> tilesOfSeveral(const Words& words, std::size_t tiles)
{
  std::vector<std::uint8_t> has(tiles, 0), several(tiles, 0);
  for (std::size_t at = 0; at < words.size(); at += 3)
  {
    const std::size_t tile = words[at] >> 1U;
    several[tile] = has[tile];
    has[tile] = 1;
  }
  return several;
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

/// Clears the ranges of the tiles that are not in these rows, the second of which is the end.
void keepRows(std::pair<int, int> rows, int columns, std::vector<DepthRange>& ranges)
{
  for (std::size_t tile = 0; tile < ranges.size(); ++tile)
  {
    const int row = static_cast<int>(tile) / columns;
    if (row < rows.first || row >= rows.second)
    {
      ranges[tile] = {};
    }
  }
}

/// Those of the tiles from `begin` to `end` that are flagged.
std::vector<int> tilesIn(const std::vector<std::uint8_t>& flags, int begin, int end)
{
  std::vector<int> tiles;
  for (int tile = begin; tile < end; ++tile)
  {
    if (flags[static_cast<std::size_t>(tile)] != 0)
    {
      tiles.push_back(tile);
    }
  }
  return tiles;
}
}

void SharedSilhouettes::find(const std::vector<TracedLayer>& own, const Camera& camera,
  const SilhouetteRule& rule, const ProcessGroup& group, int destination, bool placed)
{
  DividedSpheres spheres(own, camera, group.rank(), depth_);
  find(spheres, rule, group, destination, placed);
}

void SharedSilhouettes::find(DividedDepth& depth, const SilhouetteRule& rule,
  const ProcessGroup& group, int destination, bool placed)
{
  bytes_ = {};
  width_ = depth.width();
  height_ = depth.height();
  std::vector<DepthRange> ranges = boundsOf(shareRanges(depth.ownRanges(), group), tiles());
  const std::vector<int> searched = searchedTiles(ranges, rule);
  exchangeTiles(
    depth, std::move(ranges), searched, tilesAround(searched, columns(), rows()), group);
  Words ownLines;
  if (!depth.empty())
  {
    depth.findLines(rule, found_);
    const auto [first, end] = rowsOf(group.rank());
    appendLines(found_, first, end, depth, placed, ownLines);
  }
  const bool toAll = destination < 0;
  const int receivers = toAll ? group.size() - 1 : static_cast<int>(destination != group.rank());
  bytes_.lines = WordBytes * ownLines.size() * static_cast<std::size_t>(receivers);
  readLines(toAll ? group.gather(ownLines) : group.gatherAt(destination, ownLines), width_, height_,
    placed, lines_);
}

double SharedSilhouettes::depthSpread(DividedDepth& depth, const ProcessGroup& group)
{
  bytes_ = {};
  width_ = depth.width();
  height_ = depth.height();
  const Words words = shareRanges(depth.ownRanges(), group);
  std::vector<DepthRange> ranges = boundsOf(words, tiles());
  const std::vector<std::uint8_t> shared = tilesOfSeveral(words, tiles());
  const std::vector<int> wanted = tilesIn(shared, 0, static_cast<int>(tiles()));
  if (wanted.empty())
  {
    return po::depthSpread(ranges);
  }
  exchangeTiles(depth, std::move(ranges), wanted, shared, group);
  std::vector<DepthRange> own = depth.ranges();
  keepRows(rowsOf(group.rank()), columns(), own);
  return po::depthSpread(boundsOf(shareRanges(own, group), tiles()));
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

std::size_t SharedSilhouettes::tiles() const
{
  return static_cast<std::size_t>(columns()) * rows();
}

Words SharedSilhouettes::shareRanges(
  const std::vector<DepthRange>& ranges, const ProcessGroup& group)
{
  const Words words = wordsOf(ranges);
  bytes_.ranges += WordBytes * words.size() * static_cast<std::size_t>(group.size() - 1);
  return group.gather(words);
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

/// Divides the rows of tiles, by those that are wanted. Each process gets what all see in its rows
/// and in one more on each side, which edges look at.
void SharedSilhouettes::exchangeTiles(DividedDepth& depth, std::vector<DepthRange> ranges,
  const std::vector<int>& wanted, const std::vector<std::uint8_t>& needed,
  const ProcessGroup& group)
{
  rows_ = divideRows(wanted, columns(), rows(), group.size());
  Words arrived;
  for (int process = 0; process < group.size(); ++process)
  {
    const auto [first, end] = rowsOf(process);
    if (first == end || wanted.empty())
    {
      continue; // all know that nothing is needed there
    }
    const int begin = std::max(0, first - 1) * columns();
    Words words;
    depth.appendOwn(tilesIn(needed, begin, std::min(rows(), end + 1) * columns()), ranges, words);
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
  const auto [first, end] = rowsOf(group.rank());
  keepRows({ first - 1, end + 1 }, columns(), ranges); // others are not looked at here
  depth.assemble(arrived, std::move(ranges));
}
}
