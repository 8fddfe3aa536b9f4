// SPDX-License-Identifier: BSD-3-Clause
/// The blocks of one bake share the memory of their texture tables.

#include "BakedTextures.h"
#include "MergedParticles.h"
#include "ParallelBakeTestSupport.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkUnsignedCharArray.h"

#include <string>
#include <utility>
#include <vector>

namespace
{
using Filter = vtkSphereAmbientOcclusion;
using Block = vtkSmartPointer<vtkPolyData>;

/// Two blocks of one bake; the filter is gone.
std::pair<Block, Block> bakedBlocks(int storage)
{
  const auto whole = mixedCloud(300);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, part(whole, [](vtkIdType i) { return i % 3 == 0; }));
  blocks->SetBlock(1, part(whole, [](vtkIdType i) { return i % 3 != 0; }));
  vtkNew<Filter> filter;
  filter->SetInputDataObject(blocks);
  filter->SetTextureResolution(8);
  filter->SetStorage(storage);
  filter->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  return { vtkPolyData::SafeDownCast(output->GetBlock(0)),
    vtkPolyData::SafeDownCast(output->GetBlock(1)) };
}

vtkUnsignedCharArray* tableOf(vtkPolyData* data)
{
  return vtkUnsignedCharArray::SafeDownCast(
    data->GetFieldData()->GetArray("AmbientOcclusionTextures"));
}
}

TEST(TableViews, BlocksOfOneBakeShareTheMemoryOfTheirTables)
{
  for (const int storage : { Filter::Full, Filter::VariableSize, Filter::Compressed })
  {
    auto [a, b] = bakedBlocks(storage);
    std::string fault;
    const auto merged = po::mergeParticles({ a, b }, fault);
    EXPECT_EQ(fault, "");
    EXPECT_EQ(tableOf(merged)->GetPointer(0), tableOf(a)->GetPointer(0));
    EXPECT_EQ(tableOf(merged)->GetNumberOfTuples(),
      tableOf(a)->GetNumberOfTuples() + tableOf(b)->GetNumberOfTuples());
    // In another order they are copied.
    const auto turned = po::mergeParticles({ b, a }, fault);
    EXPECT_NE(tableOf(turned)->GetPointer(0), tableOf(b)->GetPointer(0));
    const auto valueOf = [&](vtkPolyData* data, vtkIdType i)
    {
      return po::readBakedTextures(*data, fault)
        .textures.at(static_cast<std::size_t>(i), po::Vec3f{ 0.3f, -0.5f, 0.7f });
    };
    const vtkIdType ofA = a->GetNumberOfPoints(), ofB = b->GetNumberOfPoints();
    std::vector<float> expected;
    for (vtkIdType i = 0; i < ofA + ofB; ++i)
    {
      expected.push_back(i < ofA ? valueOf(a, i) : valueOf(b, i - ofA));
    }
    a = b = nullptr; // the memory stays
    for (vtkIdType i = 0; i < ofA + ofB; i += 7)
    {
      const float value = expected[static_cast<std::size_t>(i)];
      EXPECT_EQ(valueOf(merged, i), value);
      EXPECT_EQ(valueOf(turned, i < ofA ? ofB + i : i - ofA), value);
    }
    EXPECT_EQ(fault, "");
  }
}

TEST(TableViews, ABlockWhoseTableWasChangedIsCopied)
{
  const auto [a, b] = bakedBlocks(Filter::Full);
  auto* table = tableOf(a);
  const std::vector<unsigned char> zeros(static_cast<std::size_t>(table->GetNumberOfComponents()));
  table->InsertNextTypedTuple(zeros.data());
  std::string fault;
  const auto merged = po::mergeParticles({ a, b }, fault);
  EXPECT_EQ(fault, "");
  auto* all = tableOf(merged);
  EXPECT_NE(all->GetPointer(0), table->GetPointer(0));
  EXPECT_EQ(all->GetTypedComponent(table->GetNumberOfTuples() - 1, 0), 0);
  EXPECT_EQ(po::readBakedTextures(*merged, fault).textures.at(1, { 1, 0, 0 }),
    po::readBakedTextures(*a, fault).textures.at(1, { 1, 0, 0 }));
}
