// SPDX-License-Identifier: BSD-3-Clause
#include "ImageDepth.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

namespace po
{
template <typename T>
ImageDepth<T>::ImageDepth(const DepthImage<T>& image, int samples)
  : image_(image)
  , samples_(samples)
{
  const int columns = depthTiles(width());
  ranges_.resize(static_cast<std::size_t>(columns) * depthTiles(height()));
  tbb::parallel_for(tbb::blocked_range<int>(0, static_cast<int>(ranges_.size())),
    [&](const tbb::blocked_range<int>& tiles)
    {
      for (int tile = tiles.begin(); tile < tiles.end(); ++tile)
      {
        ranges_[static_cast<std::size_t>(tile)] = findRange(tile % columns, tile / columns);
      }
    });
}

template <typename T>
DepthRange ImageDepth<T>::findRange(int tileX, int tileY) const
{
  const int side = DepthTileSize * samples_;
  const int iEnd = std::min((tileX + 1) * side, image_.width);
  const int jEnd = std::min((tileY + 1) * side, image_.height);
  constexpr T Infinity = std::numeric_limits<T>::infinity();
  T nearest = Infinity, farthest = -Infinity;
  int finite = 0;
  for (int j = tileY * side; j < jEnd; ++j)
  {
    const T* row = image_.depth + static_cast<std::size_t>(j) * image_.width;
    for (int i = tileX * side; i < iEnd; ++i)
    {
      const bool isFinite = std::abs(row[i]) < Infinity;
      nearest = isFinite && row[i] < nearest ? row[i] : nearest;
      farthest = isFinite && row[i] > farthest ? row[i] : farthest;
      finite += isFinite;
    }
  }
  const int all = (iEnd - tileX * side) * (jEnd - tileY * side);
  return { static_cast<double>(nearest), static_cast<double>(farthest), finite < all };
}

template <typename T>
void ImageDepth<T>::fillRow(SampleBlock& block, int j) const
{
  constexpr T Infinity = std::numeric_limits<T>::infinity();
  const int sourceJ = std::clamp(block.y * samples_ + j, 0, image_.height - 1);
  const T* source = image_.depth + static_cast<std::size_t>(sourceJ) * image_.width;
  float* target = block.depth.data() + static_cast<std::ptrdiff_t>(j) * block.stride();
  const int first = block.x * samples_;
  for (int i = 0; i < block.columns * samples_; ++i)
  {
    const T t = source[std::clamp(first + i, 0, image_.width - 1)];
    target[i] = std::abs(t) < Infinity ? static_cast<float>(t - block.origin)
                                       : std::numeric_limits<float>::infinity();
  }
}

template <typename T>
void ImageDepth<T>::fill(SampleBlock& block) const
{
  for (int j = 0; j < block.rows * samples_; ++j)
  {
    fillRow(block, j);
  }
}

template class ImageDepth<float>;
template class ImageDepth<double>;
}
