// SPDX-License-Identifier: BSD-3-Clause
#include "GatheredParticles.h"

#include "BlockLooks.h"
#include "BlockTable.h"
#include "Blocks.h"
#include "MergedParticles.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cstddef>
#include <vector>

namespace po
{
namespace
{
using PointSets = std::vector<vtkSmartPointer<vtkPointSet>>;

/// The points of a data set; those of an image or a rectilinear grid are computed.
vtkSmartPointer<vtkPointSet> pointsOf(vtkDataSet* data)
{
  if (auto* points = vtkPointSet::SafeDownCast(data))
  {
    return points;
  }
  auto computed = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    points->SetPoint(i, data->GetPoint(i));
  }
  computed->SetPoints(points);
  computed->GetPointData()->ShallowCopy(data->GetPointData());
  computed->GetFieldData()->ShallowCopy(data->GetFieldData());
  return computed;
}

/// All blocks that have points.
PointSets blocksOf(vtkDataObject* data)
{
  PointSets blocks;
  for (vtkDataSet* block : blocksWithPoints(data))
  {
    blocks.push_back(pointsOf(block));
  }
  return blocks;
}

/// Which points are of which block.
void keepBlocks(vtkCompositeDataSet& data, const PointSets& blocks, vtkPolyData& points)
{
  const std::vector<unsigned> indices = flatIndicesOfBlocks(&data);
  BlockTable table;
  vtkIdType first = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    table.push_back({ indices[i], first });
    first += blocks[i]->GetNumberOfPoints();
  }
  setBlockTable(points, table);
  keepHierarchy(data, points);
}
}

vtkSmartPointer<vtkPolyData> gatherParticles(vtkDataObject* data, std::string& warning)
{
  const PointSets blocks = blocksOf(data);
  vtkSmartPointer<vtkPolyData> particles =
    mergeParticles({ blocks.begin(), blocks.end() }, warning);
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    keepBlocks(*composite, blocks, *particles);
  }
  return particles;
}
}
