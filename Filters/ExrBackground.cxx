// SPDX-License-Identifier: BSD-3-Clause
#include "ExrBackground.h"

#include "ExrFile.h"

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfEnvmap.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace po
{
namespace
{
/// 16384 x 8192: the largest panoramas in use; half a gigabyte of luminance.
constexpr ExrLimits Limits = { 1 << 16, 1 << 16, 1 << 13, std::int64_t{ 1 } << 27 };

/// Rows that are decoded at a time: what ZIP, PIZ and DWA compress together, times two.
constexpr int RowsAtATime = 64;

struct WeightedChannel
{
  std::string name;
  double weight;
};
using LuminanceChannels = std::vector<WeightedChannel>;

/// Luminance is row Y of the RGB to XYZ matrix that the primaries and the white point define.
LuminanceChannels rgbChannels(const Imf::Header& header)
{
  if (!Imf::hasChromaticities(header))
  {
    return { { "R", 0.2126 }, { "G", 0.7152 }, { "B", 0.0722 } };
  }
  const auto toXyz = Imf::RGBtoXYZ(Imf::chromaticities(header), 1.0f);
  return { { "R", toXyz[0][1] }, { "G", toXyz[1][1] }, { "B", toXyz[2][1] } };
}

LuminanceChannels chooseChannels(const Imf::Header& header)
{
  const Imf::ChannelList& channels = header.channels();
  if (channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B"))
  {
    return rgbChannels(header);
  }
  if (channels.findChannel("Y"))
  {
    return { { "Y", 1.0 } };
  }
  LuminanceChannels single;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel)
  {
    if (std::string(channel.name()) != "A")
    {
      single.push_back({ channel.name(), 1.0 });
    }
  }
  return single.size() == 1 ? single : LuminanceChannels{};
}

std::string channelNames(const Imf::MultiPartInputFile& file)
{
  std::string names;
  for (int part = 0; part < file.parts(); ++part)
  {
    const Imf::ChannelList& channels = file.header(part).channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
    {
      names += (names.empty() ? "" : ", ") + std::string(channel.name());
    }
  }
  return names.empty() ? "none" : names;
}

bool isDeep(const Imf::Header& header)
{
  return header.hasType() && Imf::isDeepData(header.type());
}

int choosePart(const std::string& fileName, const Imf::MultiPartInputFile& file)
{
  bool deep = false;
  for (int part = 0; part < file.parts(); ++part)
  {
    const Imf::Header& header = file.header(part);
    deep = deep || isDeep(header);
    if (!isDeep(header) && !chooseChannels(header).empty())
    {
      return part;
    }
  }
  refuseExr(fileName,
    deep ? "it holds a deep image; flatten it first."
         : "it has neither R, G, B nor Y nor one single channel but these: " + channelNames(file) +
        "; write it with R, G, B.");
}

void requireWholeSphere(
  const std::string& fileName, const Imf::Header& header, const LuminanceChannels& channels)
{
  if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE)
  {
    refuseExr(fileName, "it is a cube map; convert it to latitude/longitude.");
  }
  if (header.dataWindow() != header.displayWindow())
  {
    refuseExr(fileName,
      "its data window differs from its display window, so that it does not cover the whole "
      "sphere; "
      "write it uncropped.");
  }
  for (const WeightedChannel& channel : channels)
  {
    const Imf::Channel& stored = header.channels()[channel.name];
    if (stored.xSampling != 1 || stored.ySampling != 1)
    {
      refuseExr(
        fileName, "its channel " + channel.name + " is subsampled; write it at full resolution.");
    }
  }
}

/// Reads and weighs a block of rows at a time. The result grows with what was really read, so that
/// a damaged size in the header cannot ask for more memory than the file justifies.
class LuminanceReader
{
public:
  LuminanceReader(Imf::InputPart& part, const LuminanceChannels& channels)
    : part_(part)
    , channels_(channels)
    , window_(part.header().dataWindow())
    , width_(window_.max.x - window_.min.x + 1)
  {
  }

  void append(int firstRow, std::vector<float>& luminance)
  {
    const int lastRow = std::min(firstRow + RowsAtATime - 1, window_.max.y);
    const std::size_t pixels = std::size_t(width_) * (lastRow - firstRow + 1);
    read(firstRow, lastRow, pixels);
    const std::size_t start = luminance.size();
    luminance.resize(start + pixels);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    {
      double sum = 0.0;
      for (std::size_t channel = 0; channel < channels_.size(); ++channel)
      {
        sum += channels_[channel].weight * rows_[channel * pixels + pixel];
      }
      luminance[start + pixel] = static_cast<float>(sum);
    }
  }

private:
  void read(int firstRow, int lastRow, std::size_t pixels)
  {
    rows_.resize(pixels * channels_.size());
    Imf::FrameBuffer frame;
    for (std::size_t channel = 0; channel < channels_.size(); ++channel)
    {
      frame.insert(channels_[channel].name,
        Imf::Slice::Make(Imf::FLOAT, rows_.data() + channel * pixels,
          IMATH_NAMESPACE::V2i(window_.min.x, firstRow), width_, lastRow - firstRow + 1));
    }
    part_.setFrameBuffer(frame);
    part_.readPixels(firstRow, lastRow);
  }

  Imf::InputPart& part_;
  const LuminanceChannels& channels_;
  IMATH_NAMESPACE::Box2i window_;
  int width_;
  std::vector<float> rows_;
};

LatLongImage readLuminance(Imf::InputPart& part, const LuminanceChannels& channels)
{
  const auto& window = part.header().dataWindow();
  LatLongImage image;
  image.width = window.max.x - window.min.x + 1;
  image.height = window.max.y - window.min.y + 1;
  LuminanceReader reader(part, channels);
  for (int row = window.min.y; row <= window.max.y; row += RowsAtATime)
  {
    reader.append(row, image.luminance);
  }
  return image;
}

void requireLuminance(const std::string& fileName, const LatLongImage& image)
{
  const auto isBad = [](float value) { return !std::isfinite(value) || value < 0.0f; };
  const auto bad = std::count_if(image.luminance.begin(), image.luminance.end(), isBad);
  if (bad > 0)
  {
    refuseExr(fileName,
      std::to_string(bad) + " of " + std::to_string(image.luminance.size()) +
        " pixels are negative, infinite or not a number; clamp them to finite values from 0.");
  }
}
}

LatLongImage readLatLongImage(const std::string& fileName)
{
  checkExrFile(fileName, Limits);
  LatLongImage image;
  withExrReadErrors(fileName,
    [&]()
    {
      Imf::MultiPartInputFile file(fileName.c_str());
      const int number = choosePart(fileName, file);
      Imf::InputPart part(file, number);
      const LuminanceChannels channels = chooseChannels(part.header());
      requireWholeSphere(fileName, part.header(), channels);
      image = readLuminance(part, channels);
      requireLuminance(fileName, image);
    });
  return image;
}
}
