// SPDX-License-Identifier: BSD-3-Clause
#include "Blocks.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

namespace po
{
std::vector<vtkDataSet*> blocksWithPoints(vtkDataObject* data)
{
  std::vector<vtkDataSet*> blocks;
  const auto add = [&](vtkDataObject* leaf)
  {
    auto* block = vtkDataSet::SafeDownCast(leaf);
    if (block && block->GetNumberOfPoints() > 0)
    {
      blocks.push_back(block);
    }
  };
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
    {
      add(leaves->GetCurrentDataObject());
    }
  }
  else
  {
    add(data);
  }
  return blocks;
}

vtkSmartPointer<vtkPolyData> withoutCells(vtkPointSet& block)
{
  auto points = vtkSmartPointer<vtkPolyData>::New();
  points->SetPoints(block.GetPoints());
  points->GetPointData()->ShallowCopy(block.GetPointData());
  return points;
}
}
