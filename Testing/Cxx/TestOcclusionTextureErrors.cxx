// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionTextureTestData.h"

#include "vtkOcclusionTextureReader.h"

#include "vtkExecutive.h"

#include <algorithm>
#include <limits>

namespace
{

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

TEST(OcclusionTextureErrors, RowOutOfRangeIsAnError)
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

TEST(OcclusionTextureErrors, OtherNumberOfPointsIsAnError)
{
  TemporaryFolder folder;
  Write(BakedBytes(10, 3, 4), folder.File("a.exr"));
  EXPECT_HAS(
    ErrorOfReading(folder.File("a.exr"), SomeParticles(9, 3)), "10 particles, but the input has 9");
}

TEST(OcclusionTextureErrors, ForeignFilesAreErrorsThatNameThem)
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

TEST(OcclusionTextureErrors, AbsurdSizeOfAnAttributeIsNotAllocated)
{
  TemporaryFolder folder;
  const std::string fileName = folder.File("a.exr");
  Write(BakedBytes(4, 3, 4), fileName);
  Bytes bytes = ReadBytes(fileName);
  const std::string before("comments\0string\0", 16);
  const auto at = std::search(bytes.begin(), bytes.end(), before.begin(), before.end());
  ASSERT_NE(at, bytes.end());
  *(at + before.size() + 3) = 0x4d; // 1.3 gigabytes
  WriteBytes(fileName, bytes);
  const long peak = PeakMegabytes();
  EXPECT_HAS(ErrorOfReading(fileName), "header is damaged");
  EXPECT_LT(PeakMegabytes(), peak + 100);
}

TEST(OcclusionTextureErrors, DamagedFilesNeverCrash)
{
  const long peak = PeakMegabytes();
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
  EXPECT_LT(PeakMegabytes(), peak + 100);
}

TEST(OcclusionTextureErrors, InputThatIsNotBakedIsAnError)
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

TEST(OcclusionTextureErrors, PlacesThatCannotBeWrittenAreErrors)
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
TEST(OcclusionTextureErrors, FullDiskLeavesThePreviousFileAndNoPartialOne)
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
