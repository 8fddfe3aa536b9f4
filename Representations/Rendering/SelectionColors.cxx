// SPDX-License-Identifier: BSD-3-Clause
#include "SelectionColors.h"

#include "BlockTable.h"

#include "vtkHardwareSelector.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
/// 24 bits, as the hardware selector reads them: lowest byte in red.
void writeBits(std::int64_t bits, std::uint8_t* rgba)
{
  rgba[0] = static_cast<std::uint8_t>(bits & 0xff);
  rgba[1] = static_cast<std::uint8_t>((bits >> 8) & 0xff);
  rgba[2] = static_cast<std::uint8_t>((bits >> 16) & 0xff);
}

/// The selector's own colour, the same for all pixels.
void writeFlat(vtkHardwareSelector& selector, std::uint8_t* rgba)
{
  float flat[3];
  selector.GetPropColorValue(flat);
  std::transform(flat, flat + 3, rgba,
    [](float value) { return static_cast<std::uint8_t>(std::lround(255 * value)); });
}
}

void colorForSelection(vtkHardwareSelector& selector, const TracedFrame& frame,
  const std::vector<std::int64_t>& particles, vtkPolyData& points, std::vector<std::uint8_t>& rgba)
{
  const int pass = selector.GetCurrentPass();
  const BlockTable blocks = blockTableOf(points);
  if (pass == vtkHardwareSelector::COMPOSITE_INDEX_PASS && blocks.empty())
  {
    selector.RenderCompositeIndex(1);
  }
  selector.UpdateMaximumPointId(points.GetNumberOfPoints());
  selector.UpdateMaximumCellId(points.GetNumberOfPoints());
  rgba.assign(4 * frame.pixels(), 255);
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel)
  {
    if (frame.sphere[pixel] == SphereScene::None)
    {
      continue;
    }
    const std::int64_t point = particles[frame.sphere[pixel]];
    const PointBlock block = blocks.empty() ? PointBlock{} : blockOf(blocks, point);
    std::uint8_t* color = &rgba[4 * pixel];
    switch (pass)
    {
      case vtkHardwareSelector::POINT_ID_LOW24:
      case vtkHardwareSelector::CELL_ID_LOW24:
        writeBits(point - block.firstPoint, color);
        break;
      case vtkHardwareSelector::POINT_ID_HIGH24:
      case vtkHardwareSelector::CELL_ID_HIGH24:
        writeBits((point - block.firstPoint) >> 24, color);
        break;
      case vtkHardwareSelector::COMPOSITE_INDEX_PASS:
        blocks.empty() ? writeFlat(selector, color) : writeBits(block.flatIndex, color);
        break;
      default:
        writeFlat(selector, color);
    }
  }
}
}
