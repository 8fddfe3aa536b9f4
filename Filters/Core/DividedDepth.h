// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_DividedDepth_h
#define po_DividedDepth_h

#include "DepthSource.h"
#include "ProcessGroup.h"
#include "SilhouetteFinder.h"

#include <vector>

namespace po
{
/// Depths of one picture that are divided over processes in any way, the nearest of all in front:
/// what SharedSilhouettes asks of them. Tiles are numbered row by row from the lower left corner.
class DividedDepth
{
public:
  virtual ~DividedDepth() = default;

  /// Of the picture, in pixels.
  [[nodiscard]] virtual int width() const = 0;
  [[nodiscard]] virtual int height() const = 0;

  /// The range of each tile of what this process has; empty if it has nothing.
  [[nodiscard]] virtual std::vector<DepthRange> ownRanges() const = 0;

  /// Appends what this process has in some tiles.
  /// @param tiles in order
  /// @param ranges of all tiles and processes: what lies behind them is hidden and need not be told
  virtual void appendOwn(const std::vector<int>& tiles, const std::vector<DepthRange>& ranges,
    ProcessGroup::Words& words) const = 0;

  /// Takes what the processes have appended, one after the other.
  /// @param ranges of all tiles, for those that have not come
  virtual void assemble(const ProcessGroup::Words& words, std::vector<DepthRange> ranges) = 0;

  // Of what was assembled:

  /// Is nothing in sight?
  [[nodiscard]] virtual bool empty() const = 0;

  /// The range of each tile.
  [[nodiscard]] virtual const std::vector<DepthRange>& ranges() const = 0;

  /// The lines, with fronts.
  virtual void findLines(const SilhouetteRule& rule, SilhouetteImage& image) const = 0;

  /// Window depth of what a pixel shows, 0 at the near and 1 at the far plane; 1 or more: nothing.
  [[nodiscard]] virtual float windowDepth(int pixel) const = 0;

  /// The process that has what a pixel shows; 0 where there is nothing, or where it is not known.
  [[nodiscard]] virtual int processOf(int pixel) const = 0;
};
}

#endif
