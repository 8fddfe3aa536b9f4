// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionTextureFile.h"

#include "ExrFile.h"
#include "OcclusionTextureLayout.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfStringVectorAttribute.h>
#include <ImfTiledOutputPart.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using IMATH_NAMESPACE::V2i;

namespace po
{
namespace
{
/// ZIP makes the smallest files of the lossless kinds. Measured with 20,000 textures of 16 x 16 and
/// 49 samples a texel, in percent of the bare floats and seconds to write and to read: NONE 103,
/// .04, .03; RLE 102, .08, .04; ZIPS and ZIP 89, .68, .18; PIZ 103, 18, .03. At 64 x 64 ZIP comes
/// to 55 %, at 8 x 8 nothing pays. The noise of the samples is what does not compress.
constexpr Imf::Compression TextureCompression = Imf::ZIP_COMPRESSION;
constexpr Imf::Compression ParticleCompression = Imf::ZIP_COMPRESSION;

Imf::Header texturesHeader(const OcclusionTextureSource& source)
{
  const TileGrid grid(source.textureCount);
  const int side = source.resolution;
  Imf::Header header(grid.columns * side, grid.rows * side);
  header.setName(TexturesPart);
  header.setType(Imf::TILEDIMAGE);
  header.compression() = TextureCompression;
  const bool half = source.precision == TexelPrecision::Half;
  header.channels().insert(TexelChannel, Imf::Channel(half ? Imf::HALF : Imf::FLOAT));
  header.setTileDescription(Imf::TileDescription(side, side, Imf::ONE_LEVEL));
  header.insert(TextureCountAttribute, Imf::IntAttribute(static_cast<int>(source.textureCount)));
  header.insert(ParticleCountAttribute, Imf::IntAttribute(static_cast<int>(source.particleCount)));
  header.insert(ParametersArray, Imf::StringVectorAttribute(source.parameters.toStrings()));
  if (!source.geometry.empty())
  {
    header.insert(GeometryAttribute, Imf::StringAttribute(source.geometry));
  }
  Imf::addComments(header,
    "Ambient occlusion baked onto particles: one tile is the texture of a particle, linear "
    "visibility by polar angle (down) and azimuth (right).");
  return header;
}

/// All parts of a file must have the same display window: that of the atlas.
Imf::Header particlesHeader(const OcclusionTextureSource& source, const Imf::Header& textures)
{
  const TileGrid grid(source.particleCount);
  const IMATH_NAMESPACE::Box2i window(V2i(0), V2i(grid.columns - 1, grid.rows - 1));
  Imf::Header header(textures.displayWindow(), window);
  header.setName(ParticlesPart);
  header.setType(Imf::SCANLINEIMAGE);
  header.compression() = ParticleCompression;
  header.channels().insert(RowChannel, Imf::Channel(Imf::UINT));
  header.channels().insert(MeanChannel, Imf::Channel(Imf::FLOAT));
  for (const char* name : PlaceChannels)
  {
    if (source.places)
    {
      header.channels().insert(name, Imf::Channel(Imf::UINT));
    }
  }
  return header;
}

/// Hands tiles to OpenEXR, which wants them in the type of the file.
class TileWriter
{
public:
  TileWriter(Imf::MultiPartOutputFile& file, const OcclusionTextureSource& source)
    : part_(file, 0)
    , half_(source.precision == TexelPrecision::Half)
    , texels_(std::size_t(source.resolution) * source.resolution, 0.0f)
    , halves_(half_ ? texels_.size() : 0)
  {
    part_.setFrameBuffer(half_ ? tileBuffer(Imf::HALF, halves_.data(), source.resolution)
                               : tileBuffer(Imf::FLOAT, texels_.data(), source.resolution));
  }

  [[nodiscard]] std::vector<float>& texels() { return texels_; }

