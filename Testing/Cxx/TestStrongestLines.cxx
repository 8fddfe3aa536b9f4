// SPDX-License-Identifier: BSD-3-Clause
#include "StrongestLines.h"

#include <gtest/gtest.h>

using namespace po;

namespace
{
constexpr int Stride = 24, Rows = 20;

std::uint32_t codeOf(int strength, int inside, int columns, int rows)
{
  const int front = (rows + LineCode::NoStep) << LineCode::StepBits | (columns + LineCode::NoStep);
  return static_cast<std::uint32_t>(strength) << (32 - LineCode::StrengthBits) |
    static_cast<std::uint32_t>(inside) << LineCode::FrontBits | static_cast<std::uint32_t>(front);
}

/// A picture of 40 x 30 pixels, and a block from pixel (12, 14) on: its tile is that of column 1,
/// row 1 of the picture, four pixels to the right and two up in the block.
struct Block
{
  static constexpr int FirstX = 16, FirstY = 16, InBlock = 2 * Stride + 4;
  StrongestLines lines;
  TileLines tile{};
  SilhouetteImage picture;

  Block()
  {
    lines.resize(Stride, Rows);
    picture.width = 40;
    picture.height = 30;
  }

  std::uint32_t& at(int i, int j) { return lines.codes()[InBlock + j * Stride + i]; }

  std::uint32_t read(std::uint32_t rows)
  {
    return lines.read(InBlock, FirstX, FirstY, rows, picture, tile);
  }
};
}

TEST(StrongestLines, AreReadAsTheyWereWritten)
{
  Block block;
  block.at(5, 3) = codeOf(16383, 0, -9, 9);
  block.at(15, 3) = codeOf(1, 255, 2, -3);
  block.at(0, 7) = codeOf(8000, 51, 0, 0);
  EXPECT_EQ(block.read(0xFFFF), 1U << 3 | 1U << 7);
  const auto at = [](int i, int j) { return static_cast<std::size_t>(TileLines::indexOf(i, j)); };
  EXPECT_FLOAT_EQ(block.tile.strength[at(5, 3)], 1);
  EXPECT_FLOAT_EQ(block.tile.strength[at(15, 3)], 1 / 16383.0F);
  EXPECT_FLOAT_EQ(block.tile.strength[at(0, 7)], 8000 / 16383.0F);
  EXPECT_EQ(block.tile.strength[at(6, 3)], 0);
  EXPECT_FLOAT_EQ(block.tile.inside[at(15, 3)], 1);
  EXPECT_FLOAT_EQ(block.tile.inside[at(0, 7)], 0.2F);
  EXPECT_EQ(block.tile.front[at(5, 3)], 28 * 40 + 12);
  EXPECT_EQ(block.tile.front[at(15, 3)], 16 * 40 + 33);
  EXPECT_EQ(block.tile.front[at(0, 7)], 23 * 40 + 16);
}

TEST(StrongestLines, OnlyRowsThatAreAskedForAreRead)
{
  Block block;
  block.at(1, 2) = block.at(1, 4) = codeOf(100, 0, 0, 0);
  EXPECT_EQ(block.read(1U << 4 | 1U << 5), 1U << 4);
}

TEST(StrongestLines, FrontsBeyondThePictureAreItsBorder)
{
  Block block;
  block.at(15, 13) = codeOf(9, 0, 9, 9);
  EXPECT_EQ(block.read(0xFFFF), 1U << 13);
  const auto at = static_cast<std::size_t>(TileLines::indexOf(15, 13));
  EXPECT_EQ(block.tile.front[at], 29 * 40 + 39);
}

TEST(StrongestLines, APixelMayBeItsOwnFront)
{
  Block block;
  block.at(3, 1) = codeOf(9, 0, -1, 1) | static_cast<std::uint32_t>(LineCode::Here);
  EXPECT_EQ(block.read(0xFFFF), 1U << 1);
  const auto at = static_cast<std::size_t>(TileLines::indexOf(3, 1));
  EXPECT_EQ(block.tile.front[at], 17 * 40 + 19);
}

TEST(StrongestLines, TheStrongerLineHasTheLargerNumber)
{
  EXPECT_GT(codeOf(2, 0, -9, -9), codeOf(1, 255, 9, 9));
  EXPECT_GT(codeOf(2, 1, -9, -9), codeOf(2, 0, 9, 9));
}

TEST(StrongestLines, AreRemovedRowByRow)
{
  Block block;
  block.at(3, 1) = block.at(3, 2) = codeOf(9, 0, 0, 0);
  block.lines.clearRow(2 + 1);
  EXPECT_EQ(block.read(0xFFFF), 1U << 2);
}
