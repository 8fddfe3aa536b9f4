// SPDX-License-Identifier: BSD-3-Clause
#include "BakedData.h"

#include "Blocks.h"
#include "PackedArrays.h"

#include "vtkAbstractArray.h"
#include "vtkAppendPolyData.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <mutex>
#include <unordered_map>
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
  [[nodiscard]] const std::vector<std::int32_t>& firsts() const { return firsts_; }
  /// How many tuples of the table such a texture has.
  [[nodiscard]] std::size_t tuplesAt(std::int32_t row) const { return table_.tuplesAt(row); }
  /// Of each row of the table: its place in the selection, or -1.
  [[nodiscard]] std::vector<std::int32_t> takePlaces() { return std::move(newRow_); }
  [[nodiscard]] std::size_t tuples() const { return tuples_; }

private:
  const EncodedTable& table_;
  std::vector<std::int32_t> newRow_;
  std::vector<std::int32_t> firsts_;
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
  for (const std::int32_t first : selection.firsts())
  {
    target = std::copy_n(values.data() + static_cast<std::size_t>(first) * width,
      selection.tuplesAt(first) * width, target);
  }
  return array;
}

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

/// An array that owns the memory of a vector: VTK gives it back when the last array that shares it
/// is gone.
template <typename Array, typename Value>
vtkSmartPointer<vtkDataArray> adopt(std::vector<Value>& values, std::size_t width)
{
  // Never destroyed: arrays may be gone later than what is static.
  static std::mutex& mutex = *new std::mutex;
  static auto& adopted = *new std::unordered_map<void*, std::vector<Value>>;
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(TextureTableArray);
  array->SetNumberOfComponents(static_cast<int>(width));
  const std::lock_guard<std::mutex> lock(mutex);
  std::vector<Value>& kept = adopted[values.data()];
  kept = std::move(values);
  array->SetArray(kept.data(), static_cast<vtkIdType>(kept.size()), 0,
    vtkAbstractArray::VTK_DATA_ARRAY_USER_DEFINED);
  array->SetArrayFreeFunction(
    [](void* memory)
    {
      const std::lock_guard<std::mutex> whileErased(mutex);
      adopted.erase(memory);
    });
  return array;
}

template <typename Array, typename Value>
vtkSmartPointer<vtkDataArray> takeTextures(
  std::vector<Value>& values, std::size_t width, TextureSelection& selection)
{
  if (values.empty() || selection.tuples() * width != values.size())
  {
    return copyTextures<Array>(values, width, selection);
  }
  permute(values, width, selection.takePlaces());
  return adopt<Array>(values, width);
}

/// @param isLast no other block needs the table
vtkSmartPointer<vtkDataArray> makeTable(
  EncodedTable& table, TextureSelection& selection, bool isLast)
{
  const std::size_t width = table.valuesPerTuple();
  const bool take = isLast && !table.isPacked();
  if (table.encoding == Encoding::UInt8Gamma2)
  {
    return take ? takeTextures<vtkUnsignedCharArray>(table.bytes, width, selection)
                : copyTextures<vtkUnsignedCharArray>(table.bytes, width, selection);
  }
  return take ? takeTextures<vtkFloatArray>(table.floats, width, selection)
              : copyTextures<vtkFloatArray>(table.floats, width, selection);
}

/// @param receivers of the block's points
void attachToBlock(vtkPointSet* block, const std::uint32_t* receivers, BakeResult& result,
  bool isLast, const OcclusionParameters& parameters)
{
  const vtkIdType points = block->GetNumberOfPoints();
  vtkNew<vtkFloatArray> mean;
  mean->SetName(OcclusionArray);
  mean->SetNumberOfTuples(points);
  std::transform(receivers, receivers + points, mean->GetPointer(0),
    [&](std::uint32_t i) { return i == NoReceiver ? 0.0f : result.mean[i]; });

  TextureSelection selection(result.table);
  vtkNew<vtkIntArray> index;
  index->SetName(TextureIndexArray);
  index->SetNumberOfTuples(points);
  std::transform(receivers, receivers + points, index->GetPointer(0),
    [&](std::uint32_t i) { return i == NoReceiver ? -1 : selection.use(result.rowOf[i]); });

  block->GetPointData()->AddArray(mean);
  block->GetPointData()->AddArray(index);
  block->GetFieldData()->AddArray(makeTable(result.table, selection, isLast));
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

void attachBake(const std::vector<vtkPointSet*>& blocks, const PointReceivers& receivers,
  BakeResult&& result, const OcclusionParameters& parameters)
{
  OcclusionParameters described = parameters;
  describeFormat(result.table.packed, described);
  const std::uint32_t* next = receivers.data();
  for (vtkPointSet* block : blocks)
  {
    attachToBlock(block, next, result, block == blocks.back(), described);
    next += block->GetNumberOfPoints();
  }
}
}