  void write(int column, int row)
  {
    if (half_)
    {
      std::transform(texels_.begin(), texels_.end(), halves_.begin(), toHalf);
    }
    part_.writeTile(column, row);
  }

private:
  static half toHalf(float value)
  {
    if (std::abs(value) > HALF_MAX)
    {
      throw ExrError("The textures hold values above 65504, which half-precision floats do not; "
                     "choose Float as precision. Nothing was changed on disk.");
    }
    return half(value);
  }

  Imf::TiledOutputPart part_;
  bool half_;
  std::vector<float> texels_;
  std::vector<half> halves_;
};

void writeTextures(Imf::MultiPartOutputFile& file, const OcclusionTextureSource& source)
{
  const TileGrid grid(source.textureCount);
  TileWriter tiles(file, source);
  for (std::int64_t row = 0; row < std::int64_t{ grid.columns } * grid.rows; ++row)
  {
    if (row < source.textureCount)
    {
      source.texture(row, tiles.texels().data());
    }
    else
    {
      std::fill(tiles.texels().begin(), tiles.texels().end(), 0.0f);
    }
    tiles.write(static_cast<int>(row % grid.columns), static_cast<int>(row / grid.columns));
  }
}

/// Lines of the particles' part, from the memory of the caller.
void writeLines(Imf::OutputPart& part, const std::int32_t* rows, const float* means,
  const PlaceHash* places, int width, int firstLine, int lines)
{
  Imf::FrameBuffer frame = particleBuffer(rows, means, width, firstLine, lines);
  if (places)
  {
    addPlaces(frame, places, width, firstLine, lines);
  }
  part.setFrameBuffer(frame);
  part.writePixels(lines);
}

/// Whole lines are written from the caller's memory, the last one from a padded copy.
void writeParticles(Imf::MultiPartOutputFile& file, const OcclusionTextureSource& source)
{
  const TileGrid grid(source.particleCount);
  const int wholeLines = static_cast<int>(source.particleCount / grid.columns);
  Imf::OutputPart part(file, 1);
  if (wholeLines > 0)
  {
    writeLines(part, source.rows, source.means, source.places, grid.columns, 0, wholeLines);
  }
  if (wholeLines < grid.rows)
  {
    std::vector<std::int32_t> rows(grid.columns, -1);
    std::vector<float> means(grid.columns, 0.0f);
    std::vector<PlaceHash> places(source.places ? grid.columns : 0, PlaceHash{});
    const std::int64_t done = std::int64_t{ wholeLines } * grid.columns;
    std::copy(source.rows + done, source.rows + source.particleCount, rows.begin());
    std::copy(source.means + done, source.means + source.particleCount, means.begin());
    if (source.places)
    {
      std::copy(source.places + done, source.places + source.particleCount, places.begin());
    }
    writeLines(part, rows.data(), means.data(), source.places ? places.data() : nullptr,
      grid.columns, wholeLines, 1);
  }
}

void requireWritable(const std::string& fileName, const OcclusionTextureSource& source)
{
  const std::string prefix = "Cannot write \"" + fileName + "\": ";
  if (source.resolution < 1 || source.resolution > MaximumTileSide)
  {
    throw ExrError(prefix + "textures of " + std::to_string(source.resolution) +
      " texels a side; 1 to " + std::to_string(MaximumTileSide) + " are possible.");
  }
  if (source.textureCount >= MaximumTextureCount || source.particleCount >= MaximumTextureCount)
  {
    throw ExrError(prefix + "more than 2^31 - 1 textures or particles; split the data.");
  }
}
}

void writeOcclusionTextures(const std::string& fileName, const OcclusionTextureSource& source)
{
  requireWritable(fileName, source);
  writeExrFile(fileName,
    [&](Imf::OStream& stream)
    {
      const Imf::Header textures = texturesHeader(source);
      const std::array<Imf::Header, 2> headers = { textures, particlesHeader(source, textures) };
      Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()));
      writeTextures(file, source);
      writeParticles(file, source);
    });
}
}
