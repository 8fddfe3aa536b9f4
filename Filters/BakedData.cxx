// SPDX-License-Identifier: BSD-3-Clause
#include "BakedData.h"

#include "Blocks.h"

#include "vtkAppendPolyData.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace po
{
namespace
{
/// Where some blocks mark duplicate points all must, or the marks are lost when they are appended.
void ensureGhostArray(vtkPointSet& block)
{
  if (!block.GetPointGhostArray())
  {
    vtkNew<vtkUnsignedCharArray> none;
    none->SetName(vtkDataSetAttributes::GhostArrayName());
    none->SetNumberOfTuples(block.GetNumberOfPoints());
    none->Fill(0);
    block.GetPointData()->AddArray(none);
  }
}

vtkSmartPointer<vtkPolyData> appendBlocks(const std::vector<vtkPointSet*>& blocks)
{
  const bool anyGhosts = std::any_of(blocks.begin(), blocks.end(),
    [](vtkPointSet* block) { return block->GetPointGhostArray() != nullptr; });
  vtkNew<vtkAppendPolyData> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  for (vtkPointSet* block : blocks)
  {
    const vtkSmartPointer<vtkPolyData> points = withoutCells(*block);
    if (anyGhosts)
    {
      ensureGhostArray(*points);
    }
    append->AddInputData(points);
  }
  append->Update();
  return append->GetOutput();
}

/// Per-particle results in the order of the input points.
struct PointResults
{
  std::vector<std::int32_t> rowOf;
  std::vector<float> mean;
};

PointResults scatter(const SphereCloud& cloud, const BakeResult& result, std::size_t points)
{
  PointResults all{ std::vector<std::int32_t>(points, -1), std::vector<float>(points, 0.0f) };
  for (std::size_t i = 0; i < cloud.sourceIds.size(); ++i)
  {
    const auto point = static_cast<std::size_t>(cloud.sourceIds[i]);
    all.rowOf[point] = result.rowOf[i];
    all.mean[point] = result.mean[i];
  }
  return all;
}

/// The rows of the table that a block uses, numbered in the order of their first use.
class RowSelection
{
public:
  explicit RowSelection(std::int32_t rows)
    : newRow_(static_cast<std::size_t>(rows), -1)
  {
  }

  std::int32_t use(std::int32_t row)
  {
    if (row < 0)
    {
      return row;
    }
    std::int32_t& target = newRow_[static_cast<std::size_t>(row)];
    if (target < 0)
    {
      target = static_cast<std::int32_t>(used_.size());
      used_.push_back(row);
    }
    return target;
  }

  [[nodiscard]] const std::vector<std::int32_t>& used() const { return used_; }

private:
  std::vector<std::int32_t> newRow_;
  std::vector<std::int32_t> used_;
};

template <typename Array, typename Value>
vtkSmartPointer<vtkDataArray> copyRows(
  const std::vector<Value>& values, std::size_t texels, const std::vector<std::int32_t>& rows)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(TextureTableArray);
  array->SetNumberOfComponents(static_cast<int>(texels));
  array->SetNumberOfTuples(static_cast<vtkIdType>(rows.size()));
  Value* target = array->GetPointer(0);
  for (const std::int32_t row : rows)
  {
    target = std::copy_n(values.data() + static_cast<std::size_t>(row) * texels, texels, target);
  }
  return array;
}

vtkSmartPointer<vtkDataArray> copyTable(
  const EncodedTable& table, const std::vector<std::int32_t>& rows)
{
  const std::size_t texels =
    static_cast<std::size_t>(table.resolution) * static_cast<std::size_t>(table.resolution);
  return table.encoding == Encoding::UInt8Gamma2
    ? copyRows<vtkUnsignedCharArray>(table.bytes, texels, rows)
    : copyRows<vtkFloatArray>(table.floats, texels, rows);
}

void attachToBlock(vtkPointSet* block, const PointResults& all, std::size_t offset,
  const BakeResult& result, const OcclusionParameters& parameters)
{
  const vtkIdType points = block->GetNumberOfPoints();
  vtkNew<vtkFloatArray> mean;
  mean->SetName(OcclusionArray);
  mean->SetNumberOfTuples(points);
  std::copy_n(all.mean.data() + offset, points, mean->GetPointer(0));

  RowSelection selection(result.table.rows);
  vtkNew<vtkIntArray> index;
  index->SetName(TextureIndexArray);
  index->SetNumberOfTuples(points);
  std::transform(all.rowOf.data() + offset, all.rowOf.data() + offset + points,
    index->GetPointer(0), [&](std::int32_t row) { return selection.use(row); });

  block->GetPointData()->AddArray(mean);
  block->GetPointData()->AddArray(index);
  block->GetFieldData()->AddArray(copyTable(result.table, selection.used()));
  parameters.toFieldData(block->GetFieldData());
}
}

std::vector<vtkPointSet*> particleBlocks(vtkDataObject* data)
{
  if (auto* particles = vtkPointSet::SafeDownCast(data))
  {
    return { particles };
  }
  std::vector<vtkPointSet*> blocks;
  for (vtkDataSet* block : blocksWithPoints(data))
  {
    if (auto* particles = vtkPointSet::SafeDownCast(block))
    {
      blocks.push_back(particles);
    }
  }
  return blocks;
}

std::optional<ParticleInput> readBlocks(const std::vector<vtkPointSet*>& blocks,
  const RadiusSettings& settings, std::string& error, const SphereCloud* frame,
  const ProcessGroup& group)
{
  if (blocks.size() == 1)
  {
    return readSphereCloud(*blocks.front(), settings, error, frame, group);
  }
  const vtkSmartPointer<vtkPolyData> all =
    blocks.empty() ? vtkSmartPointer<vtkPolyData>::New() : appendBlocks(blocks);
  return readSphereCloud(*all, settings, error, frame, group);
}

void attachBake(const std::vector<vtkPointSet*>& blocks, const SphereCloud& cloud,
  const BakeResult& result, const OcclusionParameters& parameters)
{
  std::size_t points = 0;
  for (vtkPointSet* block : blocks)
  {
    points += static_cast<std::size_t>(block->GetNumberOfPoints());
  }
  const PointResults all = scatter(cloud, result, points);
  std::size_t offset = 0;
  for (vtkPointSet* block : blocks)
  {
    attachToBlock(block, all, offset, result, parameters);
    offset += static_cast<std::size_t>(block->GetNumberOfPoints());
  }
}
}
