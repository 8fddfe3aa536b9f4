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

void ExpectSameBytes(vtkAbstractArray* expected, vtkAbstractArray* found)
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

void ExpectRoundTrip(vtkPolyData* baked)
{
  TemporaryFolder folder;
  Write(baked, folder.File("a.exr"));
  EXPECT_EQ(folder.Count(), 1u);

  vtkNew<vtkOcclusionTextureReader> reader;
  reader->SetFileName(folder.File("a.exr").c_str());
  PolyData bare = Particles(baked);
  reader->SetInputData(bare);
  reader->Update();
  vtkPolyData* read = reader->GetOutput();
  EXPECT_EQ(read->GetPoints(), baked->GetPoints());
  for (const char* name : { "AmbientOcclusion", "AmbientOcclusionTexture" })
  {
    ExpectSameBytes(baked->GetPointData()->GetArray(name), read->GetPointData()->GetArray(name));
  }
  ExpectSameBytes(baked->GetFieldData()->GetArray("AmbientOcclusionTextures"),
    read->GetFieldData()->GetArray("AmbientOcclusionTextures"));
  ExpectSameStrings(baked->GetFieldData(), read->GetFieldData());
}

}

TEST(OcclusionTextureIO, BytesRoundTripBitExactly)
{
  // A prime number of textures leaves padding tiles; a maximum that is no power of two, rounding.
  ExpectRoundTrip(BakedBytes(1009, 131, 16, 0.73));
  ExpectRoundTrip(BakedBytes(50, 7, 5, 41234.567));
  ExpectRoundTrip(BakedBytes(50, 7, 16, 1e-9));
}

TEST(OcclusionTextureIO, EveryByteSurvivesForManyMaxima)
{
  std::mt19937 random(11);
  for (int i = 0; i < 40; ++i)
  {
    const double exponent = std::uniform_real_distribution<double>(-30.0, 30.0)(random);
    const double maximum = std::pow(10.0, exponent);
    PolyData data = BakedBytes(4, 1, 16, maximum);
    auto* table = vtkUnsignedCharArray::SafeDownCast(
      data->GetFieldData()->GetArray("AmbientOcclusionTextures"));
    for (int byte = 0; byte < 256; ++byte)
    {
      table->SetValue(byte, static_cast<unsigned char>(byte));
    }
    SCOPED_TRACE(maximum);
    ExpectRoundTrip(data);
  }
}

TEST(OcclusionTextureIO, FloatsRoundTripBitExactly)
{
  ExpectRoundTrip(BakedFloats(1009, 131, 16));
  PolyData special = BakedFloats(4, 1, 2);
  auto* table =
    vtkFloatArray::SafeDownCast(special->GetFieldData()->GetArray("AmbientOcclusionTextures"));
  table->SetValue(0, std::numeric_limits<float>::denorm_min());
  table->SetValue(1, std::numeric_limits<float>::max());
  table->SetValue(2, -0.0f);
  ExpectRoundTrip(special);
}

TEST(OcclusionTextureIO, UnusualSizesRoundTrip)
{
  ExpectRoundTrip(BakedBytes(10, 3, 1));
  ExpectRoundTrip(BakedBytes(10, 3, 64));
  ExpectRoundTrip(BakedFloats(10, 3, 7));
  ExpectRoundTrip(BakedBytes(1, 1, 16));
  ExpectRoundTrip(BakedBytes(3, 1, 16, 1.0));
  ExpectRoundTrip(BakedBytes(0, 0, 16));
  ExpectRoundTrip(BakedBytes(5, 0, 16));
}

TEST(OcclusionTextureIO, ManyTexturesRoundTrip)
{
  ExpectRoundTrip(BakedBytes(120000, 100000, 4));
}

TEST(OcclusionTextureIO, DarkTableRoundTrips)
{
  PolyData data = BakedBytes(3, 1, 4, 0.0);
  vtkUnsignedCharArray::SafeDownCast(data->GetFieldData()->GetArray("AmbientOcclusionTextures"))
    ->FillValue(0);
  ExpectRoundTrip(data);
}

TEST(OcclusionTextureIO, FileHoldsLinearValuesOfTheDocumentedEncoding)
{
  TemporaryFolder folder;
  PolyData data = BakedBytes(4, 2, 2, 0.5);
  auto* table =
    vtkUnsignedCharArray::SafeDownCast(data->GetFieldData()->GetArray("AmbientOcclusionTextures"));
  table->SetTuple4(1, 0, 51, 102, 255);
  Write(data, folder.File("a.exr"));
  vtkNew<vtkOcclusionTextureReader> reader;
  reader->SetFileName(folder.File("a.exr").c_str());
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
  PolyData baked = BakedBytes(20, 4, 8);
  Write(baked, folder.File("a.exr"));
  vtkNew<vtkOcclusionTextureReader> reader;
  reader->SetFileName(folder.File("a.exr").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(reader->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  ExpectSameBytes(baked->GetFieldData()->GetArray("AmbientOcclusionTextures"),
    reader->GetOutput()->GetFieldData()->GetArray("AmbientOcclusionTextures"));
}

TEST(OcclusionTextureIO, OneTextureNeedsOneTile)
{
  TemporaryFolder folder;
  const std::string fileName = folder.File("a.exr");
  PolyData baked = BakedFloats(40, 37, 8);
  auto* table =
    vtkFloatArray::SafeDownCast(baked->GetFieldData()->GetArray("AmbientOcclusionTextures"));
  for (vtkIdType i = 0; i < table->GetNumberOfValues(); ++i)
  {
    table->SetValue(i, i / 64 / 64.0f); // compressible: damage shows
  }
  Write(baked, fileName);

  // Everything of the other tiles is overwritten: only a reader of one tile can still succeed.
  const int kept = 23;
  const int columns = 7; // ceil(sqrt(37))
  exr_context_t context = nullptr;
  ASSERT_EQ(exr_start_read(&context, fileName.c_str(), nullptr), EXR_ERR_SUCCESS);
  Bytes bytes = ReadBytes(fileName);
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
  WriteBytes(fileName, bytes);

  vtkNew<vtkOcclusionTextureReader> reader;
  Messages messages(reader);
  reader->SetFileName(fileName.c_str());
  auto texture = reader->ReadTexture(kept);
  ASSERT_NE(texture, nullptr);
  EXPECT_EQ(
    std::memcmp(texture->GetPointer(0), table->GetPointer(kept * 64), 64 * sizeof(float)), 0);
  EXPECT_TRUE(messages.Errors.empty());
  EXPECT_EQ(reader->ReadTexture(kept + 1), nullptr);
  EXPECT_TRUE(OneMessage(messages.Errors, "damaged"));
}

TEST(OcclusionTextureIO, WritingThroughALinkKeepsTheLink)
{
  TemporaryFolder folder;
  Write(BakedBytes(4, 2, 4), folder.File("real.exr"));
  std::filesystem::create_symlink(folder.File("real.exr"), folder.File("link.exr"));
  Write(BakedBytes(40, 20, 8), folder.File("link.exr"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.File("link.exr")));
  EXPECT_EQ(po::OcclusionTextureFile(folder.File("real.exr")).ParticleCount(), 40);
}
