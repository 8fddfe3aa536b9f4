// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BackgroundImageTestSupport_h
#define po_BackgroundImageTestSupport_h

// OpenEXR images as backgrounds: written in every form, and the errors of those that cannot be
// read.

#include "ExrTestSupport.h"

#include "ExrBackground.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

using IMATH_NAMESPACE::Box2i;
using IMATH_NAMESPACE::V2i;

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

inline void addChannels(Imf::Header& header, const Channels& channels, Imf::PixelType type)
{
  for (const auto& [name, values] : channels)
  {
    header.channels().insert(name, Imf::Channel(type));
  }
}

template <typename Pixel>
inline void writeAs(
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

inline void writeFloats(
  const std::string& fileName, const Imf::Header& header, const Channels& channels)
{
  writeAs<float>(fileName, header, channels, Imf::FLOAT);
}

// Small integers: exact in every pixel type.
inline std::vector<float> ramp(int count, int step)
{
  std::vector<float> values(count);
  for (int i = 0; i < count; ++i)
  {
    values[i] = static_cast<float>((i * step) % 101);
  }
  return values;
}

inline Channels rgb(int count)
{
  return { { "R", ramp(count, 1) }, { "G", ramp(count, 3) }, { "B", ramp(count, 7) } };
}

inline void expectLuminance(
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

inline std::string errorOf(const std::string& fileName)
{
  return whatIsThrown([&]() { po::readLatLongImage(fileName); });
}

#endif
