// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionTextureFile.h"

#include "ExrFile.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringVectorAttribute.h>
#include <ImfTiledInputPart.h>
#include <ImfTiledOutputPart.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <vector>

using IMATH_NAMESPACE::V2i;

namespace po
{
namespace
{
constexpr int MaximumResolution = 1024;
constexpr std::int64_t MaximumCount = std::int64_t{ 1 } << 31;

/// The widest atlas is ceil(sqrt(2^31)) tiles; its pixels are checked against the file's size.
constexpr ExrLimits Limits = { 1 << 26, 1 << 26, MaximumResolution, std::int64_t{ 1 } << 40 };

/// ZIP makes the smallest files of the lossless kinds. Measured with 20,000 textures of 16 x 16 and
/// 49 samples a texel, in percent of the bare floats and seconds to write and to read: NONE 103,
/// .04, .03; RLE 102, .08, .04; ZIPS and ZIP 89, .68, .18; PIZ 103, 18, .03. At 64 x 64 ZIP comes
/// to 55 %, at 8 x 8 nothing pays. The noise of the samples is what does not compress.
constexpr Imf::Compression TextureCompression = Imf::ZIP_COMPRESSION;
constexpr Imf::Compression ParticleCompression = Imf::ZIP_COMPRESSION;

constexpr const char* TexturesPart = "textures";
constexpr const char* ParticlesPart = "particles";
constexpr const char* TexelChannel = "Y";
constexpr const char* RowChannel = "texture";
constexpr const char* MeanChannel = "AO";
constexpr const char* TextureCountAttribute = "textureCount";
constexpr const char* ParticleCountAttribute = "particleCount";

/// A nearly square arrangement of `count` things in rows. Never empty, as no EXR image may be.
struct Grid
{
  explicit Grid(std::int64_t count)
    : columns(std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))))))
    , rows(std::max<int>(1, static_cast<int>((count + columns - 1) / columns)))
  {
  }
  int columns;
  int rows;
};

Imf::Header texturesHeader(const OcclusionTextureSource& source)
{
  const Grid grid(source.textureCount);
  const int side = source.resolution;
  Imf::Header header(grid.columns * side, grid.rows * side);
  header.setName(TexturesPart);
  header.setType(Imf::TILEDIMAGE);
  header.compression() = TextureCompression;
  header.channels().insert(TexelChannel, Imf::Channel(Imf::FLOAT));
  header.setTileDescription(Imf::TileDescription(side, side, Imf::ONE_LEVEL));
  header.insert(TextureCountAttribute, Imf::IntAttribute(static_cast<int>(source.textureCount)));
  header.insert(ParticleCountAttribute, Imf::IntAttribute(static_cast<int>(source.particleCount)));
  header.insert(ParametersArray, Imf::StringVectorAttribute(source.parameters.toStrings()));
  Imf::addComments(header,
    "Ambient occlusion baked onto particles: one tile is the texture of a particle, linear "
    "visibility by polar angle (down) and azimuth (right).");
  return header;
}

/// All parts of a file must have the same display window: that of the atlas.
Imf::Header particlesHeader(const OcclusionTextureSource& source, const Imf::Header& textures)
{
  const Grid grid(source.particleCount);
  const IMATH_NAMESPACE::Box2i window(V2i(0), V2i(grid.columns - 1, grid.rows - 1));
  Imf::Header header(textures.displayWindow(), window);
  header.setName(ParticlesPart);
  header.setType(Imf::SCANLINEIMAGE);
  header.compression() = ParticleCompression;
  header.channels().insert(RowChannel, Imf::Channel(Imf::UINT));
  header.channels().insert(MeanChannel, Imf::Channel(Imf::FLOAT));
  return header;
}

/// Every tile goes through the same buffer: coordinates are relative to the tile.
Imf::FrameBuffer tileBuffer(float* texels, int side)
{
  Imf::FrameBuffer frame;
  frame.insert(TexelChannel,
    Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(texels), sizeof(float), sizeof(float) * side, 1,
      1, 0.0, true, true));
  return frame;
}

/// OpenEXR wants pointers to mutable memory for writing too, but does not change it.
Imf::FrameBuffer particleBuffer(
  const std::int32_t* rows, const float* means, int width, int firstLine, int lines)
{
  const V2i origin(0, firstLine);
  Imf::FrameBuffer frame;
  frame.insert(RowChannel, Imf::Slice::Make(Imf::UINT, rows, origin, width, lines));
  frame.insert(MeanChannel, Imf::Slice::Make(Imf::FLOAT, means, origin, width, lines));
  return frame;
}

