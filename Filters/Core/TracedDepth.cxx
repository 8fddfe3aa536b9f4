// SPDX-License-Identifier: BSD-3-Clause
#include "TracedDepth.h"

#include <utility>

// Highway compiles this file once for each instruction set and chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "TracedDepth.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

/// What stands in for vectors where there are none makes infinity finite when it rounds.
constexpr bool HasVectors = HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128;

/// Calls f(i) so that vectors from i on cover all of `count` numbers. The last vector overlaps with
/// the one before it; what is shorter than a vector is left to `rest`, and so is all where there
/// are no vectors.
template <typename Function, typename Rest>
inline void forEachVector(int count, int lanes, const Function& f, const Rest& rest)
{
  if (!HasVectors || count < lanes)
  {
    for (int i = 0; i < count; ++i)
    {
      rest(i);
    }
    return;
  }
  for (int i = 0; i + lanes < count; i += lanes)
  {
    f(i);
  }
  f(count - lanes);
}

/// to[i] = from[i] - origin in single precision; with `mix` only where that is nearer.
inline void subtractOrigin(const double* from, int count, double origin, bool mix, float* to)
{
  const hn::CappedTag<double, 8> d;
  const hn::Rebind<float, decltype(d)> f;
  forEachVector(
    count, static_cast<int>(hn::Lanes(d)),
    [&](int i)
    {
      const auto depth = hn::LoadU(d, from + i);
      const auto relative = hn::DemoteTo(f, hn::Sub(depth, hn::Set(d, origin)));
      hn::StoreU(mix ? hn::Min(relative, hn::LoadU(f, to + i)) : relative, f, to + i);
    },
    [&](int i)
    {
      const auto relative = static_cast<float>(from[i] - origin);
      to[i] = mix ? std::min(relative, to[i]) : relative;
    });
}

inline void copyNumbers(const std::uint32_t* from, int count, std::uint32_t* to)
{
  const hn::CappedTag<std::uint32_t, 8> d;
  forEachVector(
    count, static_cast<int>(hn::Lanes(d)),
    [&](int i) { hn::StoreU(hn::LoadU(d, from + i), d, to + i); }, [&](int i) { to[i] = from[i]; });
}

/// Does a block, with what is behind its rows, lie in the picture?
inline bool isInside(const SampleBlock& block, int width, int height)
{
  return block.x >= 0 && block.x + block.columns <= width && block.y >= 0 &&
    block.y + block.rows <= height &&
    (block.y + block.rows < height || block.x + block.stride() <= width);
}

/// Fills a block row by row: fillColumns(first pixel, number of pixels, target) for the columns
/// inside of the window; those beside it repeat the border.
template <typename T, typename FillColumns>
inline void fillRows(
  const SampleBlock& block, int width, int height, T* target, const FillColumns& fillColumns)
{
  const int stride = block.stride();
  if (isInside(block, width, height))
  {
    // Whole vectors: what is behind the columns is there too.
    std::ptrdiff_t first = static_cast<std::ptrdiff_t>(block.y) * width + block.x;
    for (int j = 0; j < block.rows; ++j, first += width, target += stride)
    {
      fillColumns(first, stride, target);
    }
    return;
  }
  const int begin = std::clamp(-block.x, 0, block.columns);
  const int end = std::clamp(width - block.x, 0, block.columns);
  for (int j = 0; j < block.rows; ++j, target += stride)
  {
    const int y = std::clamp(block.y + j, 0, height - 1);
    fillColumns(
      static_cast<std::ptrdiff_t>(y) * width + block.x + begin, end - begin, target + begin);
    std::fill(target, target + begin, target[begin]);
    std::fill(target + end, target + block.columns, target[end - 1]);
  }
}

void fillDepths(const std::vector<TracedLayer>& layers, SampleBlock& block)
{
  const TracedFrame& front = layers.front().frame;
  fillRows(block, front.width, front.height, block.depth.data(),
    [&](std::ptrdiff_t first, int count, float* target)
    {
      for (const TracedLayer& layer : layers)
      {
        const double* t = layer.frame.t.data() + first;
        subtractOrigin(t, count, block.origin, &layer != &layers.front(), target);
      }
    });
}

void fillSpheresOf(const TracedFrame& frame, const SampleBlock& block, std::uint32_t* numbers)
{
  fillRows(block, frame.width, frame.height, numbers,
    [&](std::ptrdiff_t first, int count, std::uint32_t* target)
    { copyNumbers(frame.sphere.data() + first, count, target); });
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(fillDepths);
HWY_EXPORT(fillSpheresOf);

TracedDepth::TracedDepth(std::vector<TracedLayer> layers)
  : layers_(std::move(layers))
{
  std::uint32_t spheres = 0;
  for (const TracedLayer& layer : layers_)
  {
    firstSpheres_.push_back(spheres);
    spheres += static_cast<std::uint32_t>(layer.spheres.size());
  }
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

SphereLayer TracedDepth::layer(std::size_t index) const
{
  const std::vector<Sphere>& spheres = layers_[index].spheres;
  return { spheres.data(), firstSpheres_[index], static_cast<std::uint32_t>(spheres.size()),
    &layers_[index].rays };
}

std::uint32_t TracedDepth::numberAt(std::size_t pixel) const
{
  std::size_t nearest = 0;
  for (std::size_t layer = 1; layer < layers_.size(); ++layer)
  {
    nearest = layers_[layer].frame.t[pixel] < layers_[nearest].frame.t[pixel] ? layer : nearest;
  }
  const std::uint32_t sphere = layers_[nearest].frame.sphere[pixel];
  return sphere == SphereScene::None ? sphere : firstSpheres_[nearest] + sphere;
}

void TracedDepth::fillSpheres(const SampleBlock& block, std::vector<std::uint32_t>& numbers) const
{
  numbers.resize(block.depth.size());
  HWY_DYNAMIC_DISPATCH(fillSpheresOf)(layers_.front().frame, block, numbers.data());
  if (layers_.size() == 1)
  {
    return;
  }
  for (int j = 0; j < block.rows; ++j)
  {
    for (int i = 0; i < block.columns; ++i)
    {
      const auto pixel = static_cast<std::size_t>(block.pixelOf(i, j, width(), height()));
      numbers[static_cast<std::size_t>(block.indexOf(i, j))] = numberAt(pixel);
    }
  }
}

void TracedDepth::fill(SampleBlock& block) const
{
  const std::vector<double>& t = layers_.front().frame.t;
  const std::ptrdiff_t next =
    static_cast<std::ptrdiff_t>(std::max(0, block.y)) * width() + block.x + block.stride();
  constexpr std::ptrdiff_t Size = sizeof(double);
  block.next = { reinterpret_cast<std::uintptr_t>(t.data()) +
      static_cast<std::uintptr_t>(Size * next),
    Size * width(), Size };
  HWY_DYNAMIC_DISPATCH(fillDepths)(layers_, block);
}
}
#endif
