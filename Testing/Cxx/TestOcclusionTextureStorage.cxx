// SPDX-License-Identifier: BSD-3-Clause
/// How textures lie on disk: precision, the particles that they belong to, and what is held in
/// memory on the way.

#include "OcclusionTextureTestData.h"

#include "OcclusionTextureFile.h"
#include "vtkOcclusionTextureReader.h"

#include "vtkDoubleArray.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>

namespace
{
std::string errorOfWritingHalves(vtkPolyData* data, const std::string& fileName)
{
  vtkNew<vtkOcclusionTextureWriter> writer;
  Messages messages(writer);
  writer->SetInputDataObject(data);
  writer->SetPrecision(vtkOcclusionTextureWriter::Half);
  writer->SetFileName(fileName.c_str());
  writer->Write();
  EXPECT_LE(messages.errors.size(), 1u);
  return messages.errors.empty() ? std::string() : messages.errors.front();
}

/// The table that comes back, and the warnings, of loading a file onto particles.
struct Loaded
{
  PolyData data = PolyData::New();
  std::vector<std::string> warnings;
};

Loaded load(const std::string& fileName, vtkPolyData* onto)
{
  Loaded loaded;
  vtkNew<vtkOcclusionTextureReader> reader;
  Messages messages(reader);
  reader->SetFileName(fileName.c_str());
  reader->SetInputData(onto);
  reader->Update();
  EXPECT_TRUE(messages.errors.empty());
  loaded.data->ShallowCopy(reader->GetOutput());
  loaded.warnings = messages.warnings;
  return loaded;
}

vtkDataArray* table(vtkPolyData* data)
{
  return data->GetFieldData()->GetArray("AmbientOcclusionTextures");
}

PolyData withPoints(vtkPolyData* like, int type, const std::function<double(vtkIdType, int)>& at)
{
  PolyData data = PolyData::New();
  data->ShallowCopy(like);
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  for (vtkIdType i = 0; i < like->GetNumberOfPoints(); ++i)
  {
    points->InsertNextPoint(at(i, 0), at(i, 1), at(i, 2));
  }
  data->SetPoints(points);
  return data;
}
}

TEST(OcclusionTextureStorage, HalvesKeepAllBytesOfATable)
{
  TemporaryFolder folder;
  for (const double maximum : { 1.0 / 128, 0.73, 1.0, 3.1, 60000.0 })
  {
    PolyData baked = bakedBytes(4, 1, 16, maximum);
    auto* bytes = vtkUnsignedCharArray::SafeDownCast(table(baked));
    for (int byte = 0; byte < 256; ++byte)
    {
      bytes->SetValue(byte, static_cast<unsigned char>(byte));
    }
    ASSERT_EQ(errorOfWritingHalves(baked, folder.file("a.exr")), "");
    const Loaded loaded = load(folder.file("a.exr"), baked);
    for (int byte = 0; byte < 256; ++byte)
    {
      EXPECT_EQ(table(loaded.data)->GetComponent(0, byte), byte) << maximum;
    }
  }
}

TEST(OcclusionTextureStorage, HalvesRoundFloatsByTheirPrecisionAndAreSmaller)
{
  TemporaryFolder folder;
  PolyData baked = bakedFloats(300, 200, 16);
  write(baked, folder.file("float.exr"));
  ASSERT_EQ(errorOfWritingHalves(baked, folder.file("half.exr")), "");
  const Loaded loaded = load(folder.file("half.exr"), baked);
  for (vtkIdType row = 0; row < 200; ++row)
  {
    for (int texel = 0; texel < 256; ++texel)
    {
      const double value = table(baked)->GetComponent(row, texel);
      EXPECT_NEAR(table(loaded.data)->GetComponent(row, texel), value, value / 2048 + 1e-7);
    }
  }
  const po::OcclusionTextureFile half(folder.file("half.exr"));
  EXPECT_EQ(half.precision(), po::TexelPrecision::Half);
  EXPECT_LT(std::filesystem::file_size(folder.file("half.exr")),
    0.7 * std::filesystem::file_size(folder.file("float.exr")));
}

