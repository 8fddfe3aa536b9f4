// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_FuzzBake_h
#define po_FuzzBake_h

// What must hold of a bake, whatever went into it.

#include "FuzzSupport.h"
#include "VTKErrors.h"

#include "BakedTextures.h"
#include "Blocks.h"
#include "MergedParticles.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSphereAmbientOcclusion.h"

#include <cmath>
#include <string>
#include <vector>

/// The arrays of all blocks that have points, by address.
inline std::vector<vtkAbstractArray*> arraysOf(vtkDataObject* data)
{
  std::vector<vtkAbstractArray*> arrays;
  const auto add = [&](vtkFieldData* fields)
  {
    for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
    {
      arrays.push_back(fields->GetAbstractArray(i));
    }
  };
  for (vtkDataSet* block : po::blocksWithPoints(data))
  {
    add(block->GetPointData());
    add(block->GetFieldData());
  }
  return arrays;
}

/// The arrays of the data contract on one block.
inline void requireContract(vtkDataSet* block)
{
  vtkDataArray* mean = block->GetPointData()->GetArray("AmbientOcclusion");
  vtkDataArray* row = block->GetPointData()->GetArray("AmbientOcclusionTexture");
  vtkDataArray* table = block->GetFieldData()->GetArray("AmbientOcclusionTextures");
  FUZZ_REQUIRE(mean && row && table);
  FUZZ_REQUIRE(block->GetFieldData()->GetAbstractArray("AmbientOcclusionParameters"));
  FUZZ_REQUIRE(mean->GetNumberOfTuples() == block->GetNumberOfPoints());
  FUZZ_REQUIRE(row->GetNumberOfTuples() == block->GetNumberOfPoints());
  for (vtkIdType i = 0; i < block->GetNumberOfPoints(); ++i)
  {
    FUZZ_REQUIRE(row->GetComponent(i, 0) >= -1);
    FUZZ_REQUIRE(row->GetComponent(i, 0) < static_cast<double>(table->GetNumberOfTuples()));
    FUZZ_REQUIRE(std::isfinite(mean->GetComponent(i, 0)) && mean->GetComponent(i, 0) >= 0);
  }
  for (vtkIdType i = 0; i < table->GetNumberOfTuples(); ++i)
  {
    for (int texel = 0; texel < table->GetNumberOfComponents(); ++texel)
    {
      FUZZ_REQUIRE(std::isfinite(table->GetComponent(i, texel)));
    }
  }
}

/// Looks at every particle from some sides, as the renderer does.
inline void sampleTextures(vtkPointSet* points)
{
  std::string warning;
  const po::BakedTextures baked = po::readBakedTextures(*points, warning);
  FUZZ_REQUIRE(warning.empty() || baked.textures.empty());
  volatile float sum = 0;
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    for (const po::Vec3f direction : { po::Vec3f{ 0, 0, 1 }, po::Vec3f{ 0, 0, -1 },
           po::Vec3f{ 1, 0, 0 }, po::Vec3f{ -1, -1e-7f, 0.5f }, po::Vec3f{ 0, 0, 0 } })
    {
      sum = sum + baked.textures.at(static_cast<std::size_t>(i), direction);
    }
  }
}

/// Merges the blocks as the representation does, and looks at them.
inline void drawData(vtkDataObject* data)
{
  std::vector<vtkPointSet*> blocks;
  for (vtkDataSet* block : po::blocksWithPoints(data))
  {
    if (auto* points = vtkPointSet::SafeDownCast(block))
    {
      blocks.push_back(points);
    }
  }
  std::string warning;
  const auto merged = po::mergeParticles(blocks, warning);
  sampleTextures(merged);
}

/// Bakes; then there is one error and the input as it came, or all that the contract promises.
inline void bakeAndCheck(vtkSphereAmbientOcclusion* filter, vtkDataObject* input)
{
  ErrorCatcher errors(filter);
  filter->SetInputDataObject(input);
  filter->Update();
  vtkDataObject* output = filter->GetOutputDataObject(0);
  FUZZ_REQUIRE(errors.count() <= 1);
  FUZZ_REQUIRE(output != nullptr);
  if (errors.count() == 1)
  {
    FUZZ_REQUIRE(filter->GetErrorCode() != 0);
    FUZZ_REQUIRE(arraysOf(output) == arraysOf(input));
    return;
  }
  for (vtkDataSet* block : po::blocksWithPoints(output))
  {
    if (vtkPolyData::SafeDownCast(block))
    {
      requireContract(block);
    }
  }
  drawData(output);
}

#endif
