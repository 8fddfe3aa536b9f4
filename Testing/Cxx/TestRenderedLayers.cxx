// SPDX-License-Identifier: BSD-3-Clause
#include "ExrTestSupport.h"

#include "vtkRenderedLayersReader.h"
#include "vtkRenderedLayersWriter.h"

#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>

namespace
{
using Image = vtkSmartPointer<vtkImageData>;

Image emptyImage(int width, int height)
{
  Image image = Image::New();
  image->SetDimensions(width, height, 1);
  return image;
}

template <typename Array>
vtkSmartPointer<Array> addArray(vtkImageData* image, const char* name, int components)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  array->FillValue(0);
  image->GetPointData()->AddArray(array);
  return array;
}

int write(vtkImageData* image, const std::string& fileName)
{
  vtkNew<vtkRenderedLayersWriter> writer;
  writer->SetInputDataObject(image);
  writer->SetFileName(fileName.c_str());
  return writer->Write();
}

std::string errorOfWriting(vtkImageData* image, const std::string& fileName)
{
  vtkNew<vtkRenderedLayersWriter> writer;
  Messages messages(writer);
  writer->SetInputDataObject(image);
  writer->SetFileName(fileName.c_str());
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_NE(writer->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_EQ(messages.errors.size(), 1u);
  return messages.errors.empty() ? std::string() : messages.errors.front();
}

/// A channel as OpenEXR reads it, the top row first.
template <typename Pixel>
std::vector<Pixel> readChannel(
  const std::string& fileName, const char* name, Imf::PixelType memory, Imf::PixelType stored)
{
  Imf::InputFile file(fileName.c_str());
  const auto& window = file.header().dataWindow();
  const Imf::Channel* channel = file.header().channels().findChannel(name);
  EXPECT_NE(channel, nullptr) << name;
  if (!channel)
  {
    return {};
  }
  EXPECT_EQ(channel->type, stored) << name;
  std::vector<Pixel> pixels((window.max.x + 1) * (window.max.y + 1));
  Imf::FrameBuffer frame;
  frame.insert(name, Imf::Slice::Make(memory, pixels.data(), window));
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return pixels;
}

std::vector<float> readFloats(const std::string& file, const char* name)
{
  return readChannel<float>(file, name, Imf::FLOAT, Imf::FLOAT);
}

std::vector<float> readHalves(const std::string& file, const char* name)
{
  return readChannel<float>(file, name, Imf::FLOAT, Imf::HALF);
}

std::set<std::string> channelNames(const std::string& fileName)
{
  Imf::InputFile file(fileName.c_str());
  std::set<std::string> names;
  const Imf::ChannelList& channels = file.header().channels();
  for (auto channel = channels.begin(); channel != channels.end(); ++channel)
  {
    names.insert(channel.name());
  }
  return names;
}
}

TEST(RenderedLayers, LayersHaveTheirNamesTypesValuesAndStandUpright)
{
  TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr float tiny = 1.0f / (1 << 30); // far below what HALF can hold
  Image image = emptyImage(2, 3);
  auto depth = addArray<vtkFloatArray>(image, "Z", 1);
  auto occlusion = addArray<vtkDoubleArray>(image, "AO", 1);
  auto normal = addArray<vtkFloatArray>(image, "N", 3);
  auto id = addArray<vtkTypeInt64Array>(image, "id", 1);
  auto extra = addArray<vtkFloatArray>(image, "velocity", 2);
  for (int i = 0; i < 6; ++i)
  {
    depth->SetValue(i, i == 5 ? infinity : tiny * i);
    occlusion->SetValue(i, 0.125 * i);
    normal->SetTuple3(i, i, -i, 0.5);
    id->SetValue(i, i == 5 ? -1 : 4294967290 + i);
    extra->SetTuple2(i, 10.0 * i, 20.0 * i);
  }
  ASSERT_EQ(write(image, file), 1);

  EXPECT_EQ(channelNames(file),
    (std::set<std::string>{ "Z", "AO", "N.X", "N.Y", "N.Z", "id", "velocity.X", "velocity.Y" }));
  // VTK's last row (tuples 4 and 5) is the top one.
  EXPECT_EQ(readFloats(file, "Z"),
    (std::vector<float>{ 4 * tiny, infinity, 2 * tiny, 3 * tiny, 0.0f, tiny }));
  EXPECT_EQ(
    readFloats(file, "AO"), (std::vector<float>{ 0.5f, 0.625f, 0.25f, 0.375f, 0.0f, 0.125f }));
  EXPECT_EQ(readFloats(file, "N.Y"), (std::vector<float>{ -4, -5, -2, -3, 0, -1 }));
  EXPECT_EQ(readFloats(file, "velocity.Y"), (std::vector<float>{ 80, 100, 40, 60, 0, 20 }));
  EXPECT_EQ(readChannel<unsigned int>(file, "id", Imf::UINT, Imf::UINT),
    (std::vector<unsigned int>{
      4294967294u, 4294967295u, 4294967292u, 4294967293u, 4294967290u, 4294967291u }));
}