TEST(OcclusionTextureStorage, HalvesThatWouldLoseValuesAreAnErrorAndNoFile)
{
  TemporaryFolder folder;
  EXPECT_HAS(errorOfWritingHalves(bakedBytes(4, 1, 4, 0.005), folder.file("a.exr")), "Float");
  PolyData bright = bakedFloats(4, 1, 4);
  table(bright)->SetComponent(0, 3, 65536);
  EXPECT_HAS(errorOfWritingHalves(bright, folder.file("a.exr")), "65504");
  EXPECT_EQ(folder.count(), 0u);
}

TEST(OcclusionTextureStorage, OtherParticlesGiveOneWarning)
{
  TemporaryFolder folder;
  PolyData baked = bakedBytes(40, 7, 4);
  vtkNew<vtkDoubleArray> radii;
  radii->SetName("radius");
  radii->SetNumberOfTuples(40);
  radii->Fill(0.5);
  baked->GetPointData()->AddArray(radii);
  const std::string file = folder.file("a.exr");
  write(baked, file);
  EXPECT_EQ(po::OcclusionTextureFile(file).geometry().size(), 32u);

  const auto at = [&](vtkIdType i, int axis) { return baked->GetPoint(i)[axis]; };
  EXPECT_TRUE(load(file, baked).warnings.empty());
  EXPECT_TRUE(load(file, withPoints(baked, VTK_DOUBLE, at)).warnings.empty());

  const Loaded moved = load(file,
    withPoints(baked, VTK_DOUBLE,
      [&](vtkIdType i, int axis) { return at(i, axis) + (i == 39 && axis == 2 ? 1e-6 : 0); }));
  EXPECT_TRUE(oneMessage(moved.warnings, file));
  EXPECT_EQ(table(moved.data)->GetNumberOfTuples(), 7);
  const Loaded reversed = load(
    file, withPoints(baked, VTK_FLOAT, [&](vtkIdType i, int axis) { return at(39 - i, axis); }));
  EXPECT_TRUE(oneMessage(reversed.warnings, "order"));

  PolyData larger = PolyData::New();
  larger->DeepCopy(baked);
  larger->GetPointData()->GetArray("radius")->SetComponent(5, 0, 0.6);
  EXPECT_TRUE(oneMessage(load(file, larger).warnings, "radii"));
}

TEST(OcclusionTextureStorage, ThreadsReadFromOneFileAtTheSameTime)
{
  TemporaryFolder folder;
  PolyData baked = bakedFloats(1000, 900, 8);
  write(baked, folder.file("a.exr"));
  const po::OcclusionTextureFile file(folder.file("a.exr"));
  auto* expected = vtkFloatArray::SafeDownCast(table(baked));
  std::atomic<int> different{ 0 };
  tbb::parallel_for(0, 20000,
    [&](int i)
    {
      const std::int64_t row = i * 7919LL % 900;
      float texels[64];
      file.readTexture(row, texels);
      different += std::memcmp(texels, expected->GetPointer(row * 64), sizeof(texels)) != 0;
    });
  EXPECT_EQ(different, 0);
}

#ifdef __linux__
TEST(OcclusionTextureStorage, NoSecondCopyOfATableIsHeld)
{
  TemporaryFolder folder;
  constexpr long TableMegabytes = 64;
  // Few distinct values, so that compression is fast.
  PolyData baked = someParticles(1000, TableMegabytes * 64);
  baked->GetFieldData()->AddArray(
    someTable<vtkFloatArray>(TableMegabytes * 64, 64 * 64, [] { return 0.25f; }));
  someParameters(64, po::Float32Linear, 1.0).toFieldData(baked->GetFieldData());
  const long before = peakMegabytes();
  write(baked, folder.file("a.exr"));
  EXPECT_LT(peakMegabytes(), before + TableMegabytes / 4);
  const po::OcclusionTextureFile opened(folder.file("a.exr"));
  EXPECT_LT(peakMegabytes(), before + TableMegabytes / 4);
  EXPECT_EQ(load(folder.file("a.exr"), baked).data->GetNumberOfPoints(), 1000);
  EXPECT_LT(peakMegabytes(), before + TableMegabytes + TableMegabytes / 4);
}
#endif
