// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionTextureTestData.h"

#include "vtkOcclusionTextureReader.h"

#include "vtkExecutive.h"

#include <algorithm>
#include <limits>

namespace
{
std::string errorOfReading(const std::string& fileName, vtkPolyData* input = nullptr)
{
  vtkNew<vtkOcclusionTextureReader> reader;
  Messages messages(reader);
  Messages pipeline(reader->GetExecutive());
  reader->SetFileName(fileName.c_str());
  reader->SetInputData(input);
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
  EXPECT_NE(reader->GetErrorCode(), vtkErrorCode::NoError);
  return messages.errors.empty() ? std::string() : messages.errors.front();
}

std::string errorOfWriting(vtkPolyData* data, const std::string& fileName)
{
  vtkNew<vtkOcclusionTextureWriter> writer;
  Messages messages(writer);
  writer->SetInputDataObject(data);
  writer->SetFileName(fileName.c_str());
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_NE(writer->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_EQ(messages.errors.size(), 1u);
  return messages.errors.empty() ? std::string() : messages.errors.front();
}
}

TEST(OcclusionTextureErrors, RowOutOfRangeIsAnError)
{
  TemporaryFolder folder;
  write(bakedBytes(4, 3, 4), folder.file("a.exr"));
  vtkNew<vtkOcclusionTextureReader> reader;
  Messages messages(reader);
  reader->SetFileName(folder.file("a.exr").c_str());
  EXPECT_EQ(reader->ReadTexture(3), nullptr);
  EXPECT_TRUE(oneMessage(messages.errors, "choose 0 to 2"));
  EXPECT_EQ(reader->ReadTexture(-1), nullptr);
}

TEST(OcclusionTextureErrors, OtherNumberOfPointsIsAnError)
{
  TemporaryFolder folder;
  write(bakedBytes(10, 3, 4), folder.file("a.exr"));
  EXPECT_HAS(
    errorOfReading(folder.file("a.exr"), someParticles(9, 3)), "10 particles, but the input has 9");
}

TEST(OcclusionTextureErrors, ForeignFilesAreErrorsThatNameThem)
{
  TemporaryFolder folder;
  const auto file = [&](const char* name, const std::string& text)
  {
    writeBytes(folder.file(name), Bytes(text.begin(), text.end()));
    return errorOfReading(folder.file(name));
  };
  EXPECT_HAS(file("a.png", "\x89PNG\r\n\x1a\n and more"), "not an OpenEXR file");
  EXPECT_HAS(file("text.exr", "x y z\n1 2 3\n"), "not an OpenEXR file");
  EXPECT_HAS(file("text.exr", "x y z\n1 2 3\n"), "text.exr");
  EXPECT_HAS(file("empty.exr", ""), "not an OpenEXR file");
  EXPECT_HAS(file("short.exr", "v/1\x01"), "header is damaged");
  EXPECT_HAS(errorOfReading(folder.file("")), "not a file");
  EXPECT_HAS(errorOfReading(folder.file("none.exr")), "no such file");
  EXPECT_HAS(errorOfReading(""), "No file name");
}

TEST(OcclusionTextureErrors, AbsurdSizeOfAnAttributeIsNotAllocated)
{
  TemporaryFolder folder;
  const std::string fileName = folder.file("a.exr");
  write(bakedBytes(4, 3, 4), fileName);
  Bytes bytes = readBytes(fileName);
  const std::string before("comments\0string\0", 16);
  const auto at = std::search(bytes.begin(), bytes.end(), before.begin(), before.end());
  ASSERT_NE(at, bytes.end());
  *(at + before.size() + 3) = 0x4d; // 1.3 gigabytes
  writeBytes(fileName, bytes);
  const long peak = peakMegabytes();
  EXPECT_HAS(errorOfReading(fileName), "header is damaged");
  EXPECT_LT(peakMegabytes(), peak + 100);
}

TEST(OcclusionTextureErrors, DamagedFilesNeverCrash)
{
  const long peak = peakMegabytes();
  TemporaryFolder folder;
  for (PolyData baked : { bakedBytes(300, 20, 8), bakedFloats(30, 11, 5) })
  {
    write(baked, folder.file("whole.exr"));
    const Bytes whole = readBytes(folder.file("whole.exr"));
    int read = 0;
    int refused = 0;
    PolyData bare = particles(baked);
    forEachDamage(whole, 300,
      [&](const Bytes& damaged)
      {
        writeBytes(folder.file("damaged.exr"), damaged);
        vtkNew<vtkOcclusionTextureReader> reader;
        Messages messages(reader);
        Messages pipeline(reader->GetExecutive());
        reader->SetFileName(folder.file("damaged.exr").c_str());
        reader->SetInputData(bare);
        reader->Update();
        const bool failed = reader->GetErrorCode() != vtkErrorCode::NoError;
        EXPECT_EQ(failed, !messages.errors.empty());
        EXPECT_LE(messages.errors.size(), 1u);
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
  EXPECT_LT(peakMegabytes(), peak + 100);
}

/// Cut before, in and after the header, every offset, every tile and every row of particles.
TEST(OcclusionTextureErrors, AFileCutAnywhereIsRefused)
{
  TemporaryFolder folder;
  PolyData baked = bakedBytes(30, 7, 4);
  PolyData bare = particles(baked);
  write(baked, folder.file("whole.exr"));
  const Bytes whole = readBytes(folder.file("whole.exr"));
  for (std::size_t length = 0; length < whole.size(); ++length)
  {
    writeBytes(folder.file("cut.exr"), Bytes(whole.begin(), whole.begin() + length));
    EXPECT_HAS(errorOfReading(folder.file("cut.exr"), bare), "cut.exr") << "at byte " << length;
  }
}

TEST(OcclusionTextureErrors, InputThatIsNotBakedIsAnError)
{
  TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  PolyData bare = PolyData::New();
  EXPECT_HAS(errorOfWriting(bare, file), "no array \"AmbientOcclusion\"");

  PolyData wrongType = bakedBytes(4, 2, 4);
  vtkNew<vtkFloatArray> floatRows;
  floatRows->SetName("AmbientOcclusionTexture");
  floatRows->SetNumberOfTuples(4);
  wrongType->GetPointData()->AddArray(floatRows);
  EXPECT_HAS(
    errorOfWriting(wrongType, file), "\"AmbientOcclusionTexture\" in the point data is of type");

  PolyData wrongRow = bakedBytes(4, 2, 4);
  vtkIntArray::SafeDownCast(wrongRow->GetPointData()->GetArray("AmbientOcclusionTexture"))
    ->SetValue(1, 2);
  EXPECT_HAS(errorOfWriting(wrongRow, file), "Particle 1 refers to texture 2");

  PolyData noParameters = bakedBytes(4, 2, 4);
  noParameters->GetFieldData()->RemoveArray("AmbientOcclusionParameters");
  EXPECT_HAS(errorOfWriting(noParameters, file), "AmbientOcclusionParameters");

  PolyData wrongResolution = bakedBytes(4, 2, 4);
  someParameters(5, po::UInt8Gamma2, 1.0).toFieldData(wrongResolution->GetFieldData());
  EXPECT_HAS(errorOfWriting(wrongResolution, file), "\"resolution\" is 5");

  PolyData wrongEncoding = bakedBytes(4, 2, 4);
  someParameters(4, po::Float32Linear, 1.0).toFieldData(wrongEncoding->GetFieldData());
  EXPECT_HAS(errorOfWriting(wrongEncoding, file), "not float");
  someParameters(4, "Jpeg", 1.0).toFieldData(wrongEncoding->GetFieldData());
  EXPECT_HAS(errorOfWriting(wrongEncoding, file), "\"Jpeg\"");

  for (double maximum : { -1.0, 1e-40, 1e39, std::numeric_limits<double>::quiet_NaN() })
  {
    EXPECT_HAS(errorOfWriting(bakedBytes(4, 2, 4, maximum), file), "\"maximum\"");
  }
  EXPECT_EQ(folder.count(), 0u);
}

TEST(OcclusionTextureErrors, PlacesThatCannotBeWrittenAreErrors)
{
  TemporaryFolder folder;
  PolyData baked = bakedBytes(4, 2, 4);
  writeBytes(folder.file("file"), { 'x' });
  EXPECT_HAS(errorOfWriting(baked, folder.file("none/a.exr")), "No such file or directory");
  EXPECT_HAS(errorOfWriting(baked, folder.file("file/a.exr")), "Not a directory");
  EXPECT_HAS(errorOfWriting(baked, folder.file("")), "folder");
  EXPECT_HAS(errorOfWriting(baked, ""), "No file name");
#ifdef __linux__
  EXPECT_HAS(errorOfWriting(baked, "/dev/full"), "device");
  EXPECT_HAS(errorOfWriting(baked, "/proc/a.exr"), "check that the folder exists and is writable");
#endif
  namespace fs = std::filesystem;
  fs::permissions(folder.file("file"), fs::perms::owner_read);
  EXPECT_HAS(errorOfWriting(baked, folder.file("file")), "write-protected");
  EXPECT_EQ(readBytes(folder.file("file")), Bytes{ 'x' });
  EXPECT_EQ(folder.count(), 1u);
}

#ifndef _WIN32
TEST(OcclusionTextureErrors, FullDiskLeavesThePreviousFileAndNoPartialOne)
{
  TemporaryFolder folder;
  write(bakedBytes(4, 2, 4), folder.file("a.exr"));
  const Bytes before = readBytes(folder.file("a.exr"));
  PolyData large = bakedBytes(3000, 1000, 16);
  write(large, folder.file("large.exr"));
  const std::size_t size = readBytes(folder.file("large.exr")).size();
  std::filesystem::remove(folder.file("large.exr"));

  // Full in the header, among tiles, among particles, and at the very last byte.
  std::vector<std::size_t> limits = { 0, 1, 100, size - 9000, size - 2, size - 1 };
  for (std::size_t part = 1; part < 40; ++part)
  {
    limits.push_back(size * part / 40);
  }
  for (const std::size_t limit : limits)
  {
    std::string message;
    {
      FileSizeLimit full(limit);
      message = errorOfWriting(large, folder.file("a.exr"));
    }
    EXPECT_HAS(message, "a.exr");
    EXPECT_HAS(message, "File too large");
    EXPECT_EQ(readBytes(folder.file("a.exr")), before);
    EXPECT_EQ(folder.count(), 1u);
  }
  write(large, folder.file("a.exr"));
  EXPECT_EQ(readBytes(folder.file("a.exr")).size(), size);
}
#endif
