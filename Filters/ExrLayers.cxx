// SPDX-License-Identifier: BSD-3-Clause
#include "ExrLayers.h"

#include "ExrFile.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>

#include <set>

namespace po
{
namespace
{
/// A picture of 65,536 x 4,096 pixels: a gigabyte a channel.
constexpr ExrLimits Limits = { 1 << 16, 1 << 16, 1 << 13, std::int64_t{ 1 } << 28 };

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

/// Calls read(part) for the first part that is an image.
template <typename Read>
void readFlatPart(const std::string& fileName, const Read& read)
{
  checkExrFile(fileName, Limits);
  withExrReadErrors(fileName,
    [&]()
    {
      Imf::MultiPartInputFile file(fileName.c_str());
      for (int number = 0; number < file.parts(); ++number)
      {
        const Imf::Header& header = file.header(number);
        if (!header.hasType() || !Imf::isDeepData(header.type()))
        {
          Imf::InputPart part(file, number);
          read(part);
          return;
        }
      }
      refuseExr(fileName, "it holds a deep image; flatten it first.");
    });
}

ExrImage sizeOf(const Imf::InputPart& part)
{
  const auto& window = part.header().dataWindow();
  return { window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, {} };
}

/// Room for a channel, of the type that it is read as.
ExrChannel makeChannel(const std::string& name, Imf::PixelType type, std::size_t pixels)
{
  if (type == Imf::UINT)
  {
    return { name, std::vector<std::uint32_t>(pixels) };
  }
  return { name, std::vector<float>(pixels) };
}

void readChannels(Imf::InputPart& part, ExrImage& image)
{
  const Imf::ChannelList& list = part.header().channels();
  for (auto channel = list.begin(); channel != list.end(); ++channel)
  {
    const Imf::Channel& stored = channel.channel();
    if (stored.xSampling == 1 && stored.ySampling == 1)
    {
      image.channels.push_back(makeChannel(
        channel.name(), stored.type, static_cast<std::size_t>(image.width) * image.height));
    }
  }
  const auto& window = part.header().dataWindow();
  Imf::FrameBuffer frame;
  for (ExrChannel& channel : image.channels)
  {
    std::visit(
      [&](auto& pixels)
      {
        frame.insert(channel.name,
          Imf::Slice::Make(typeOf(pixels), pixels.data(), window.min, image.width, image.height));
      },
      channel.pixels);
  }
  part.setFrameBuffer(frame);
  part.readPixels(window.min.y, window.max.y);
}
}

ExrImage readExrSize(const std::string& fileName)
{
  ExrImage image;
  readFlatPart(fileName, [&](Imf::InputPart& part) { image = sizeOf(part); });
  return image;
}

ExrImage readExrLayers(const std::string& fileName)
{
  ExrImage image;
  readFlatPart(fileName,
    [&](Imf::InputPart& part)
    {
      image = sizeOf(part);
      readChannels(part, image);
      if (image.channels.empty())
      {
        refuseExr(fileName, "it has no channel at full resolution; write one.");
      }
    });
  return image;
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
