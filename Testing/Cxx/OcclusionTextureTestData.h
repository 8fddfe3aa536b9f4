// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OcclusionTextureTestData_h
#define po_OcclusionTextureTestData_h

#include "ExrTestSupport.h"

#include "OcclusionParameters.h"
#include "vtkOcclusionTextureWriter.h"

#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

// Particles as the baking filter leaves them, with random textures.

using PolyData = vtkSmartPointer<vtkPolyData>;

inline po::OcclusionParameters someParameters(int resolution, const char* encoding, double maximum)
{
  po::OcclusionParameters parameters;
  parameters.set("version", "1");
  parameters.set("method", "Reference");
  parameters.set("resolution", resolution);
  parameters.set("seed", 1);
  parameters.set("encoding", encoding);
  parameters.set("gamma", 2.0);
  parameters.set("maximum", maximum);
  parameters.set("background", "gradient, up = (0, 0, 1)");
  return parameters;
}

template <typename Table, typename Random>
vtkSmartPointer<Table> someTable(int textures, int components, const Random& random)
{
  auto table = vtkSmartPointer<Table>::New();
  table->SetName("AmbientOcclusionTextures");
  table->SetNumberOfComponents(components);
  table->SetNumberOfTuples(textures);
  for (vtkIdType i = 0; i < table->GetNumberOfValues(); ++i)
  {
    table->SetValue(i, random());
  }
  return table;
}

inline PolyData someParticles(int particles, int textures)
{
  PolyData data = PolyData::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> means;
  means->SetName("AmbientOcclusion");
  vtkNew<vtkIntArray> rows;
  rows->SetName("AmbientOcclusionTexture");
  std::mt19937 random(7);
  for (int i = 0; i < particles; ++i)
  {
    points->InsertNextPoint(i, 0.0, 0.0);
    means->InsertNextValue(std::generate_canonical<float, 24>(random));
    rows->InsertNextValue(textures > 0 && i % 5 != 4 ? static_cast<int>(random() % textures) : -1);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(means);
  data->GetPointData()->AddArray(rows);
  return data;
}

inline PolyData bakedBytes(int particles, int textures, int side, double maximum = 1.0)
{
  PolyData data = someParticles(particles, textures);
  std::mt19937 random(3);
  data->GetFieldData()->AddArray(someTable<vtkUnsignedCharArray>(
    textures, side * side, [&]() { return static_cast<unsigned char>(random() % 256); }));
  someParameters(side, po::UInt8Gamma2, maximum).toFieldData(data->GetFieldData());
  return data;
}

inline PolyData bakedFloats(int particles, int textures, int side)
{
  PolyData data = someParticles(particles, textures);
  std::mt19937 random(4);
  data->GetFieldData()->AddArray(someTable<vtkFloatArray>(
    textures, side * side, [&]() { return std::generate_canonical<float, 24>(random); }));
  someParameters(side, po::Float32Linear, 1.0).toFieldData(data->GetFieldData());
  return data;
}

inline void write(vtkPolyData* data, const std::string& fileName)
{
  vtkNew<vtkOcclusionTextureWriter> writer;
  writer->SetInputDataObject(data);
  writer->SetFileName(fileName.c_str());
  ASSERT_EQ(writer->Write(), 1);
  ASSERT_EQ(writer->GetErrorCode(), vtkErrorCode::NoError);
}

inline PolyData particles(vtkPolyData* baked)
{
  PolyData bare = PolyData::New();
  bare->SetPoints(baked->GetPoints());
  return bare;
}

inline void expectSameStrings(vtkFieldData* expected, vtkFieldData* found)
{
  const auto entries = po::OcclusionParameters::fromFieldData(expected).entries();
  EXPECT_EQ(entries, po::OcclusionParameters::fromFieldData(found).entries());
  EXPECT_EQ(entries.front().first, "version");
}

#endif
