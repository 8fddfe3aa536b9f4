// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouetteFinder_h
#define po_SilhouetteFinder_h

#include "DepthSource.h"
#include "SilhouetteRule.h"

#include <tbb/cache_aligned_allocator.h>

#include <cstddef>
#include <cstdint>
#include <vector>

/// Silhouettes from depth: the one implementation behind the image filter, the render pass and the
/// mapper of ray-traced spheres.
///
/// A sample is an edge where 8 t(centre) - sum of t(8 neighbours) exceeds the threshold, and, with
/// the slope test, where the jump to a neighbour in front exceeds a third of it after the slopes on
/// both sides are taken off. Only the positive side counts, as in the thesis that this follows
/// (Bigler 2004): the centre is then farther away than its neighbours, so that a line lies on what
/// is behind a jump, around what is in front, once. Along a straight jump of J the sum is 3 J; a
/// diagonal closes its corners (samples that touch the front by a corner only have 1 J).
///
/// A line covers the samples behind a jump that lie within its width of the front. With more than
/// one sample a pixel the share of covered samples is the strength: the box filter, darkest in the
/// middle of a line.
///
/// Background is not nearer or farther, but behind whatever it borders on: a line against it is
/// drawn at any threshold, and no far object changes it. With SilhouetteRule::background it is a
/// depth like any other.
namespace po
{
/// The window depth of pixels without a line: beyond the far plane, which has 1.
constexpr float NoLineDepth = 2;

/// Pixels of which the first begins a cache line: with a width of whole lines all rows of tiles do,
/// and are written at once (see LineRows-inl.h).
template <typename T>
using LinePixels = std::vector<T, tbb::cache_aligned_allocator<T>>;

/// The lines of one picture.
struct SilhouetteImage
{
  int width = 0;
  int height = 0;
  LinePixels<float> strength; ///< 0: no line, 1: covered by it; row by row from the bottom
  /// Index of a pixel in front of the line, for each pixel that has one; empty unless asked for.
  LinePixels<std::int32_t> front;
  /// Share of a pixel that what is in front of its line covers, where its centre shows what is
  /// behind; weighted as the strength is, and valid where that is above 0. Empty unless asked for,
  /// and with one sample a pixel.
  LinePixels<float> inside;
  /// Of each tile of DepthTileSize pixels: bit j is set if its row j has lines.
  std::vector<std::uint16_t> tileRows;
};

struct SilhouetteCounters
{
  std::size_t tiles = 0;
  std::size_t tilesSkipped = 0; ///< whose depths hold no jump above the threshold
};

struct SilhouetteOptions
{
  bool findFronts = false; ///< fill SilhouetteImage::front and ::inside
  bool skipTiles = true;   ///< off: search all tiles; the result has the same bits
};

/// Finds the lines in parallel; the result does not depend on threads. `image` keeps its memory
/// from call to call, and rows of tiles without lines are written only where they had lines before.
SilhouetteCounters findSilhouettes(const DepthSource& source, const SilhouetteRule& rule,
  SilhouetteImage& image, const SilhouetteOptions& options = {});
}

#endif
