// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakeOutcome_h
#define po_BakeOutcome_h

// What came out of a bake: all of it, or the input as it came.

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

inline std::vector<vtkPolyData*> blocksOf(vtkDataObject* data)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    return { vtkPolyData::SafeDownCast(data) };
  }
  std::vector<vtkPolyData*> blocks;
  const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    blocks.push_back(vtkPolyData::SafeDownCast(leaves->GetCurrentDataObject()));
  }
  return blocks;
}

inline void expectSameArrays(vtkFieldData* expected, vtkFieldData* found)
{
  ASSERT_EQ(found->GetNumberOfArrays(), expected->GetNumberOfArrays());
  for (int i = 0; i < expected->GetNumberOfArrays(); ++i)
  {
    EXPECT_EQ(found->GetAbstractArray(i), expected->GetAbstractArray(i));
  }
}

/// The very arrays of the input, no more and no less.
inline void expectPassedOn(vtkDataObject* input, vtkDataObject* output)
{
  const auto expected = blocksOf(input);
  const auto found = blocksOf(output);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    ASSERT_TRUE(found[i]);
    EXPECT_EQ(found[i]->GetPoints(), expected[i]->GetPoints());
    expectSameArrays(expected[i]->GetPointData(), found[i]->GetPointData());
    expectSameArrays(expected[i]->GetFieldData(), found[i]->GetFieldData());
  }
}

/// All that a bake has added, as bytes; empty if any block lacks any of it.
inline std::string bitsOf(vtkDataObject* output)
{
  std::string bits;
  for (vtkPolyData* block : blocksOf(output))
  {
    vtkDataArray* arrays[] = { block->GetPointData()->GetArray("AmbientOcclusion"),
      block->GetPointData()->GetArray("AmbientOcclusionTexture"),
      block->GetFieldData()->GetArray("AmbientOcclusionTextures") };
    for (vtkDataArray* array : arrays)
    {
      if (!array || !block->GetFieldData()->HasArray("AmbientOcclusionParameters"))
      {
        return {};
      }
      bits.append(static_cast<const char*>(array->GetVoidPointer(0)),
        static_cast<std::size_t>(array->GetNumberOfValues()) * array->GetDataTypeSize());
    }
  }
  return bits;
}

#endif
