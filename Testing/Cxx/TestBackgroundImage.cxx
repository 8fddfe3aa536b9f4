// SPDX-License-Identifier: BSD-3-Clause
#include "ExrTestSupport.h"

#include "ExrBackground.h"

#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfTiledOutputFile.h>

#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

using IMATH_NAMESPACE::Box2i;
using IMATH_NAMESPACE::V2f;
using IMATH_NAMESPACE::V2i;

namespace
{
using Channels = std::map<std::string, std::vector<float>>;

template <typename Pixel>
class Converted
{
public:
  explicit Converted(const Channels& channels)
  {
    for (const auto& [name, values] : channels)
    {
      pixels_[name].assign(values.begin(), values.end());
    }
  }
  Imf::FrameBuffer frame(Imf::PixelType type, const Box2i& window) const
  {
    Imf::FrameBuffer frame;
    for (const auto& [name, pixels] : pixels_)
    {
      frame.insert(name, Imf::Slice::Make(type, pixels.data(), window));
    }
    return frame;
  }

private:
  std::map<std::string, std::vector<Pixel>> pixels_;
};

void addChannels(Imf::Header& header, const Channels& channels, Imf::PixelType type)
{
  for (const auto& [name, values] : channels)
  {
    header.channels().insert(name, Imf::Channel(type));
  }
}

template <typename Pixel>
void writeAs(
  const std::string& fileName, Imf::Header header, const Channels& channels, Imf::PixelType type)
{
  addChannels(header, channels, type);
  const Converted<Pixel> converted(channels);
  const Box2i& window = header.dataWindow();
  if (header.hasTileDescription())
  {
    Imf::TiledOutputFile file(fileName.c_str(), header);
    file.setFrameBuffer(converted.frame(type, window));
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    return;
  }
  Imf::OutputFile file(fileName.c_str(), header);
  file.setFrameBuffer(converted.frame(type, window));
  file.writePixels(window.max.y - window.min.y + 1);
}

void writeFloats(const std::string& fileName, const Imf::Header& header, const Channels& channels)
{
  writeAs<float>(fileName, header, channels, Imf::FLOAT);
}

// Small integers: exact in every pixel type.
std::vector<float> ramp(int count, int step)
{
  std::vector<float> values(count);
  for (int i = 0; i < count; ++i)
  {
    values[i] = static_cast<float>((i * step) % 101);
  }
  return values;
}

Channels rgb(int count)
{
  return { { "R", ramp(count, 1) }, { "G", ramp(count, 3) }, { "B", ramp(count, 7) } };
}

void expectLuminance(
  const po::LatLongImage& image, const Channels& rgb, double red, double green, double blue)
{
  const std::size_t count = rgb.at("R").size();
  ASSERT_EQ(image.luminance.size(), count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double expected = red * rgb.at("R")[i] + green * rgb.at("G")[i] + blue * rgb.at("B")[i];
    ASSERT_NEAR(image.luminance[i], expected, 1e-5 * (1.0 + expected)) << "pixel " << i;
  }
}

std::string errorOf(const std::string& fileName)
{
  return whatIsThrown([&]() { po::readLatLongImage(fileName); });
}

constexpr int Width = 150;
constexpr int Height = 75; // more rows than are read at a time
}

TEST(BackgroundImage, RgbOfEveryTypeCompressionAndLayout)
{
  TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  const Channels channels = rgb(Width * Height);
  for (int compression = 0; compression < Imf::B44_COMPRESSION; ++compression)
  {
    for (bool tiled : { false, true })
    {
      SCOPED_TRACE(testing::Message() << "compression " << compression << ", tiled " << tiled);
      Imf::Header header(Width, Height);
      header.compression() = static_cast<Imf::Compression>(compression);
      if (tiled)
      {
        header.setTileDescription(Imf::TileDescription(32, 16, Imf::ONE_LEVEL));
      }
      writeAs<float>(file, header, channels, Imf::FLOAT);
      expectLuminance(po::readLatLongImage(file), channels, 0.2126, 0.7152, 0.0722);
      writeAs<half>(file, header, channels, Imf::HALF);
      expectLuminance(po::readLatLongImage(file), channels, 0.2126, 0.7152, 0.0722);
      writeAs<unsigned int>(file, header, channels, Imf::UINT);
      expectLuminance(po::readLatLongImage(file), channels, 0.2126, 0.7152, 0.0722);
    }
  }
}

