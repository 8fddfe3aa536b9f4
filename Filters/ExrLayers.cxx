// SPDX-License-Identifier: BSD-3-Clause
#include "ExrLayers.h"

#include "ExrFile.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>

#include <set>

namespace po
{
namespace
{
constexpr Imf::PixelType typeOf(const std::vector<half>&)
{
  return Imf::HALF;
}
constexpr Imf::PixelType typeOf(const std::vector<float>&)
{
  return Imf::FLOAT;
}
constexpr Imf::PixelType typeOf(const std::vector<std::uint32_t>&)
{
  return Imf::UINT;
}

void requireDistinctNames(const std::string& fileName, const std::vector<ExrChannel>& channels)
{
  std::set<std::string> names;
  for (const ExrChannel& channel : channels)
  {
    if (!names.insert(channel.name).second)
    {
      throw ExrError("Cannot write \"" + fileName + "\": two arrays would become the channel \"" +
        channel.name + "\"; rename one.");
    }
  }
}
}

void writeExrLayers(
  const std::string& fileName, int width, int height, const std::vector<ExrChannel>& channels)
{
  requireDistinctNames(fileName, channels);
  Imf::Header header(width, height);
  // Of the lossless kinds the one that every viewer reads and that is small for depth and normals.
  header.compression() = Imf::ZIP_COMPRESSION;
  // R, G and B have the primaries of sRGB; this is the default, but readers may want it said.
  Imf::addChromaticities(header, Imf::Chromaticities());
  Imf::FrameBuffer frame;
  for (const ExrChannel& channel : channels)
  {
    std::visit(
      [&](const auto& pixels)
      {
        const Imf::PixelType type = typeOf(pixels);
        header.channels().insert(channel.name, Imf::Channel(type));
        frame.insert(channel.name,
          Imf::Slice::Make(type, pixels.data(), IMATH_NAMESPACE::V2i(0), width, height));
      },
      channel.pixels);
  }
  writeExrFile(fileName,
    [&](Imf::OStream& stream)
    {
      Imf::OutputFile file(stream, header);
      file.setFrameBuffer(frame);
      file.writePixels(height);
    });
}
}
