// SPDX-License-Identifier: BSD-3-Clause
#include "BlockTable.h"

#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <iterator>

namespace po
{
namespace
{
constexpr const char* ArrayName = "ParticleOcclusionBlocks";
}

void setBlockTable(vtkPolyData& points, const BlockTable& table)
{
  vtkNew<vtkIdTypeArray> array;
  array->SetName(ArrayName);
  array->SetNumberOfComponents(2);
  for (const PointBlock& block : table)
  {
    array->InsertNextTuple2(block.flatIndex, static_cast<double>(block.firstPoint));
  }
  points.GetFieldData()->AddArray(array);
}

BlockTable blockTableOf(vtkPolyData& points)
{
  BlockTable table;
  auto* array = vtkIdTypeArray::SafeDownCast(points.GetFieldData()->GetArray(ArrayName));
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    table.push_back(
      { static_cast<unsigned>(array->GetTypedComponent(i, 0)), array->GetTypedComponent(i, 1) });
  }
  return table;
}

const PointBlock& blockOf(const BlockTable& table, vtkIdType point)
{
  const auto next = std::upper_bound(table.begin(), table.end(), point,
    [](vtkIdType p, const PointBlock& block) { return p < block.firstPoint; });
  return next == table.begin() ? table.front() : *std::prev(next);
}
}