void writeTextures(Imf::MultiPartOutputFile& file, const OcclusionTextureSource& source)
{
  const Grid grid(source.textureCount);
  std::vector<float> texels(std::size_t(source.resolution) * source.resolution, 0.0f);
  Imf::TiledOutputPart part(file, 0);
  part.setFrameBuffer(tileBuffer(texels.data(), source.resolution));
  for (std::int64_t row = 0; row < std::int64_t{ grid.columns } * grid.rows; ++row)
  {
    if (row < source.textureCount)
    {
      source.texture(row, texels.data());
    }
    else
    {
      std::fill(texels.begin(), texels.end(), 0.0f);
    }
    part.writeTile(static_cast<int>(row % grid.columns), static_cast<int>(row / grid.columns));
  }
}

/// Whole lines are written from the caller's memory, the last one from a padded copy.
void writeParticles(Imf::MultiPartOutputFile& file, const OcclusionTextureSource& source)
{
  const Grid grid(source.particleCount);
  const int wholeLines = static_cast<int>(source.particleCount / grid.columns);
  Imf::OutputPart part(file, 1);
  if (wholeLines > 0)
  {
    part.setFrameBuffer(particleBuffer(source.rows, source.means, grid.columns, 0, wholeLines));
    part.writePixels(wholeLines);
  }
  if (wholeLines < grid.rows)
  {
    std::vector<std::int32_t> rows(grid.columns, -1);
    std::vector<float> means(grid.columns, 0.0f);
    const std::int64_t done = std::int64_t{ wholeLines } * grid.columns;
    std::copy(source.rows + done, source.rows + source.particleCount, rows.begin());
    std::copy(source.means + done, source.means + source.particleCount, means.begin());
    part.setFrameBuffer(particleBuffer(rows.data(), means.data(), grid.columns, wholeLines, 1));
    part.writePixels(1);
  }
}