TEST(RenderedLayers, ColorsAreLinearAndPremultiplied)
{
  TemporaryFolder folder;
  Image image = emptyImage(4, 1);
  auto color = addArray<vtkUnsignedCharArray>(image, "RGBA", 4);
  color->SetTuple4(0, 255, 128, 0, 255);
  color->SetTuple4(1, 255, 128, 10, 51);
  color->SetTuple4(2, 255, 255, 255, 0);
  color->SetTuple4(3, 10, 11, 188, 255);
  ASSERT_EQ(write(image, folder.file("a.exr")), 1);
  const auto red = readHalves(folder.file("a.exr"), "R");
  const auto green = readHalves(folder.file("a.exr"), "G");
  const auto blue = readHalves(folder.file("a.exr"), "B");
  const auto alpha = readHalves(folder.file("a.exr"), "A");
  EXPECT_EQ(red[0], 1.0f);
  EXPECT_NEAR(green[0], 0.21586, 2e-4); // sRGB 128
  EXPECT_EQ(blue[0], 0.0f);
  EXPECT_NEAR(red[1], 0.2, 2e-4);
  EXPECT_NEAR(green[1], 0.2 * 0.21586, 4e-5);
  EXPECT_NEAR(alpha[1], 0.2, 2e-4);
  EXPECT_EQ(red[2], 0.0f);
  EXPECT_EQ(alpha[2], 0.0f);
  EXPECT_NEAR(red[3], 10 / 255.0 / 12.92, 3e-6); // below the knee of the curve
  EXPECT_NEAR(green[3], 0.0033465, 3e-6);        // above it
  EXPECT_NEAR(blue[3], 0.50289, 3e-4);
}

TEST(RenderedLayers, EveryOpaqueColorComesBack)
{
  TemporaryFolder folder;
  Image image = emptyImage(256, 1);
  auto color = addArray<vtkUnsignedCharArray>(image, "RGBA", 4);
  for (int byte = 0; byte < 256; ++byte)
  {
    color->SetTuple4(byte, byte, byte, byte, 255);
  }
  ASSERT_EQ(write(image, folder.file("a.exr")), 1);
  const auto red = readHalves(folder.file("a.exr"), "R");
  for (int byte = 0; byte < 256; ++byte)
  {
    const double linear = red[byte];
    const double srgb =
      linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    EXPECT_EQ(std::lround(255.0 * srgb), byte);
  }
}

TEST(RenderedLayers, OtherIntegersAreLeftOutWithAWarning)
{
  TemporaryFolder folder;
  Image image = emptyImage(2, 2);
  addArray<vtkFloatArray>(image, "Z", 1);
  addArray<vtkIntArray>(image, "counts", 1);
  vtkNew<vtkRenderedLayersWriter> writer;
  Messages messages(writer);
  writer->SetInputDataObject(image);
  writer->SetFileName(folder.file("a.exr").c_str());
  EXPECT_EQ(writer->Write(), 1);
  EXPECT_TRUE(oneMessage(messages.warnings, "counts"));
  EXPECT_EQ(channelNames(folder.file("a.exr")), std::set<std::string>{ "Z" });
}

