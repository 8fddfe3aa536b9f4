// SPDX-License-Identifier: BSD-3-Clause
#ifndef BakeCacheTestSupport_h
#define BakeCacheTestSupport_h

// Bakes that are kept on disk, and what two of them have in common.

#include "BakeFilterTestSupport.h"
#include "ExrTestSupport.h"
#include "Random.h"

#include "vtkDataArray.h"
#include "vtkSphereAmbientOcclusion.h"

#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace bake_cache
{
using Filter = vtkSphereAmbientOcclusion;
using Prepare = std::function<void(Filter*)>;

constexpr int Particles = 400;

/// Overlapping spheres; all of their textures differ.
inline vtkSmartPointer<vtkPolyData> cloud(int seed = 1, int count = Particles)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("radius");
  po::Random random(static_cast<std::uint64_t>(seed), 0, 0);
  for (int i = 0; i < count; ++i)
  {
    points->InsertNextPoint(10 * random.uniform(), 10 * random.uniform(), 10 * random.uniform());
    radii->InsertNextValue(0.2 + 0.5 * random.uniform());
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(radii);
  return data;
}

/// A bake with the cache in a folder, and its warnings.
struct CachedBake
{
  vtkSmartPointer<Filter> filter = vtkSmartPointer<Filter>::New();
  std::vector<std::string> warnings;

  CachedBake(const std::string& folder, vtkPolyData* data, const Prepare& prepare = {})
  {
    Messages messages(filter);
    filter->SetController(nullptr);
    filter->SetTextureResolution(4);
    filter->SetSamplesPerTexel(4);
    filter->UseCacheOn();
    filter->SetCacheDirectory(folder.c_str());
    if (prepare)
    {
      prepare(filter);
    }
    filter->SetInputData(data);
    filter->Update();
    EXPECT_TRUE(messages.errors.empty());
    warnings = messages.warnings;
  }

  [[nodiscard]] bool loaded() const { return filter->GetLoadedFromCache(); }
  [[nodiscard]] vtkPolyData* data() const
  {
    return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  }
};

inline void expectSameBits(vtkAbstractArray* a, vtkAbstractArray* b)
{
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->GetDataType(), b->GetDataType());
  ASSERT_EQ(a->GetNumberOfComponents(), b->GetNumberOfComponents());
  ASSERT_EQ(a->GetNumberOfValues(), b->GetNumberOfValues());
  EXPECT_EQ(std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
              static_cast<std::size_t>(a->GetNumberOfValues() * a->GetDataTypeSize())),
    0)
    << a->GetName();
}

inline void expectSameStrings(vtkPolyData* a, vtkPolyData* b)
{
  const auto strings = [](vtkPolyData* data)
  {
    return vtkStringArray::SafeDownCast(
      data->GetFieldData()->GetAbstractArray("AmbientOcclusionParameters"));
  };
  ASSERT_EQ(strings(a)->GetNumberOfValues(), strings(b)->GetNumberOfValues());
  for (vtkIdType i = 0; i < strings(a)->GetNumberOfValues(); ++i)
  {
    EXPECT_EQ(strings(a)->GetValue(i), strings(b)->GetValue(i));
  }
}

inline void expectSameOutput(vtkPolyData* a, vtkPolyData* b)
{
  for (const char* name : { "AmbientOcclusion", "AmbientOcclusionTexture" })
  {
    expectSameBits(a->GetPointData()->GetArray(name), b->GetPointData()->GetArray(name));
  }
  const char* table = "AmbientOcclusionTextures";
  expectSameBits(a->GetFieldData()->GetArray(table), b->GetFieldData()->GetArray(table));
  expectSameStrings(a, b);
}
}

#endif
