// SPDX-License-Identifier: BSD-3-Clause
#include "ExrTestSupport.h"

#include "OcclusionParameters.h"
#include "OcclusionTextureFile.h"
#include "vtkOcclusionTextureReader.h"
#include "vtkOcclusionTextureWriter.h"

#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <openexr.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace
{

using PolyData = vtkSmartPointer<vtkPolyData>;

po::OcclusionParameters SomeParameters(int resolution, const char* encoding, double maximum)
{
  po::OcclusionParameters parameters;
  parameters.Set("version", "1");
  parameters.Set("method", "Reference");
  parameters.Set("resolution", resolution);
  parameters.Set("seed", 1);
  parameters.Set("encoding", encoding);
  parameters.Set("gamma", 2.0);
  parameters.Set("maximum", maximum);
  parameters.Set("background", "gradient, up = (0, 0, 1)");
  return parameters;
}

template <typename Table, typename Random>
vtkSmartPointer<Table> SomeTable(int textures, int components, const Random& random)
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

PolyData SomeParticles(int particles, int textures)
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

PolyData BakedBytes(int particles, int textures, int side, double maximum = 1.0)
{
  PolyData data = SomeParticles(particles, textures);
  std::mt19937 random(3);
  data->GetFieldData()->AddArray(SomeTable<vtkUnsignedCharArray>(
    textures, side * side, [&]() { return static_cast<unsigned char>(random() % 256); }));
  SomeParameters(side, po::UInt8Gamma2, maximum).ToFieldData(data->GetFieldData());
  return data;
}

PolyData BakedFloats(int particles, int textures, int side)
{
  PolyData data = SomeParticles(particles, textures);
  std::mt19937 random(4);
  data->GetFieldData()->AddArray(SomeTable<vtkFloatArray>(
    textures, side * side, [&]() { return std::generate_canonical<float, 24>(random); }));
  SomeParameters(side, po::Float32Linear, 1.0).ToFieldData(data->GetFieldData());
  return data;
}

void Write(vtkPolyData* data, const std::string& fileName)
{
  vtkNew<vtkOcclusionTextureWriter> writer;
  writer->SetInputDataObject(data);
  writer->SetFileName(fileName.c_str());
  ASSERT_EQ(writer->Write(), 1);
  ASSERT_EQ(writer->GetErrorCode(), vtkErrorCode::NoError);
}

PolyData Particles(vtkPolyData* baked)
{
  PolyData bare = PolyData::New();
  bare->SetPoints(baked->GetPoints());
  return bare;
}

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

void ExpectSameStrings(vtkFieldData* expected, vtkFieldData* found)
{
  const auto entries = po::OcclusionParameters::FromFieldData(expected).Entries();
  EXPECT_EQ(entries, po::OcclusionParameters::FromFieldData(found).Entries());
  EXPECT_EQ(entries.front().first, "version");
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

std::string ErrorOfReading(const std::string& fileName, vtkPolyData* input = nullptr)
{
  vtkNew<vtkOcclusionTextureReader> reader;
  Messages messages(reader);
  Messages pipeline(reader->GetExecutive());
  reader->SetFileName(fileName.c_str());
  reader->SetInputData(input);
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
  EXPECT_NE(reader->GetErrorCode(), vtkErrorCode::NoError);
  return messages.Errors.empty() ? std::string() : messages.Errors.front();
}

std::string ErrorOfWriting(vtkPolyData* data, const std::string& fileName)
{
  vtkNew<vtkOcclusionTextureWriter> writer;
  Messages messages(writer);
  writer->SetInputDataObject(data);
  writer->SetFileName(fileName.c_str());
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_NE(writer->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_EQ(messages.Errors.size(), 1u);
  return messages.Errors.empty() ? std::string() : messages.Errors.front();
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

TEST(OcclusionTextureIO, RowOutOfRangeIsAnError)
{
  TemporaryFolder folder;
  Write(BakedBytes(4, 3, 4), folder.File("a.exr"));
  vtkNew<vtkOcclusionTextureReader> reader;
  Messages messages(reader);
  reader->SetFileName(folder.File("a.exr").c_str());
  EXPECT_EQ(reader->ReadTexture(3), nullptr);
  EXPECT_TRUE(OneMessage(messages.Errors, "choose 0 to 2"));
  EXPECT_EQ(reader->ReadTexture(-1), nullptr);
}

TEST(OcclusionTextureIO, OtherNumberOfPointsIsAnError)
{
  TemporaryFolder folder;
  Write(BakedBytes(10, 3, 4), folder.File("a.exr"));
  EXPECT_HAS(
    ErrorOfReading(folder.File("a.exr"), SomeParticles(9, 3)), "10 particles, but the input has 9");
}

TEST(OcclusionTextureIO, ForeignFilesAreErrorsThatNameThem)
{
  TemporaryFolder folder;
  const auto file = [&](const char* name, const std::string& text)
  {
    WriteBytes(folder.File(name), Bytes(text.begin(), text.end()));
    return ErrorOfReading(folder.File(name));
  };
  EXPECT_HAS(file("a.png", "\x89PNG\r\n\x1a\n and more"), "not an OpenEXR file");
  EXPECT_HAS(file("text.exr", "x y z\n1 2 3\n"), "not an OpenEXR file");
  EXPECT_HAS(file("text.exr", "x y z\n1 2 3\n"), "text.exr");
  EXPECT_HAS(file("empty.exr", ""), "not an OpenEXR file");
  EXPECT_HAS(file("short.exr", "v/1\x01"), "header is damaged");
  EXPECT_HAS(ErrorOfReading(folder.File("")), "not a file");
  EXPECT_HAS(ErrorOfReading(folder.File("none.exr")), "no such file");
  EXPECT_HAS(ErrorOfReading(""), "No file name");
}

TEST(OcclusionTextureIO, DamagedFilesNeverCrash)
{
  TemporaryFolder folder;
  for (PolyData baked : { BakedBytes(300, 20, 8), BakedFloats(30, 11, 5) })
  {
    Write(baked, folder.File("whole.exr"));
    const Bytes whole = ReadBytes(folder.File("whole.exr"));
    int read = 0;
    int refused = 0;
    PolyData bare = Particles(baked);
    ForEachDamage(whole, 300,
      [&](const Bytes& damaged)
      {
        WriteBytes(folder.File("damaged.exr"), damaged);
        vtkNew<vtkOcclusionTextureReader> reader;
        Messages messages(reader);
        Messages pipeline(reader->GetExecutive());
        reader->SetFileName(folder.File("damaged.exr").c_str());
        reader->SetInputData(bare);
        reader->Update();
        const bool failed = reader->GetErrorCode() != vtkErrorCode::NoError;
        EXPECT_EQ(failed, !messages.Errors.empty());
        EXPECT_LE(messages.Errors.size(), 1u);
        if (!failed)
        {
          EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), bare->GetNumberOfPoints());
          EXPECT_NE(
            reader->GetOutput()->GetFieldData()->GetArray("AmbientOcclusionTextures"), nullptr);
        }
        ++(failed ? refused : read);
        EXPECT_TRUE(failed || damaged.size() == whole.size()) << "a truncated file was accepted";
      });
    EXPECT_GT(read, 0);
    EXPECT_GT(refused, 300);
  }
}

TEST(OcclusionTextureIO, InputThatIsNotBakedIsAnError)
{
  TemporaryFolder folder;
  const std::string file = folder.File("a.exr");
  PolyData bare = PolyData::New();
  EXPECT_HAS(ErrorOfWriting(bare, file), "no array \"AmbientOcclusion\"");

  PolyData wrongType = BakedBytes(4, 2, 4);
  vtkNew<vtkFloatArray> floatRows;
  floatRows->SetName("AmbientOcclusionTexture");
  floatRows->SetNumberOfTuples(4);
  wrongType->GetPointData()->AddArray(floatRows);
  EXPECT_HAS(
    ErrorOfWriting(wrongType, file), "\"AmbientOcclusionTexture\" in the point data is of type");

  PolyData wrongRow = BakedBytes(4, 2, 4);
  vtkIntArray::SafeDownCast(wrongRow->GetPointData()->GetArray("AmbientOcclusionTexture"))
    ->SetValue(1, 2);
  EXPECT_HAS(ErrorOfWriting(wrongRow, file), "Particle 1 refers to texture 2");

  PolyData noParameters = BakedBytes(4, 2, 4);
  noParameters->GetFieldData()->RemoveArray("AmbientOcclusionParameters");
  EXPECT_HAS(ErrorOfWriting(noParameters, file), "AmbientOcclusionParameters");

  PolyData wrongResolution = BakedBytes(4, 2, 4);
  SomeParameters(5, po::UInt8Gamma2, 1.0).ToFieldData(wrongResolution->GetFieldData());
  EXPECT_HAS(ErrorOfWriting(wrongResolution, file), "\"resolution\" is 5");

  PolyData wrongEncoding = BakedBytes(4, 2, 4);
  SomeParameters(4, po::Float32Linear, 1.0).ToFieldData(wrongEncoding->GetFieldData());
  EXPECT_HAS(ErrorOfWriting(wrongEncoding, file), "not float");
  SomeParameters(4, "Jpeg", 1.0).ToFieldData(wrongEncoding->GetFieldData());
  EXPECT_HAS(ErrorOfWriting(wrongEncoding, file), "\"Jpeg\"");

  for (double maximum : { -1.0, 1e-40, 1e39, std::numeric_limits<double>::quiet_NaN() })
  {
    EXPECT_HAS(ErrorOfWriting(BakedBytes(4, 2, 4, maximum), file), "\"maximum\"");
  }
  EXPECT_EQ(folder.Count(), 0u);
}

TEST(OcclusionTextureIO, PlacesThatCannotBeWrittenAreErrors)
{
  TemporaryFolder folder;
  PolyData baked = BakedBytes(4, 2, 4);
  WriteBytes(folder.File("file"), { 'x' });
  EXPECT_HAS(ErrorOfWriting(baked, folder.File("none/a.exr")), "No such file or directory");
  EXPECT_HAS(ErrorOfWriting(baked, folder.File("file/a.exr")), "Not a directory");
  EXPECT_HAS(ErrorOfWriting(baked, folder.File("")), "folder");
  EXPECT_HAS(ErrorOfWriting(baked, ""), "No file name");
#ifdef __linux__
  EXPECT_HAS(ErrorOfWriting(baked, "/dev/full"), "device");
  EXPECT_HAS(ErrorOfWriting(baked, "/proc/a.exr"), "check that the folder exists and is writable");
#endif
  namespace fs = std::filesystem;
  fs::permissions(folder.File("file"), fs::perms::owner_read);
  EXPECT_HAS(ErrorOfWriting(baked, folder.File("file")), "write-protected");
  EXPECT_EQ(ReadBytes(folder.File("file")), Bytes{ 'x' });
  EXPECT_EQ(folder.Count(), 1u);
}

#ifndef _WIN32
TEST(OcclusionTextureIO, FullDiskLeavesThePreviousFileAndNoPartialOne)
{
  TemporaryFolder folder;
  Write(BakedBytes(4, 2, 4), folder.File("a.exr"));
  const Bytes before = ReadBytes(folder.File("a.exr"));
  PolyData large = BakedBytes(3000, 1000, 16);
  Write(large, folder.File("large.exr"));
  const std::size_t size = ReadBytes(folder.File("large.exr")).size();
  std::filesystem::remove(folder.File("large.exr"));

  // Full in the header, among tiles, among particles, and at the very last byte.
  for (std::size_t limit : { std::size_t(100), size / 3, size - 9000, size - 1 })
  {
    std::string message;
    {
      FileSizeLimit full(limit);
      message = ErrorOfWriting(large, folder.File("a.exr"));
    }
    EXPECT_HAS(message, "a.exr");
    EXPECT_HAS(message, "File too large");
    EXPECT_EQ(ReadBytes(folder.File("a.exr")), before);
    EXPECT_EQ(folder.Count(), 1u);
  }
  Write(large, folder.File("a.exr"));
  EXPECT_EQ(ReadBytes(folder.File("a.exr")).size(), size);
}
#endif

TEST(OcclusionTextureIO, WritingThroughALinkKeepsTheLink)
{
  TemporaryFolder folder;
  Write(BakedBytes(4, 2, 4), folder.File("real.exr"));
  std::filesystem::create_symlink(folder.File("real.exr"), folder.File("link.exr"));
  Write(BakedBytes(40, 20, 8), folder.File("link.exr"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.File("link.exr")));
  EXPECT_EQ(po::OcclusionTextureFile(folder.File("real.exr")).ParticleCount(), 40);
}

TEST(OcclusionParameters, SurviveVtpFiles)
{
  TemporaryFolder folder;
  PolyData baked = BakedBytes(20, 4, 8, 1.0 / 3.0);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(baked);
  writer->SetDataModeToBinary();
  writer->SetFileName(folder.File("a.vtp").c_str());
  ASSERT_EQ(writer->Write(), 1);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(folder.File("a.vtp").c_str());
  reader->Update();
  ExpectSameStrings(baked->GetFieldData(), reader->GetOutput()->GetFieldData());
  const auto parameters =
    po::OcclusionParameters::FromFieldData(reader->GetOutput()->GetFieldData());
  EXPECT_EQ(parameters.GetDouble("maximum"), 1.0 / 3.0);
  EXPECT_EQ(parameters.Get("background"), "gradient, up = (0, 0, 1)");
}

TEST(OcclusionParameters, KeepOrderAndReplace)
{
  po::OcclusionParameters parameters;
  parameters.Set("b", 1);
  parameters.Set("a", "x=y");
  parameters.Set("b", 0.1);
  parameters.Set("c", true);
  const std::vector<std::string> strings = { "b=0.10000000000000001", "a=x=y", "c=1" };
  EXPECT_EQ(parameters.ToStrings(), strings);
  EXPECT_EQ(po::OcclusionParameters::FromStrings(strings).Entries(), parameters.Entries());
  EXPECT_TRUE(parameters.Has("a"));
  EXPECT_FALSE(parameters.Has("d"));
}

TEST(OcclusionParameters, ErrorsNameTheKey)
{
  po::OcclusionParameters parameters;
  parameters.Set("text", "12 apples");
  EXPECT_HAS(WhatIsThrown([&]() { (void)parameters.Get("seed"); }), "\"seed\"");
  EXPECT_HAS(WhatIsThrown([&]() { (void)parameters.GetInteger("text"); }), "\"12 apples\"");
  EXPECT_HAS(WhatIsThrown([&]() { (void)parameters.GetDouble("text"); }), "\"text\"");
  EXPECT_HAS(
    WhatIsThrown([]() { (void)po::OcclusionParameters::FromStrings({ "oops" }); }), "oops");
  EXPECT_HAS(WhatIsThrown([]() { (void)po::OcclusionParameters::FromStrings({ "=1" }); }), "=1");
  EXPECT_HAS(WhatIsThrown([&]() { parameters.Set("a=b", 1); }), "a=b");
}
