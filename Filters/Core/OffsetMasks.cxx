// SPDX-License-Identifier: BSD-3-Clause
#include "OffsetMasks.h"

#include "TexelMask.h"

namespace po
{
void OffsetMasks::build(const FacingTexels& facing, float shiftX, float shiftY)
{
  originX_ = 2 * CellsPerRadius + shiftX;
  originY_ = 2 * CellsPerRadius + shiftY;
  masks_.assign(static_cast<std::size_t>(Side) * Side * Groups, AllOfGroup);
  for (int row = 0; row < Side; ++row)
  {
    const float b = (static_cast<float>(row) + 0.5f - originY_) / CellsPerRadius;
    GroupMask* masks = masks_.data() + static_cast<std::size_t>(row) * Side * Groups;
    clearDiscs(facing, (0.5f - originX_) / CellsPerRadius, 1 / CellsPerRadius, Side, b, masks);
  }
}
}