TEST(RenderedLayers, ComeBackFromTheFile)
{
  TemporaryFolder folder;
  Image image = emptyImage(3, 2);
  auto depth = addArray<vtkFloatArray>(image, "Z", 1);
  addArray<vtkFloatArray>(image, "Layer.Depth.Z", 1)->FillValue(1e10F);
  addArray<vtkFloatArray>(image, "Layer.Normal.Z", 1)->FillValue(1e10F);
  auto normal = addArray<vtkFloatArray>(image, "N", 3);
  auto ids = addArray<vtkIntArray>(image, "id", 1);
  for (int pixel = 0; pixel < 6; ++pixel)
  {
    depth->SetValue(pixel, pixel == 4 ? 1e10F : 0.5F + static_cast<float>(pixel));
    normal->SetTuple3(pixel, pixel, -pixel, 0.25);
    ids->SetValue(pixel, pixel - 1);
  }
  ASSERT_EQ(write(image, folder.file("a.exr")), 1);

  vtkNew<vtkRenderedLayersReader> reader;
  Messages messages(reader);
  reader->SetFileName(folder.file("a.exr").c_str());
  for (const double from : { 0.0, 1e9 })
  {
    reader->SetBackgroundFrom(from);
    reader->Update();
    vtkImageData* read = reader->GetOutput();
    ASSERT_EQ(read->GetDimensions()[0], 3);
    ASSERT_EQ(read->GetDimensions()[1], 2);
    vtkPointData* layers = read->GetPointData();
    EXPECT_EQ(layers->GetNumberOfArrays(), 7);
    EXPECT_EQ(std::isinf(layers->GetArray("Layer.Depth.Z")->GetComponent(3, 0)), from > 0);
    EXPECT_EQ(layers->GetArray("Layer.Normal.Z")->GetComponent(3, 0), 1e10F);
    EXPECT_EQ(layers->GetScalars(), layers->GetArray("Z"));
    EXPECT_EQ(layers->GetArray("id")->GetDataType(), VTK_UNSIGNED_INT);
    for (int pixel = 0; pixel < 6; ++pixel)
    {
      const bool isOpen = from > 0 && pixel == 4;
      EXPECT_EQ(layers->GetArray("Z")->GetComponent(pixel, 0),
        isOpen ? std::numeric_limits<double>::infinity() : depth->GetValue(pixel));
      EXPECT_EQ(layers->GetArray("N.Y")->GetComponent(pixel, 0), -pixel);
      EXPECT_EQ(layers->GetArray("id")->GetComponent(pixel, 0),
        pixel == 0 ? 4294967295.0 : static_cast<double>(pixel - 1));
    }
  }
  EXPECT_TRUE(messages.errors.empty());
}

TEST(RenderedLayers, WhatCannotBeReadIsOneError)
{
  TemporaryFolder folder;
  const auto errorOfReading = [](const std::string& fileName)
  {
    vtkNew<vtkRenderedLayersReader> reader;
    Messages messages(reader);
    reader->SetFileName(fileName.c_str());
    reader->Update();
    EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 0);
    EXPECT_EQ(messages.errors.size(), 1U);
    return messages.errors.empty() ? std::string() : messages.errors.front();
  };
  EXPECT_HAS(errorOfReading(""), "set FileName");
  EXPECT_HAS(errorOfReading(folder.file("none.exr")), "none.exr");
  std::ofstream(folder.file("text.exr")) << "no image";
  EXPECT_HAS(errorOfReading(folder.file("text.exr")), "text.exr");

  Image image = emptyImage(64, 64);
  addArray<vtkFloatArray>(image, "Z", 1);
  ASSERT_EQ(write(image, folder.file("a.exr")), 1);
  std::ifstream whole(folder.file("a.exr"), std::ios::binary);
  const std::string bytes{ std::istreambuf_iterator<char>(whole), {} };
  std::ofstream(folder.file("cut.exr"), std::ios::binary) << bytes.substr(0, bytes.size() - 20);
  EXPECT_HAS(errorOfReading(folder.file("cut.exr")), "cut.exr");
}

