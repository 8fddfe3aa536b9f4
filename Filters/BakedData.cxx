// SPDX-License-Identifier: BSD-3-Clause
#include "BakedData.h"

#include "Blocks.h"
#include "PackedArrays.h"
#include "TableViews.h"

#include "vtkAppendPolyData.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <memory>
#include <utility>

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

/// The textures of a table that a block uses, one after the other in the order of their first use.
class TextureSelection
{
public:
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
      firsts_.push_back(row);
      tuples_ += table_.tuplesAt(row);
    }
    return target;
  }

  /// The rows at which its textures begin, in order.
  [[nodiscard]] std::vector<std::int32_t> takeFirsts() { return std::move(firsts_); }
  /// Of each row of the table: its place in the selection, or -1.
  [[nodiscard]] std::vector<std::int32_t> takePlaces() { return std::move(newRow_); }
  [[nodiscard]] std::size_t tuples() const { return tuples_; }

private:
  const EncodedTable& table_;
  std::vector<std::int32_t> newRow_;
  std::vector<std::int32_t> firsts_;
  std::size_t tuples_ = 0;
};

/// Brings tuples to their places, without a copy of all.
template <typename Value>
void permute(std::vector<Value>& values, std::size_t width, std::vector<std::int32_t> places)
{
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    while (places[i] != static_cast<std::int32_t>(i))
    {
      const auto target = static_cast<std::size_t>(places[i]);
      std::swap_ranges(
        values.data() + i * width, values.data() + (i + 1) * width, values.data() + target * width);
      std::swap(places[i], places[target]);
    }
  }
}

/// The textures that a block uses: the rows at which they begin, in order.
struct BlockTextures
{
  std::vector<std::int32_t> firsts;
  std::size_t tuples = 0;
};

/// A view of each block's textures in one table, which is made of `values`; block after block, so
/// that mergeParticles() can join them.
template <typename Value>
std::vector<vtkSmartPointer<vtkDataArray>> shareTable(const std::vector<Value>& values,
  const EncodedTable& table, const std::vector<BlockTextures>& blocks)
{
  const std::size_t width = table.valuesPerTuple();
  std::size_t tuples = 0;
  for (const BlockTextures& block : blocks)
  {
    tuples += block.tuples;
  }
  auto shared = std::make_shared<std::vector<Value>>();
  shared->reserve(tuples * width);
  for (const BlockTextures& block : blocks)
  {
    for (const std::int32_t first : block.firsts)
    {
      const Value* texture = values.data() + static_cast<std::size_t>(first) * width;
      shared->insert(shared->end(), texture, texture + table.tuplesAt(first) * width);
    }
  }
  std::vector<vtkSmartPointer<vtkDataArray>> views;
  std::size_t first = 0;
  for (const BlockTextures& block : blocks)
  {
    views.push_back(viewTable(shared, first, block.tuples, static_cast<int>(width)));
    first += block.tuples;
  }
  return views;
}

/// Adds means and rows to a block.
/// @param receivers of the block's points
void attachToPoints(vtkPointSet* block, const std::uint32_t* receivers, const BakeResult& result,
  TextureSelection& selection)
{
  const vtkIdType points = block->GetNumberOfPoints();
  vtkNew<vtkFloatArray> mean;
  mean->SetName(OcclusionArray);
  mean->SetNumberOfTuples(points);
  std::transform(receivers, receivers + points, mean->GetPointer(0),
    [&](std::uint32_t i) { return i == NoReceiver ? 0.0f : result.mean[i]; });
  vtkNew<vtkIntArray> index;
  index->SetName(TextureIndexArray);
  index->SetNumberOfTuples(points);
  std::transform(receivers, receivers + points, index->GetPointer(0),
    [&](std::uint32_t i) { return i == NoReceiver ? -1 : selection.use(result.rowOf[i]); });
  block->GetPointData()->AddArray(mean);
  block->GetPointData()->AddArray(index);
}

void attachTable(vtkPointSet* block, vtkDataArray* table, const PackedFormat& format,
  const OcclusionParameters& parameters)
{
  block->GetFieldData()->AddArray(table);
  block->GetFieldData()->RemoveArray(TextureBasisArray); // of an earlier bake
  if (const auto basis = basisArrayOf(format))
  {
    block->GetFieldData()->AddArray(basis);
  }
  parameters.toFieldData(block->GetFieldData());
}

/// The table of a block that uses all of it, as it is but for the order.
template <typename Value>
vtkSmartPointer<vtkDataArray> takeTable(
  std::vector<Value>& values, std::size_t width, std::vector<std::int32_t> places)
{
  const std::size_t tuples = places.size();
  permute(values, width, std::move(places));
  return viewTable(
    std::make_shared<std::vector<Value>>(std::move(values)), 0, tuples, static_cast<int>(width));
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
  const RadiusSettings& settings, std::string& error, const FrameChoice& frame,
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

void attachBake(const std::vector<vtkPointSet*>& blocks, const PointReceivers& receivers,
  BakeResult&& result, const OcclusionParameters& parameters)
{
  OcclusionParameters described = parameters;
  describeFormat(result.table.packed, described);
  EncodedTable& table = result.table;
  const bool areBytes = table.encoding == Encoding::UInt8Gamma2;
  std::vector<BlockTextures> textures;
  std::vector<vtkSmartPointer<vtkDataArray>> tables;
  const std::uint32_t* next = receivers.data();
  for (vtkPointSet* block : blocks)
  {
    TextureSelection selection(table);
    attachToPoints(block, next, result, selection);
    next += block->GetNumberOfPoints();
    const bool usesAll = selection.tuples() == static_cast<std::size_t>(table.rows);
    if (blocks.size() == 1 && !table.isPacked() && usesAll)
    {
      const std::size_t width = table.valuesPerTuple();
      tables.push_back(areBytes ? takeTable(table.bytes, width, selection.takePlaces())
                                : takeTable(table.floats, width, selection.takePlaces()));
      break;
    }
    const std::size_t tuples = selection.tuples();
    textures.push_back({ selection.takeFirsts(), tuples });
  }
  if (tables.empty())
  {
    tables = areBytes ? shareTable(table.bytes, table, textures)
                      : shareTable(table.floats, table, textures);
  }
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    attachTable(blocks[i], tables[i], table.packed, described);
  }
}
}
