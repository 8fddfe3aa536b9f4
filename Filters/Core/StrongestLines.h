// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_StrongestLines_h
#define po_StrongestLines_h

#include "SilhouetteTiles.h"

#include <cstdint>
#include <vector>

namespace po
{
/// A line in a pixel as one number, so that the stronger line has the larger number. Of lines that
/// are equally strong the result does not depend on their order either. From the top:
/// - 14 bits: the strength;
/// - 8 bits: what of the pixel lies within the rim;
/// - 10 bits: rows and columns to the pixel in front, 5 bits each, with NoStep added.
struct LineCode
{
  static constexpr int StrengthBits = 14, InsideBits = 8, StepBits = 5, FrontBits = 2 * StepBits;
  static constexpr float StrengthScale = (1 << StrengthBits) - 1,
                         InsideScale = (1 << InsideBits) - 1;
  static constexpr std::int32_t StepMask = (1 << StepBits) - 1, NoStep = 16;
  /// The pixel itself is in front.
  static constexpr std::int32_t Here = (1 << FrontBits) - 1;
};

/// The strongest line in each pixel of a block.
class StrongestLines
{
public:
  /// @param stride pixels from row to row
  void resize(int stride, int rows);

  /// By pixels: no line yet where 0. LineCode.
  [[nodiscard]] std::uint32_t* codes() { return codes_.data(); }

  /// Reads the lines of a tile.
  /// @param first pixel of the tile in the block
  /// @param x of that pixel in the picture
  /// @param rows that are read, one bit each
  /// @return the rows that have lines
  std::uint32_t read(int first, int x, int y, std::uint32_t rows, const SilhouetteImage& picture,
    TileLines& lines) const;

  /// Removes the lines of a row.
  void clearRow(int row);

private:
  int stride_ = 0;
  std::vector<std::uint32_t> codes_;
};
}

#endif