TEST(RenderedLayers, WhatCannotBeWrittenIsAnError)
{
  TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  EXPECT_HAS(errorOfWriting(emptyImage(2, 2), file), "no point array");

  Image counts = emptyImage(2, 2);
  addArray<vtkIntArray>(counts, "counts", 1);
  EXPECT_HAS(errorOfWriting(counts, file), "it has: counts");

  Image volume = Image::New();
  volume->SetDimensions(2, 2, 2);
  addArray<vtkFloatArray>(volume, "Z", 1);
  EXPECT_HAS(errorOfWriting(volume, file), "2 x 2 x 2");

  Image rgb = emptyImage(2, 2);
  addArray<vtkUnsignedCharArray>(rgb, "RGBA", 3);
  EXPECT_HAS(errorOfWriting(rgb, file), "\"RGBA\"");

  Image flatNormal = emptyImage(2, 2);
  addArray<vtkFloatArray>(flatNormal, "N", 2);
  EXPECT_HAS(errorOfWriting(flatNormal, file), "\"N\" has 2 components; 3");

  Image tensor = emptyImage(2, 2);
  addArray<vtkFloatArray>(tensor, "stress", 9);
  EXPECT_HAS(errorOfWriting(tensor, file), "\"stress\" has 9 components; 1 to 4");

  Image ids = emptyImage(2, 2);
  addArray<vtkTypeInt64Array>(ids, "id", 1)->SetValue(0, 5000000000);
  EXPECT_HAS(errorOfWriting(ids, file), "5000000000");

  Image twice = emptyImage(2, 2);
  addArray<vtkUnsignedCharArray>(twice, "RGBA", 4);
  addArray<vtkFloatArray>(twice, "R", 1);
  EXPECT_HAS(errorOfWriting(twice, file), "\"R\"");
  EXPECT_EQ(folder.count(), 0u);

  Image good = emptyImage(2, 2);
  addArray<vtkFloatArray>(good, "Z", 1);
  EXPECT_HAS(errorOfWriting(good, folder.file("none/a.exr")), "No such file or directory");
  EXPECT_HAS(errorOfWriting(good, ""), "No file name");
}

#ifndef _WIN32
TEST(RenderedLayers, FullDiskLeavesThePreviousFileAndNoPartialOne)
{
  TemporaryFolder folder;
  Image image = emptyImage(200, 200);
  auto depth = addArray<vtkFloatArray>(image, "Z", 1);
  ASSERT_EQ(write(image, folder.file("a.exr")), 1);
  const Bytes before = readBytes(folder.file("a.exr"));
  std::mt19937 random(1);
  for (vtkIdType i = 0; i < depth->GetNumberOfValues(); ++i)
  {
    depth->SetValue(i, std::generate_canonical<float, 24>(random));
  }
  ASSERT_EQ(write(image, folder.file("large.exr")), 1);
  const std::size_t size = readBytes(folder.file("large.exr")).size();
  std::filesystem::remove(folder.file("large.exr"));
  // At the beginning, in every block of lines, and at the very last byte.
  for (std::size_t part = 0; part <= 40; ++part)
  {
    std::string message;
    {
      FileSizeLimit full(part < 40 ? size * part / 40 : size - 1);
      message = errorOfWriting(image, folder.file("a.exr"));
    }
    EXPECT_HAS(message, "a.exr");
    EXPECT_HAS(message, "File too large");
    EXPECT_EQ(readBytes(folder.file("a.exr")), before);
    EXPECT_EQ(folder.count(), 1u);
  }
}

TEST(RenderedLayers, PlacesThatCannotBeWrittenAreErrors)
{
  TemporaryFolder folder;
  Image image = emptyImage(2, 2);
  addArray<vtkFloatArray>(image, "Z", 1);
  writeBytes(folder.file("file"), { 'x' });
  EXPECT_HAS(errorOfWriting(image, folder.file("file/a.exr")), "Not a directory");
  EXPECT_HAS(errorOfWriting(image, folder.file("")), "folder");
#ifdef __linux__
  EXPECT_HAS(errorOfWriting(image, "/dev/full"), "device");
  EXPECT_HAS(errorOfWriting(image, "/proc/a.exr"), "check that the folder exists and is writable");
#endif
  namespace fs = std::filesystem;
  fs::permissions(folder.file("file"), fs::perms::owner_read);
  EXPECT_HAS(errorOfWriting(image, folder.file("file")), "write-protected");
  EXPECT_EQ(readBytes(folder.file("file")), Bytes{ 'x' });
  EXPECT_EQ(folder.count(), 1u);
}
#endif
