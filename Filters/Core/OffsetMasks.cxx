// SPDX-License-Identifier: BSD-3-Clause
#include "OffsetMasks.h"

#include "TexelMask.h"

namespace po
{
void OffsetMasks::build(const FacingTexels& facing, float shiftX, float shiftY, float shiftZ)
{
  originX_ = 2 * CellsPerRadius + shiftX;
  originY_ = 2 * CellsPerRadius + shiftY;
  originZ_ = shiftZ;
  masks_.assign(static_cast<std::size_t>(Side) * Side * Groups, AllOfGroup);
  for (int row = 0; row < Side; ++row)
  {
    const float b = (static_cast<float>(row) + 0.5f - originY_) / CellsPerRadius;
    GroupMask* masks = masks_.data() + static_cast<std::size_t>(row) * Side * Groups;
    clearDiscs(facing, (0.5f - originX_) / CellsPerRadius, 1 / CellsPerRadius, Side, b, masks);
  }
  buildAbove(facing);
}

void OffsetMasks::buildAbove(const FacingTexels& facing)
{
  above_.assign(Levels * Groups, 0);
  for (int level = 0; level < Levels; ++level)
  {
    const float height = (static_cast<float>(level) + 0.5f - originZ_) / CellsPerRadius;
    GroupMask* masks = above_.data() + static_cast<std::size_t>(level) * Groups;
    for (std::size_t slot = 0; slot < facing.w.size(); ++slot)
    {
      const unsigned isAbove = facing.w[slot] >= height ? 1 : 0;
      GroupMask& mask = masks[slot / GroupSize];
      mask = static_cast<GroupMask>(mask | isAbove << (slot % GroupSize));
    }
  }
}
}
