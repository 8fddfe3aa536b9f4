// SPDX-License-Identifier: BSD-3-Clause
// Any texture tables and any AmbientOcclusionParameters on what the renderer gets, and into the
// writer of texture files.
#include "FuzzBake.h"
#include "FuzzData.h"

#include "vtkOcclusionTextureWriter.h"

#include <filesystem>

namespace
{
/// Entries as they should be, with any value, and entries of any kind.
vtkSmartPointer<vtkStringArray> anyParameters(Provider& bytes)
{
  auto strings = vtkSmartPointer<vtkStringArray>::New();
  strings->SetName("AmbientOcclusionParameters");
  const std::array<const char*, 14> usual = { "resolution=2", "encoding=UInt8Gamma2", "maximum=1",
    "encoding=Float32Linear", "resolution=1", "maximum=0.5", "version=1", "gamma=2",
    "storage=VariableSize", "storage=Compressed", "storage=OneValue", "basisScale=0.01",
    "componentBits=8", "componentBits=,82" };
  for (int i = bytes.ConsumeIntegralInRange<int>(0, 8); i > 0; --i)
  {
    const auto kind = bytes.ConsumeIntegralInRange<std::size_t>(0, 21);
    std::string entry = kind < usual.size() ? usual[kind] : bytes.ConsumeRandomLengthString(24);
    const std::array<const char*, 4> keys = {
      "resolution=", "maximum=", "storage=", "componentBits="
    };
    if (kind >= 18) // a known key with any value
    {
      entry = keys[kind - 18] + entry;
    }
    strings->InsertNextValue(entry);
  }
  return strings;
}

vtkSmartPointer<vtkPolyData> anyBakedBlock(Provider& bytes)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(bytes.ConsumeIntegralInRange<vtkIdType>(0, 8));
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    points->SetPoint(i, static_cast<double>(i), 0, 0);
  }
  data->SetPoints(points);
  const auto add = [&](const char* name, vtkFieldData* to, vtkIdType usualTuples, int usualType)
  {
    const bool usual = bytes.ConsumeProbability<float>() < 0.8f;
    auto array =
      usual ? vtk::TakeSmartPointer(vtkAbstractArray::CreateArray(usualType)) : anyArrayType(bytes);
    array->SetNumberOfComponents(usualTuples >= 0 ? 1 : bytes.ConsumeIntegralInRange<int>(1, 5));
    array->SetNumberOfTuples(
      usual && usualTuples >= 0 ? usualTuples : bytes.ConsumeIntegralInRange<vtkIdType>(0, 9));
    fill(bytes, array);
    array->SetName(name);
    to->AddArray(array);
  };
  const vtkIdType count = points->GetNumberOfPoints();
  add("AmbientOcclusion", data->GetPointData(), count, VTK_FLOAT);
  add("AmbientOcclusionTexture", data->GetPointData(), count, VTK_INT);
  add("AmbientOcclusionTextures", data->GetFieldData(), -1,
    bytes.ConsumeBool() ? VTK_UNSIGNED_CHAR : VTK_FLOAT);
  if (bytes.ConsumeBool())
  {
    add("AmbientOcclusionBasis", data->GetFieldData(), -1, VTK_SHORT);
  }
  data->GetFieldData()->AddArray(anyParameters(bytes));
  addArrays(bytes, data);
  return data;
}
}

extern "C" int LLVMFuzzerInitialize(int*, char***)
{
  prepareFuzzing();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const std::string file = (std::filesystem::temp_directory_path() /
    ("ParticleOcclusion-fuzz-" + std::to_string(::getpid()) + ".exr"))
                                    .string();
  Provider bytes(data, size);
  vtkNew<vtkMultiBlockDataSet> blocks;
  const auto count = bytes.ConsumeIntegralInRange<unsigned>(1, 3);
  for (unsigned i = 0; i < count; ++i)
  {
    const auto block = anyBakedBlock(bytes);
    blocks->SetBlock(i, block);
    sampleTextures(block);
    vtkNew<vtkOcclusionTextureWriter> writer;
    ErrorCatcher errors(writer);
    writer->SetInputData(block);
    writer->SetFileName(file.c_str());
    FUZZ_REQUIRE((writer->Write() == 1) == (errors.count() == 0));
    FUZZ_REQUIRE(std::filesystem::exists(file) == (errors.count() == 0));
    std::filesystem::remove(file);
  }
  drawData(blocks);
  return 0;
}