TEST(BackgroundImage, FirstRowIsOnTopAndFirstColumnOnTheLeft)
{
  TemporaryFolder folder;
  for (const auto order : { Imf::INCREASING_Y, Imf::DECREASING_Y })
  {
    const Box2i window(V2i(-3, 5), V2i(0, 6));
    Imf::Header header(window, window);
    header.lineOrder() = order;
    const std::vector<float> values = { 1, 2, 3, 4, 5, 6, 7, 8 };
    writeFloats(folder.file("a.exr"), header, { { "Y", values } });
    const po::LatLongImage image = po::readLatLongImage(folder.file("a.exr"));
    EXPECT_EQ(image.width, 4);
    EXPECT_EQ(image.height, 2);
    EXPECT_EQ(image.luminance, values);
  }
}

TEST(BackgroundImage, LuminanceFollowsTheChromaticities)
{
  TemporaryFolder folder;
  const Channels channels = rgb(8 * 4);
  Imf::Header header(8, 4);
  // ITU-R BT.2020 and its luminance coefficients.
  Imf::addChromaticities(header,
    Imf::Chromaticities(
      V2f(0.708f, 0.292f), V2f(0.170f, 0.797f), V2f(0.131f, 0.046f), V2f(0.3127f, 0.3290f)));
  writeFloats(folder.file("a.exr"), header, channels);
  const po::LatLongImage image = po::readLatLongImage(folder.file("a.exr"));
  for (std::size_t i = 0; i < image.luminance.size(); ++i)
  {
    const double expected =
      0.2627 * channels.at("R")[i] + 0.6780 * channels.at("G")[i] + 0.0593 * channels.at("B")[i];
    EXPECT_NEAR(image.luminance[i], expected, 2e-4 * (1.0 + expected));
  }
}

TEST(BackgroundImage, OneChannelOfAnyNameAndAlphaIsIgnored)
{
  TemporaryFolder folder;
  const Channels channels = { { "sky.light", ramp(32, 5) }, { "A", ramp(32, 1) } };
  writeFloats(folder.file("a.exr"), Imf::Header(8, 4), channels);
  EXPECT_EQ(po::readLatLongImage(folder.file("a.exr")).luminance, channels.at("sky.light"));
}

TEST(BackgroundImage, SecondPartIsFound)
{
  TemporaryFolder folder;
  std::vector<Imf::Header> headers(2, Imf::Header(4, 2));
  const Channels two = { { "u", ramp(8, 1) }, { "v", ramp(8, 2) } };
  const Channels light = { { "Y", ramp(8, 3) } };
  addChannels(headers[0], two, Imf::FLOAT);
  addChannels(headers[1], light, Imf::FLOAT);
  for (int part = 0; part < 2; ++part)
  {
    headers[part].setName(part ? "light" : "motion");
    headers[part].setType(Imf::SCANLINEIMAGE);
  }
  {
    Imf::MultiPartOutputFile file(folder.file("a.exr").c_str(), headers.data(), 2);
    for (int number = 0; number < 2; ++number)
    {
      const Converted<float> converted(number ? light : two);
      Imf::OutputPart part(file, number);
      part.setFrameBuffer(converted.frame(Imf::FLOAT, headers[number].dataWindow()));
      part.writePixels(2);
    }
  }
  EXPECT_EQ(po::readLatLongImage(folder.file("a.exr")).luminance, light.at("Y"));
}

TEST(BackgroundImage, BadPixelsAreCounted)
{
  TemporaryFolder folder;
  std::vector<float> values = ramp(32, 1);
  values[3] = -1.0f;
  values[9] = std::numeric_limits<float>::quiet_NaN();
  values[31] = std::numeric_limits<float>::infinity();
  writeFloats(folder.file("a.exr"), Imf::Header(8, 4), { { "Y", values } });
  EXPECT_HAS(errorOf(folder.file("a.exr")), "3 of 32 pixels");
  EXPECT_HAS(errorOf(folder.file("a.exr")), "a.exr");
}

TEST(BackgroundImage, UnsuitableImagesAreErrors)
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

TEST(BackgroundImage, DeepImageIsAnError)
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

TEST(BackgroundImage, AbsurdSizesAreRefusedBeforeAllocation)
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

TEST(BackgroundImage, AbsurdSizeOfAnAttributeIsNotAllocated)
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

TEST(BackgroundImage, ForeignFilesAreErrorsThatNameThem)
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
TEST(BackgroundImage, AFileCutAnywhereIsRefused)
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

TEST(BackgroundImage, DamagedFilesNeverCrash)
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
