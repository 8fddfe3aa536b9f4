// SPDX-License-Identifier: BSD-3-Clause
#include "BakedData.h"

#include "Blocks.h"
#include "PackedArrays.h"

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

/// The textures of a table that a block uses, one after the other in the order of their first use.
class TextureSelection
{
public:
  /// Tuples of the table that belong together.
  struct Span
  {
    std::size_t first, count;
  };

  explicit TextureSelection(const EncodedTable& table)
    : table_(table)
    , newRow_(static_cast<std::size_t>(table.rows), -1)
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
      target = static_cast<std::int32_t>(tuples_);
      spans_.push_back({ static_cast<std::size_t>(row), table_.tuplesAt(row) });
      tuples_ += spans_.back().count;
    }
    return target;
  }

  [[nodiscard]] const std::vector<Span>& spans() const { return spans_; }
  [[nodiscard]] std::size_t tuples() const { return tuples_; }

private:
  const EncodedTable& table_;
  std::vector<std::int32_t> newRow_;
  std::vector<Span> spans_;
  std::size_t tuples_ = 0;
};

template <typename Array, typename Value>
vtkSmartPointer<vtkDataArray> copyTextures(
  const std::vector<Value>& values, std::size_t width, const TextureSelection& selection)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(TextureTableArray);
  array->SetNumberOfComponents(static_cast<int>(width));
  array->SetNumberOfTuples(static_cast<vtkIdType>(selection.tuples()));
  Value* target = array->GetPointer(0);
  for (const auto& [first, count] : selection.spans())
  {
    target = std::copy_n(values.data() + first * width, count * width, target);
  }
  return array;
}

vtkSmartPointer<vtkDataArray> copyTable(
  const EncodedTable& table, const TextureSelection& selection)
{
  const std::size_t width = table.valuesPerTuple();
  return table.encoding == Encoding::UInt8Gamma2
    ? copyTextures<vtkUnsignedCharArray>(table.bytes, width, selection)
    : copyTextures<vtkFloatArray>(table.floats, width, selection);
}

void attachToBlock(vtkPointSet* block, const PointResults& all, std::size_t offset,
  const BakeResult& result, const OcclusionParameters& parameters)
{
  const vtkIdType points = block->GetNumberOfPoints();
  vtkNew<vtkFloatArray> mean;
  mean->SetName(OcclusionArray);
  mean->SetNumberOfTuples(points);
  std::copy_n(all.mean.data() + offset, points, mean->GetPointer(0));

  TextureSelection selection(result.table);
  vtkNew<vtkIntArray> index;
  index->SetName(TextureIndexArray);
  index->SetNumberOfTuples(points);
  std::transform(all.rowOf.data() + offset, all.rowOf.data() + offset + points,
    index->GetPointer(0), [&](std::int32_t row) { return selection.use(row); });

  block->GetPointData()->AddArray(mean);
  block->GetPointData()->AddArray(index);
  block->GetFieldData()->AddArray(copyTable(result.table, selection));
  block->GetFieldData()->RemoveArray(TextureBasisArray); // of an earlier bake
  if (const auto basis = basisArrayOf(result.table.packed))
  {
    block->GetFieldData()->AddArray(basis);
  }
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
  OcclusionParameters described = parameters;
  describeFormat(result.table.packed, described);
  std::size_t offset = 0;
  for (vtkPointSet* block : blocks)
  {
    attachToBlock(block, all, offset, result, described);
    offset += static_cast<std::size_t>(block->GetNumberOfPoints());
  }
}
}
