// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_DepthSource_h
#define po_DepthSource_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

/// Depth as silhouettes are found in: blocks of samples, with the range of each tile of pixels.
///
/// A depth is the distance t in world units along the normalised eye ray (perspective) or along the
/// view direction (parallel). +infinity is background.
namespace po
{
/// Pixels along each side of the tiles that are traced, skipped and searched for lines.
constexpr int DepthTileSize = 16;

/// Tiles along an image side of `pixels`.
[[nodiscard]] constexpr int depthTiles(int pixels)
{
  return (pixels + DepthTileSize - 1) / DepthTileSize;
}

/// What depths a part of an image has.
struct DepthRange
{
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -std::numeric_limits<double>::infinity(); ///< of those that are finite
  bool background = false;

  [[nodiscard]] bool hasGeometry() const { return nearest <= farthest; }

  void add(double t)
  {
    if (t < std::numeric_limits<double>::infinity())
    {
      nearest = std::min(nearest, t);
      farthest = std::max(farthest, t);
    }
    else
    {
      background = true;
    }
  }

  void add(const DepthRange& other)
  {
    nearest = std::min(nearest, other.nearest);
    farthest = std::max(farthest, other.farthest);
    background = background || other.background;
  }
};

/// Rows of memory that will be read soon.
struct ComingRows
{
  std::uintptr_t first = 0; ///< address
  std::ptrdiff_t pitch = 0; ///< bytes from row to row
  std::ptrdiff_t step = 0;  ///< bytes from sample to sample

  [[nodiscard]] const void* at(int i, int j) const
  {
    return reinterpret_cast<const void*>(first + static_cast<std::uintptr_t>(j * pitch + i * step));
  }
};

/// The depths of some pixels, `samples` x `samples` each, row by row from the bottom. Pixels that
/// lie beyond the image repeat its border.
struct SampleBlock
{
  /// Numbers behind the last sample that may be read, with any value, as parts of vectors.
  static constexpr int Slack = 64;

  int x = 0, y = 0;          ///< first pixel; may lie outside of the image
  int columns = 0, rows = 0; ///< pixels
  int samples = 1;
  double origin = 0; ///< subtracted from every depth in double precision
  std::vector<float> depth;
  /// Of the block to the right, which is likely to follow: asked for while this one is searched,
  /// piece by piece, since memory can answer only so many questions at once.
  ComingRows next;

  /// From row to row: whole vectors. What is behind a row has any value.
  [[nodiscard]] int stride() const { return (columns * samples + 7) / 8 * 8; }

  [[nodiscard]] int indexOf(int i, int j) const { return j * stride() + i; }

  /// Pixel of an image of `width` x `height` that sample (i, j) of the block belongs to.
  [[nodiscard]] int pixelOf(int i, int j, int width, int height) const
  {
    const int column = x + (samples == 1 ? i : i / samples);
    const int row = y + (samples == 1 ? j : j / samples);
    return std::clamp(row, 0, height - 1) * width + std::clamp(column, 0, width - 1);
  }

  void resize(int newColumns, int newRows, int newSamples)
  {
    columns = newColumns;
    rows = newRows;
    samples = newSamples;
    depth.resize(static_cast<std::size_t>(stride()) * rows * samples + Slack);
  }
};

/// Where depths come from. Blocks are filled by several threads at once.
class DepthSource
{
public:
  virtual ~DepthSource() = default;

  /// Pixels.
  [[nodiscard]] virtual int width() const = 0;
  [[nodiscard]] virtual int height() const = 0;

  /// Range of the pixels of each tile, row by row from the lower left corner.
  [[nodiscard]] virtual const std::vector<DepthRange>& ranges() const = 0;

  /// Fills a block whose place, size, samples and origin are set.
  virtual void fill(SampleBlock& block) const = 0;
};

/// How far the visible depths spread: the 5th to the 95th percentile of the nearest and farthest
/// depths of the tiles, a histogram that costs no pass over the pixels. 0 where nothing
/// is seen.
[[nodiscard]] double depthSpread(const std::vector<DepthRange>& ranges);
[[nodiscard]] inline double depthSpread(const DepthSource& source)
{
  return depthSpread(source.ranges());
}
}

#endif
