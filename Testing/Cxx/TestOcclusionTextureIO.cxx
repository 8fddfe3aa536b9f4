// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionTextureTestData.h"

#include "OcclusionTextureFile.h"
#include "vtkOcclusionTextureReader.h"

#include <openexr.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace
{
void expectSameBytes(vtkAbstractArray* expected, vtkAbstractArray* found)
{
  ASSERT_NE(expected, nullptr);
  ASSERT_NE(found, nullptr);
  ASSERT_EQ(expected->GetDataType(), found->GetDataType());
  ASSERT_EQ(expected->GetNumberOfComponents(), found->GetNumberOfComponents());
  ASSERT_EQ(expected->GetNumberOfTuples(), found->GetNumberOfTuples());
  const std::size_t bytes = expected->GetDataTypeSize() * expected->GetNumberOfValues();
  if (bytes > 0)
  {
    EXPECT_EQ(std::memcmp(expected->GetVoidPointer(0), found->GetVoidPointer(0), bytes), 0)
      << expected->GetName();
  }
}

void expectRoundTrip(vtkPolyData* baked)
{
  TemporaryFolder folder;
  write(baked, folder.file("a.exr"));
  EXPECT_EQ(folder.count(), 1u);

  vtkNew<vtkOcclusionTextureReader> reader;
  reader->SetFileName(folder.file("a.exr").c_str());
  PolyData bare = particles(baked);
  reader->SetInputData(bare);
  reader->Update();
  vtkPolyData* read = reader->GetOutput();
  EXPECT_EQ(read->GetPoints(), baked->GetPoints());
  for (const char* name : { "AmbientOcclusion", "AmbientOcclusionTexture" })
  {
    expectSameBytes(baked->GetPointData()->GetArray(name), read->GetPointData()->GetArray(name));
  }
  expectSameBytes(baked->GetFieldData()->GetArray("AmbientOcclusionTextures"),
    read->GetFieldData()->GetArray("AmbientOcclusionTextures"));
  expectSameStrings(baked->GetFieldData(), read->GetFieldData());
}
}

TEST(OcclusionTextureIO, BytesRoundTripBitExactly)
{
  // A prime number of textures leaves padding tiles; a maximum that is no power of two, rounding.
  expectRoundTrip(bakedBytes(1009, 131, 16, 0.73));
  expectRoundTrip(bakedBytes(50, 7, 5, 41234.567));
  expectRoundTrip(bakedBytes(50, 7, 16, 1e-9));
}

TEST(OcclusionTextureIO, EveryByteSurvivesForManyMaxima)
{
  std::mt19937 random(11);
  for (int i = 0; i < 40; ++i)
  {
    const double exponent = std::uniform_real_distribution<double>(-30.0, 30.0)(random);
    const double maximum = std::pow(10.0, exponent);
    PolyData data = bakedBytes(4, 1, 16, maximum);
    auto* table = vtkUnsignedCharArray::SafeDownCast(
      data->GetFieldData()->GetArray("AmbientOcclusionTextures"));
    for (int byte = 0; byte < 256; ++byte)
    {
      table->SetValue(byte, static_cast<unsigned char>(byte));
    }
    SCOPED_TRACE(maximum);
    expectRoundTrip(data);
  }
}

TEST(OcclusionTextureIO, FloatsRoundTripBitExactly)
{
  expectRoundTrip(bakedFloats(1009, 131, 16));
  PolyData special = bakedFloats(4, 1, 2);
  auto* table =
    vtkFloatArray::SafeDownCast(special->GetFieldData()->GetArray("AmbientOcclusionTextures"));
  table->SetValue(0, std::numeric_limits<float>::denorm_min());
  table->SetValue(1, std::numeric_limits<float>::max());
  table->SetValue(2, -0.0f);
  expectRoundTrip(special);
}

TEST(OcclusionTextureIO, UnusualSizesRoundTrip)
{
  expectRoundTrip(bakedBytes(10, 3, 1));
  expectRoundTrip(bakedBytes(10, 3, 64));
  expectRoundTrip(bakedFloats(10, 3, 7));
  expectRoundTrip(bakedBytes(1, 1, 16));
  expectRoundTrip(bakedBytes(3, 1, 16, 1.0));
  expectRoundTrip(bakedBytes(0, 0, 16));
  expectRoundTrip(bakedBytes(5, 0, 16));
}

TEST(OcclusionTextureIO, ManyTexturesRoundTrip)
{
  expectRoundTrip(bakedBytes(120000, 100000, 4));
}

