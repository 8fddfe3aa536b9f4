// SPDX-License-Identifier: BSD-3-Clause
#include "BackgroundImageTestSupport.h"

#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>

#include <half.h>

#include <limits>

using IMATH_NAMESPACE::V2f;

namespace
{
constexpr int Width = 150;
constexpr int Height = 75; // more rows than are read at a time

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
}
