// SPDX-License-Identifier: BSD-3-Clause
#include "SharedTiles.h"

#include "SharedWords.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>

namespace po
{
namespace
{
using Words = ProcessGroup::Words;

/// What one tile shows.
struct TileContent
{
  std::vector<std::uint32_t> spheres; ///< of the layer, in the order in which they are met
  std::vector<std::uint8_t> runs;

  void add(std::uint32_t sphere)
  {
    if (!runs.empty() && sphere == last_ && runs.back() < 255)
    {
      ++runs.back();
      return;
    }
    last_ = sphere;
    runs.push_back(valueOf(sphere));
    runs.push_back(0);
  }

private:
  std::uint8_t valueOf(std::uint32_t sphere)
  {
    if (sphere == SphereScene::None)
    {
      return SharedTile::NoSphere;
    }
    const auto found = std::find(spheres.begin(), spheres.end(), sphere);
    const auto place = static_cast<std::uint8_t>(found - spheres.begin());
    if (found == spheres.end())
    {
      spheres.push_back(sphere);
    }
    return place;
  }

  std::uint32_t last_ = SphereScene::None;
};

TileContent contentOf(const TracedFrame& frame, int tile)
{
  const int columns = depthTiles(frame.width);
  const int x = tile % columns * DepthTileSize, y = tile / columns * DepthTileSize;
  TileContent content;
  for (int j = y; j < std::min(y + DepthTileSize, frame.height); ++j)
  {
    const std::uint32_t* row = frame.sphere.data() + static_cast<std::ptrdiff_t>(j) * frame.width;
    for (int i = x; i < std::min(x + DepthTileSize, frame.width); ++i)
    {
      content.add(row[i]);
    }
  }
  return content;
}

/// The spheres of all tiles, in order, each once.
std::vector<std::uint32_t> spheresOf(const std::vector<TileContent>& contents)
{
  std::vector<std::uint32_t> all;
  for (const TileContent& content : contents)
  {
    all.insert(all.end(), content.spheres.begin(), content.spheres.end());
  }
  tbb::parallel_sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// From numbers of the layer to places among those that travel.
void renumber(const std::vector<std::uint32_t>& travelling, std::vector<TileContent>& contents)
{
  tbb::parallel_for(std::size_t(0), contents.size(),
    [&](std::size_t i)
    {
      for (std::uint32_t& sphere : contents[i].spheres)
      {
        const auto at = std::lower_bound(travelling.begin(), travelling.end(), sphere);
        sphere = static_cast<std::uint32_t>(at - travelling.begin());
      }
    });
}

/// Reads one layer after the other.
class Reader
{
public:
  Reader(const Words& words, SharedTiles& result)
    : at_(words.data())
    , end_(words.data() + words.size())
    , result_(result)
  {
  }

  [[nodiscard]] bool atEnd() const { return at_ == end_; }

  void readLayer()
  {
    Matrix4& placement = result_.localToWorld.emplace_back();
    for (double& element : placement)
    {
      element = doubleOf(*at_++);
    }
    const std::size_t spheres = *at_ & 0xFFFFFFFFU;
    result_.processes.push_back(static_cast<int>(*at_++ >> 32U));
    const std::size_t tiles = *at_++;
    const std::size_t first = result_.spheres.size();
    result_.firstSphere.push_back(static_cast<std::uint32_t>(first));
    result_.spheres.resize(first + spheres);
    const auto* source = take<Sphere>(spheres);
    std::copy_n(source, spheres, result_.spheres.begin() + static_cast<std::ptrdiff_t>(first));
    for (std::size_t i = 0; i < tiles; ++i)
    {
      readTile();
    }
  }

private:
  void readTile()
  {
    const std::uint64_t head = *at_++;
    const std::size_t spheres = head >> 32U & 0xFFFFU, runs = head >> 48U;
    const auto* numbers = take<std::uint32_t>(spheres);
    result_.tiles.push_back({ static_cast<int>(head & 0xFFFFFFFFU), result_.localToWorld.size() - 1,
      spheres, numbers, take<std::uint8_t>(runs) });
  }

  template <typename Value>
  const Value* take(std::size_t count)
  {
    const std::uint64_t* here = at_;
    at_ += wordsFor(count * sizeof(Value));
    return reinterpret_cast<const Value*>(here);
  }

  const std::uint64_t* at_;
  const std::uint64_t* end_;
  SharedTiles& result_;
};
}

void appendTiles(const TracedLayer& layer, const std::vector<int>& tiles, int process, Words& words)
{
  std::vector<TileContent> contents(tiles.size());
  tbb::parallel_for(std::size_t(0), tiles.size(),
    [&](std::size_t i) { contents[i] = contentOf(layer.frame, tiles[i]); });
  const std::vector<std::uint32_t> travelling = spheresOf(contents);
  renumber(travelling, contents);

  for (const double element : layer.rays.localToWorld())
  {
    words.push_back(wordOf(element));
  }
  words.push_back(travelling.size() | static_cast<std::uint64_t>(process) << 32U);
  words.push_back(tiles.size());
  std::vector<Sphere> spheres;
  spheres.reserve(travelling.size());
  for (const std::uint32_t sphere : travelling)
  {
    spheres.push_back(layer.spheres[sphere]);
  }
  appendValues(spheres, words);
  for (std::size_t i = 0; i < tiles.size(); ++i)
  {
    const TileContent& content = contents[i];
    words.push_back(static_cast<std::uint64_t>(tiles[i]) |
      std::uint64_t(content.spheres.size()) << 32U | std::uint64_t(content.runs.size()) << 48U);
    appendValues(content.spheres, words);
    appendValues(content.runs, words);
  }
}

SharedTiles readTiles(const Words& words)
{
  SharedTiles result;
  for (Reader reader(words, result); !reader.atEnd();)
  {
    reader.readLayer();
  }
  return result;
}
}