void requireWritable(const std::string& fileName, const OcclusionTextureSource& source)
{
  const std::string prefix = "Cannot write \"" + fileName + "\": ";
  if (source.resolution < 1 || source.resolution > MaximumResolution)
  {
    throw ExrError(prefix + "textures of " + std::to_string(source.resolution) +
      " texels a side; 1 to " + std::to_string(MaximumResolution) + " are possible.");
  }
  if (source.textureCount >= MaximumCount || source.particleCount >= MaximumCount)
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

struct OcclusionTextureFile::Internals
{
  std::string fileName;
  std::optional<Imf::MultiPartInputFile> file;
  std::optional<Imf::TiledInputPart> textures;
  int resolution = 0;
  std::int64_t textureCount = 0;
  std::int64_t particleCount = 0;
  OcclusionParameters parameters;

  void open();
  void readHeader();
  void requireSizes() const;
  void requirePlausibleSize() const;
  std::int64_t readCount(const char* attribute) const;
  [[noreturn]] void refuseForeign() const;
};

void OcclusionTextureFile::Internals::refuseForeign() const
{
  refuseExr(fileName,
    "it is an OpenEXR image, but not one of occlusion textures; choose a file that the occlusion "
    "texture writer has written.");
}

std::int64_t OcclusionTextureFile::Internals::readCount(const char* attribute) const
{
  const auto* count = file->header(0).findTypedAttribute<Imf::IntAttribute>(attribute);
  if (!count)
  {
    refuseForeign();
  }
  if (count->value() < 0)
  {
    refuseExr(fileName, std::string("its ") + attribute + " is negative; write it again.");
  }
  return count->value();
}

void OcclusionTextureFile::Internals::readHeader()
{
  const auto& header = file->header(0);
  const auto* strings = header.findTypedAttribute<Imf::StringVectorAttribute>(ParametersArray);
  if (!strings || file->parts() != 2 || !header.hasTileDescription() || !header.hasType() ||
    header.type() != Imf::TILEDIMAGE)
  {
    refuseForeign();
  }
  textureCount = readCount(TextureCountAttribute);
  particleCount = readCount(ParticleCountAttribute);
  resolution = static_cast<int>(header.tileDescription().xSize);
  parameters = OcclusionParameters::fromStrings(strings->value());
}

/// Counts, tiles and windows must be what the writer makes of them: from here on they can be
/// trusted.
void OcclusionTextureFile::Internals::requireSizes() const
{
  const auto window = [this](int part) { return file->header(part).dataWindow(); };
  const auto is = [](const IMATH_NAMESPACE::Box2i& box, std::int64_t width, std::int64_t height)
  { return box.min == V2i(0) && box.max.x == width - 1 && box.max.y == height - 1; };
  const Imf::TileDescription& tiles = file->header(0).tileDescription();
  const Imf::Header& particles = file->header(1);
  const std::int64_t side = resolution;
  const Grid textureGrid(textureCount);
  const Grid particleGrid(particleCount);
  const bool consistent = tiles.ySize == tiles.xSize && tiles.mode == Imf::ONE_LEVEL &&
    is(window(0), textureGrid.columns * side, textureGrid.rows * side) &&
    is(window(1), particleGrid.columns, particleGrid.rows) &&
    file->header(0).channels().findChannel(TexelChannel) && particles.hasType() &&
    particles.type() == Imf::SCANLINEIMAGE && particles.channels().findChannel(RowChannel) &&
    particles.channels().findChannel(MeanChannel);
  if (!consistent)
  {
    refuseExr(fileName,
      "its header contradicts itself (tiles, counts and sizes of the images); it is damaged, copy "
      "or write it again.");
  }
}

/// Deflate cannot shrink by more than 1032 (zlib technical details): what claims to hold more than
/// that is damaged, and nothing of the size that it claims must be allocated.
void OcclusionTextureFile::Internals::requirePlausibleSize() const
{
  constexpr double LargestRatio = 1032.0;
  const double fileBytes = static_cast<double>(std::filesystem::file_size(fileName));
  const double texels = double(textureCount) * resolution * resolution;
  const double bytes = 4.0 * texels + 8.0 * static_cast<double>(particleCount);
  if (bytes > LargestRatio * fileBytes)
  {
    refuseExr(fileName,
      "it is too short for the textures that it announces; it is damaged or incomplete, copy or "
      "write it again.");
  }
}

void OcclusionTextureFile::Internals::open()
{
  file.emplace(fileName.c_str());
  readHeader();
  requireSizes();
  requirePlausibleSize();
  textures.emplace(*file, 0);
}

OcclusionTextureFile::OcclusionTextureFile(const std::string& fileName)
  : internals_(std::make_unique<Internals>())
{
  internals_->fileName = fileName;
  checkExrFile(fileName, Limits);
  withExrReadErrors(fileName, [this]() { internals_->open(); });
}

OcclusionTextureFile::~OcclusionTextureFile() = default;

int OcclusionTextureFile::resolution() const
{
  return internals_->resolution;
}

std::int64_t OcclusionTextureFile::textureCount() const
{
  return internals_->textureCount;
}

std::int64_t OcclusionTextureFile::particleCount() const
{
  return internals_->particleCount;
}

const OcclusionParameters& OcclusionTextureFile::parameters() const
{
  return internals_->parameters;
}

void OcclusionTextureFile::readTexture(std::int64_t row, float* texels)
{
  Internals& file = *internals_;
  if (row < 0 || row >= file.textureCount)
  {
    refuseExr(file.fileName,
      "it has no texture " + std::to_string(row) + "; choose 0 to " +
        std::to_string(file.textureCount - 1) + ".");
  }
  withExrReadErrors(file.fileName,
    [&]()
    {
      const Grid grid(file.textureCount);
      file.textures->setFrameBuffer(tileBuffer(texels, file.resolution));
      file.textures->readTile(
        static_cast<int>(row % grid.columns), static_cast<int>(row / grid.columns));
    });
}

void OcclusionTextureFile::readParticles(std::int32_t* rows, float* means)
{
  Internals& file = *internals_;
  const Grid grid(file.particleCount);
  const int wholeLines = static_cast<int>(file.particleCount / grid.columns);
  withExrReadErrors(file.fileName,
    [&]()
    {
      Imf::InputPart part(*file.file, 1);
      if (wholeLines > 0)
      {
        part.setFrameBuffer(particleBuffer(rows, means, grid.columns, 0, wholeLines));
        part.readPixels(0, wholeLines - 1);
      }
      if (wholeLines < grid.rows)
      {
        std::vector<std::int32_t> lastRows(grid.columns);
        std::vector<float> lastMeans(grid.columns);
        part.setFrameBuffer(
          particleBuffer(lastRows.data(), lastMeans.data(), grid.columns, wholeLines, 1));
        part.readPixels(wholeLines);
        const std::int64_t done = std::int64_t{ wholeLines } * grid.columns;
        std::copy_n(lastRows.begin(), file.particleCount - done, rows + done);
        std::copy_n(lastMeans.begin(), file.particleCount - done, means + done);
      }
    });
  const bool valid = std::all_of(rows, rows + file.particleCount,
    [&](std::int32_t row) { return row >= -1 && row < file.textureCount; });
  if (!valid)
  {
    refuseExr(file.fileName, "it refers to textures that it lacks; it is damaged, write it again.");
  }
}
}
