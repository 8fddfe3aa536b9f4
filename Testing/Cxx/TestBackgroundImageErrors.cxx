// SPDX-License-Identifier: BSD-3-Clause
// Images that cannot be a background: unsuitable, absurd, foreign, cut and damaged ones.
#include "BackgroundImageTestSupport.h"

#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>

#include <cstring>

namespace
{
TEST(BackgroundImageErrors, UnsuitableImagesAreErrors)
{
  TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  writeFloats(file, Imf::Header(4, 2), { { "u", ramp(8, 1) }, { "v", ramp(8, 2) } });
  EXPECT_HAS(errorOf(file), "u, v");

  Imf::Header cube(4, 24);
  Imf::addEnvmap(cube, Imf::ENVMAP_CUBE);
  writeFloats(file, cube, { { "Y", ramp(96, 1) } });
  EXPECT_HAS(errorOf(file), "cube map");

  writeFloats(
    file, Imf::Header(Box2i(V2i(0), V2i(7, 7)), Box2i(V2i(2), V2i(5, 3))), { { "Y", ramp(8, 1) } });
  EXPECT_HAS(errorOf(file), "uncropped");

  Imf::Header subsampled(4, 2);
  subsampled.channels().insert("Y", Imf::Channel(Imf::FLOAT, 2, 2));
  {
    const std::vector<float> values = ramp(2, 1);
    Imf::FrameBuffer frame;
    frame.insert("Y",
      Imf::Slice::Make(
        Imf::FLOAT, values.data(), V2i(0), int64_t(4), int64_t(2), size_t(0), size_t(0), 2, 2));
    Imf::OutputFile output(file.c_str(), subsampled);
    output.setFrameBuffer(frame);
    output.writePixels(2);
  }
  EXPECT_HAS(errorOf(file), "subsampled");
}

TEST(BackgroundImageErrors, DeepImageIsAnError)
{
  TemporaryFolder folder;
  const std::string name = folder.file("deep.exr");
  Imf::Header header(4, 2);
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  {
    std::vector<unsigned int> counts(8, 0);
    std::vector<float*> samples(8, nullptr);
    Imf::DeepFrameBuffer frame;
    frame.insertSampleCountSlice(Imf::Slice::Make(Imf::UINT, counts.data(), V2i(0), 4, 2));
    frame.insert("Y",
      Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(samples.data()), sizeof(float*),
        4 * sizeof(float*), sizeof(float)));
    Imf::DeepScanLineOutputFile file(name.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(2);
  }
  EXPECT_HAS(errorOf(name), "deep image");
}

TEST(BackgroundImageErrors, AbsurdSizesAreRefusedBeforeAllocation)
{
  TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  const auto claim = [&](int width, int height)
  {
    Imf::Header header(8, 4);
    writeFloats(file, header, { { "Y", ramp(32, 1) } });
    Bytes bytes = readBytes(file);
    // Both windows become width x height: "dataWindow\0box2i\0", size (4 bytes), min, max.
    for (const char* name : { "dataWindow", "displayWindow" })
    {
      const auto at = std::search(bytes.begin(), bytes.end(), name, name + std::strlen(name));
      const int max[2] = { width - 1, height - 1 };
      std::memcpy(&*at + std::strlen(name) + 1 + 6 + 4 + 8, max, sizeof(max));
    }
    writeBytes(file, bytes);
    return errorOf(file);
  };
  EXPECT_EQ(claim(8, 4), "");
  EXPECT_HAS(claim(1 << 30, 1 << 30), "more than is allowed");
  EXPECT_HAS(claim(65000, 65000), "more than is allowed");
  EXPECT_HAS(claim(2000, 60000), "too short");
  EXPECT_HAS(claim(0, 4), "a.exr");
  EXPECT_HAS(claim(8, 80), "a.exr");
}

TEST(BackgroundImageErrors, AbsurdSizeOfAnAttributeIsNotAllocated)
{
  TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  writeFloats(file, Imf::Header(8, 4), rgb(32));
  Bytes bytes = readBytes(file);
  // The list of channels has a size without its last byte, where one of OpenEXR's readers takes the
  // header for ended and the other one goes on: to an attribute without a type, of 1.9 gigabytes.
  const std::string channels("channels\0chlist\0", 16);
  const auto list = std::search(bytes.begin(), bytes.end(), channels.begin(), channels.end());
  ASSERT_NE(list, bytes.end());
  const auto size = list + static_cast<std::ptrdiff_t>(channels.size());
  const std::ptrdiff_t listed = *size;
  --*size;
  const std::string absurd("name\0\0\0\0\0\x72zzzz", 14);
  bytes.erase(size + 4 + listed, bytes.end());
  bytes.insert(bytes.end(), absurd.begin(), absurd.end());
  writeBytes(file, bytes);
  EXPECT_HAS(errorOf(file), "header is damaged");
}

TEST(BackgroundImageErrors, ForeignFilesAreErrorsThatNameThem)
{
  TemporaryFolder folder;
  const std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";
  writeBytes(folder.file("sky.hdr"), Bytes(text.begin(), text.end()));
  EXPECT_HAS(errorOf(folder.file("sky.hdr")), "not an OpenEXR file");
  EXPECT_HAS(errorOf(folder.file("sky.hdr")), "sky.hdr");
  EXPECT_HAS(errorOf(folder.file("none.exr")), "no such file");
  EXPECT_HAS(errorOf(folder.file("")), "not a file");
  EXPECT_HAS(errorOf(""), "no such file");
}

/// Cut before, in and after the header, every offset and every block of lines or tile.
TEST(BackgroundImageErrors, AFileCutAnywhereIsRefused)
{
  TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  for (const bool tiled : { false, true })
  {
    Imf::Header header(12, 40);
    header.compression() = Imf::ZIP_COMPRESSION;
    if (tiled)
    {
      header.setTileDescription(Imf::TileDescription(6, 16, Imf::ONE_LEVEL));
    }
    writeFloats(file, header, rgb(12 * 40));
    const Bytes whole = readBytes(file);
    for (std::size_t length = 0; length < whole.size(); ++length)
    {
      writeBytes(file, Bytes(whole.begin(), whole.begin() + length));
      EXPECT_HAS(errorOf(file), "a.exr") << "at byte " << length;
    }
  }
}

TEST(BackgroundImageErrors, DamagedFilesNeverCrash)
{
  const long peak = peakMegabytes();
  TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  for (const auto compression : { Imf::NO_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION,
         Imf::RLE_COMPRESSION, Imf::DWAA_COMPRESSION })
  {
    for (bool tiled : { false, true })
    {
      Imf::Header header(40, 36);
      header.compression() = compression;
      if (tiled)
      {
        header.setTileDescription(Imf::TileDescription(16, 16, Imf::ONE_LEVEL));
      }
      writeFloats(file, header, rgb(40 * 36));
      const Bytes whole = readBytes(file);
      forEachDamage(whole, 60,
        [&](const Bytes& damaged)
        {
          writeBytes(file, damaged);
          std::string error;
          po::LatLongImage image;
          error = whatIsThrown([&]() { image = po::readLatLongImage(file); });
          EXPECT_EQ(image.luminance.size(), std::size_t(image.width) * image.height);
          EXPECT_NE(error.empty(), image.luminance.empty());
          EXPECT_TRUE(damaged.size() == whole.size() || !error.empty());
          EXPECT_TRUE(error.empty() || error.find("a.exr") != std::string::npos) << error;
        });
    }
  }
  EXPECT_LT(peakMegabytes(), peak + 100);
}
}
