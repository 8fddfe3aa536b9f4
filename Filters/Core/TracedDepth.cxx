// SPDX-License-Identifier: BSD-3-Clause
#include "TracedDepth.h"

#include <utility>

namespace po
{
TracedDepth::TracedDepth(std::vector<TracedLayer> layers)
  : layers_(std::move(layers))
{
  for (std::size_t layer = 1; layer < layers_.size(); ++layer)
  {
    if (merged_.empty())
    {
      merged_ = layers_.front().frame.tiles;
    }
    for (std::size_t tile = 0; tile < merged_.size(); ++tile)
    {
      const DepthRange& other = layers_[layer].frame.tiles[tile];
      const bool background = merged_[tile].background && other.background;
      merged_[tile].add(other);
      merged_[tile].background = background; // a pixel is open where every layer is
    }
  }
}

const TracedLayer& TracedDepth::layerAt(std::size_t pixel) const
{
  const TracedLayer* nearest = &layers_.front();
  for (const TracedLayer& layer : layers_)
  {
    nearest = layer.frame.t[pixel] < nearest->frame.t[pixel] ? &layer : nearest;
  }
  return *nearest;
}

void TracedDepth::fillRow(SampleBlock& block, int j) const
{
  const int y = std::clamp(block.y + j, 0, height() - 1);
  const std::size_t row = static_cast<std::size_t>(y) * width();
  // Columns of the block inside of the window; those beside it repeat the border.
  const int begin = std::clamp(-block.x, 0, block.columns);
  const int end = std::clamp(width() - block.x, 0, block.columns);
  float* target = block.depth.data() + static_cast<std::ptrdiff_t>(j) * block.columns;
  const double* t = layers_.front().frame.t.data() + row + block.x;
  for (int i = begin; i < end; ++i)
  {
    target[i] = static_cast<float>(t[i] - block.origin);
  }
  for (std::size_t layer = 1; layer < layers_.size(); ++layer)
  {
    const double* other = layers_[layer].frame.t.data() + row + block.x;
    for (int i = begin; i < end; ++i)
    {
      target[i] = std::min(target[i], static_cast<float>(other[i] - block.origin));
    }
  }
  std::fill(target, target + begin, target[begin]);
  std::fill(target + end, target + block.columns, target[end - 1]);
}

void TracedDepth::fill(SampleBlock& block) const
{
  for (int j = 0; j < block.rows; ++j)
  {
    fillRow(block, j);
  }
}
}
