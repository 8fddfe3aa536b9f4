// SPDX-License-Identifier: BSD-3-Clause
#include "Blocks.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

namespace po
{
namespace
{
vtkDataSet* withPoints(vtkDataObject* data)
{
  auto* block = vtkDataSet::SafeDownCast(data);
  return block && block->GetNumberOfPoints() > 0 ? block : nullptr;
}

/// Calls f(data set, flat index) for each block that has points.
template <typename Function>
void forEachBlock(vtkCompositeDataSet* data, const Function& f)
{
  const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(data->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    if (vtkDataSet* block = withPoints(leaves->GetCurrentDataObject()))
    {
      f(block, leaves->GetCurrentFlatIndex());
    }
  }
}
}

std::vector<vtkDataSet*> blocksWithPoints(vtkDataObject* data)
{
  std::vector<vtkDataSet*> blocks;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    forEachBlock(composite, [&](vtkDataSet* block, unsigned) { blocks.push_back(block); });
  }
  else if (vtkDataSet* block = withPoints(data))
  {
    blocks.push_back(block);
  }
  return blocks;
}

std::vector<unsigned> flatIndicesOfBlocks(vtkCompositeDataSet* data)
{
  std::vector<unsigned> indices;
  forEachBlock(data, [&](vtkDataSet*, unsigned index) { indices.push_back(index); });
  return indices;
}

vtkSmartPointer<vtkPolyData> withoutCells(vtkPointSet& block)
{
  auto points = vtkSmartPointer<vtkPolyData>::New();
  points->SetPoints(block.GetPoints());
  points->GetPointData()->ShallowCopy(block.GetPointData());
  return points;
}
}