TEST(OcclusionTextureIO, DarkTableRoundTrips)
{
  PolyData data = bakedBytes(3, 1, 4, 0.0);
  vtkUnsignedCharArray::SafeDownCast(data->GetFieldData()->GetArray("AmbientOcclusionTextures"))
    ->FillValue(0);
  expectRoundTrip(data);
}

TEST(OcclusionTextureIO, FileHoldsLinearValuesOfTheDocumentedEncoding)
{
  TemporaryFolder folder;
  PolyData data = bakedBytes(4, 2, 2, 0.5);
  auto* table =
    vtkUnsignedCharArray::SafeDownCast(data->GetFieldData()->GetArray("AmbientOcclusionTextures"));
  table->SetTuple4(1, 0, 51, 102, 255);
  write(data, folder.file("a.exr"));
  vtkNew<vtkOcclusionTextureReader> reader;
  reader->SetFileName(folder.file("a.exr").c_str());
  auto texture = reader->ReadTexture(1);
  ASSERT_NE(texture, nullptr);
  EXPECT_EQ(texture->GetComponent(0, 0), 0.0f);
  EXPECT_FLOAT_EQ(texture->GetComponent(0, 1), 0.5 * 0.2 * 0.2);
  EXPECT_FLOAT_EQ(texture->GetComponent(0, 2), 0.5 * 0.4 * 0.4);
  EXPECT_FLOAT_EQ(texture->GetComponent(0, 3), 0.5);
}

TEST(OcclusionTextureIO, ReaderWithoutInputGivesFieldDataOnly)
{
  TemporaryFolder folder;
  PolyData baked = bakedBytes(20, 4, 8);
  write(baked, folder.file("a.exr"));
  vtkNew<vtkOcclusionTextureReader> reader;
  reader->SetFileName(folder.file("a.exr").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(reader->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  expectSameBytes(baked->GetFieldData()->GetArray("AmbientOcclusionTextures"),
    reader->GetOutput()->GetFieldData()->GetArray("AmbientOcclusionTextures"));
}

TEST(OcclusionTextureIO, OneTextureNeedsOneTile)
{
  TemporaryFolder folder;
  const std::string fileName = folder.file("a.exr");
  PolyData baked = bakedFloats(40, 37, 8);
  auto* table =
    vtkFloatArray::SafeDownCast(baked->GetFieldData()->GetArray("AmbientOcclusionTextures"));
  for (vtkIdType i = 0; i < table->GetNumberOfValues(); ++i)
  {
    table->SetValue(i, i / 64 / 64.0f); // compressible: damage shows
  }
  write(baked, fileName);

  // Everything of the other tiles is overwritten: only a reader of one tile can still succeed.
  const int kept = 23;
  const int columns = 7; // ceil(sqrt(37))
  exr_context_t context = nullptr;
  ASSERT_EQ(exr_start_read(&context, fileName.c_str(), nullptr), EXR_ERR_SUCCESS);
  Bytes bytes = readBytes(fileName);
  for (int tile = 0; tile < 37; ++tile)
  {
    exr_chunk_info_t chunk = {};
    ASSERT_EQ(exr_read_tile_chunk_info(context, 0, tile % columns, tile / columns, 0, 0, &chunk),
      EXR_ERR_SUCCESS);
    if (tile != kept)
    {
      std::fill_n(bytes.begin() + chunk.data_offset, chunk.packed_size, '\xff');
    }
  }
  exr_finish(&context);
  writeBytes(fileName, bytes);

  vtkNew<vtkOcclusionTextureReader> reader;
  Messages messages(reader);
  reader->SetFileName(fileName.c_str());
  auto texture = reader->ReadTexture(kept);
  ASSERT_NE(texture, nullptr);
  EXPECT_EQ(
    std::memcmp(texture->GetPointer(0), table->GetPointer(kept * 64), 64 * sizeof(float)), 0);
  EXPECT_TRUE(messages.errors.empty());
  EXPECT_EQ(reader->ReadTexture(kept + 1), nullptr);
  EXPECT_TRUE(oneMessage(messages.errors, "damaged"));
}

TEST(OcclusionTextureIO, WritingThroughALinkKeepsTheLink)
{
  TemporaryFolder folder;
  write(bakedBytes(4, 2, 4), folder.file("real.exr"));
  std::filesystem::create_symlink(folder.file("real.exr"), folder.file("link.exr"));
  write(bakedBytes(40, 20, 8), folder.file("link.exr"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link.exr")));
  EXPECT_EQ(po::OcclusionTextureFile(folder.file("real.exr")).particleCount(), 40);
}
