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

namespace Imf = OPENEXR_IMF_NAMESPACE;
using IMATH_NAMESPACE::V2i;

namespace po
{
namespace
{

constexpr int MaximumResolution = 1024;
constexpr std::int64_t MaximumCount = std::int64_t{ 1 } << 31;

// The widest atlas is ceil(sqrt(2^31)) tiles; its pixels are checked against the file's size.
constexpr ExrLimits Limits = { 1 << 26, 1 << 26, MaximumResolution, std::int64_t{ 1 } << 40 };

// ZIP makes the smallest files of the lossless kinds. Measured with 20,000 textures of 16 x 16 and
// 49 samples a texel, in percent of the bare floats and seconds to write and to read: NONE 103,
// .04, .03; RLE 102, .08, .04; ZIPS and ZIP 89, .68, .18; PIZ 103, 18, .03. At 64 x 64 ZIP comes to
// 55 %, at 8 x 8 nothing pays. The noise of the samples is what does not compress.
constexpr Imf::Compression TextureCompression = Imf::ZIP_COMPRESSION;
constexpr Imf::Compression ParticleCompression = Imf::ZIP_COMPRESSION;

constexpr const char* TexturesPart = "textures";
constexpr const char* ParticlesPart = "particles";
constexpr const char* TexelChannel = "Y";
constexpr const char* RowChannel = "texture";
constexpr const char* MeanChannel = "AO";
constexpr const char* TextureCountAttribute = "textureCount";
constexpr const char* ParticleCountAttribute = "particleCount";

// A nearly square arrangement of `count` things in rows. Never empty, as no EXR image may be.
struct Grid
{
  explicit Grid(std::int64_t count)
    : Columns(std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))))))
    , Rows(std::max<int>(1, static_cast<int>((count + Columns - 1) / Columns)))
  {
  }
  int Columns;
  int Rows;
};

Imf::Header TexturesHeader(const OcclusionTextureSource& source)
{
  const Grid grid(source.TextureCount);
  const int side = source.Resolution;
  Imf::Header header(grid.Columns * side, grid.Rows * side);
  header.setName(TexturesPart);
  header.setType(Imf::TILEDIMAGE);
  header.compression() = TextureCompression;
  header.channels().insert(TexelChannel, Imf::Channel(Imf::FLOAT));
  header.setTileDescription(Imf::TileDescription(side, side, Imf::ONE_LEVEL));
  header.insert(TextureCountAttribute, Imf::IntAttribute(static_cast<int>(source.TextureCount)));
  header.insert(ParticleCountAttribute, Imf::IntAttribute(static_cast<int>(source.ParticleCount)));
  header.insert(ParametersArray, Imf::StringVectorAttribute(source.Parameters.ToStrings()));
  Imf::addComments(header,
    "Ambient occlusion baked onto particles: one tile is the texture of a particle, linear "
    "visibility by polar angle (down) and azimuth (right).");
  return header;
}

// All parts of a file must have the same display window: that of the atlas.
Imf::Header ParticlesHeader(const OcclusionTextureSource& source, const Imf::Header& textures)
{
  const Grid grid(source.ParticleCount);
  const IMATH_NAMESPACE::Box2i window(V2i(0), V2i(grid.Columns - 1, grid.Rows - 1));
  Imf::Header header(textures.displayWindow(), window);
  header.setName(ParticlesPart);
  header.setType(Imf::SCANLINEIMAGE);
  header.compression() = ParticleCompression;
  header.channels().insert(RowChannel, Imf::Channel(Imf::UINT));
  header.channels().insert(MeanChannel, Imf::Channel(Imf::FLOAT));
  return header;
}

// Every tile goes through the same buffer: coordinates are relative to the tile.
Imf::FrameBuffer TileBuffer(float* texels, int side)
{
  Imf::FrameBuffer frame;
  frame.insert(TexelChannel,
    Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(texels), sizeof(float), sizeof(float) * side, 1,
      1, 0.0, true, true));
  return frame;
}

// OpenEXR wants pointers to mutable memory for writing too, but does not change it.
Imf::FrameBuffer ParticleBuffer(
  const std::int32_t* rows, const float* means, int width, int firstLine, int lines)
{
  const V2i origin(0, firstLine);
  Imf::FrameBuffer frame;
  frame.insert(RowChannel, Imf::Slice::Make(Imf::UINT, rows, origin, width, lines));
  frame.insert(MeanChannel, Imf::Slice::Make(Imf::FLOAT, means, origin, width, lines));
  return frame;
}

void WriteTextures(Imf::MultiPartOutputFile& file, const OcclusionTextureSource& source)
{
  const Grid grid(source.TextureCount);
  std::vector<float> texels(std::size_t(source.Resolution) * source.Resolution, 0.0f);
  Imf::TiledOutputPart part(file, 0);
  part.setFrameBuffer(TileBuffer(texels.data(), source.Resolution));
  for (std::int64_t row = 0; row < std::int64_t{ grid.Columns } * grid.Rows; ++row)
  {
    if (row < source.TextureCount)
    {
      source.Texture(row, texels.data());
    }
    else
    {
      std::fill(texels.begin(), texels.end(), 0.0f);
    }
    part.writeTile(static_cast<int>(row % grid.Columns), static_cast<int>(row / grid.Columns));
  }
}

// Whole lines are written from the caller's memory, the last one from a padded copy.
void WriteParticles(Imf::MultiPartOutputFile& file, const OcclusionTextureSource& source)
{
  const Grid grid(source.ParticleCount);
  const int wholeLines = static_cast<int>(source.ParticleCount / grid.Columns);
  Imf::OutputPart part(file, 1);
  if (wholeLines > 0)
  {
    part.setFrameBuffer(ParticleBuffer(source.Rows, source.Means, grid.Columns, 0, wholeLines));
    part.writePixels(wholeLines);
  }
  if (wholeLines < grid.Rows)
  {
    std::vector<std::int32_t> rows(grid.Columns, -1);
    std::vector<float> means(grid.Columns, 0.0f);
    const std::int64_t done = std::int64_t{ wholeLines } * grid.Columns;
    std::copy(source.Rows + done, source.Rows + source.ParticleCount, rows.begin());
    std::copy(source.Means + done, source.Means + source.ParticleCount, means.begin());
    part.setFrameBuffer(ParticleBuffer(rows.data(), means.data(), grid.Columns, wholeLines, 1));
    part.writePixels(1);
  }
}

void RequireWritable(const std::string& fileName, const OcclusionTextureSource& source)
{
  const std::string prefix = "Cannot write \"" + fileName + "\": ";
  if (source.Resolution < 1 || source.Resolution > MaximumResolution)
  {
    throw ExrError(prefix + "textures of " + std::to_string(source.Resolution) +
      " texels a side; 1 to " + std::to_string(MaximumResolution) + " are possible.");
  }
  if (source.TextureCount >= MaximumCount || source.ParticleCount >= MaximumCount)
  {
    throw ExrError(prefix + "more than 2^31 - 1 textures or particles; split the data.");
  }
}

}

void WriteOcclusionTextures(const std::string& fileName, const OcclusionTextureSource& source)
{
  RequireWritable(fileName, source);
  WriteExrFile(fileName,
    [&](Imf::OStream& stream)
    {
      const Imf::Header textures = TexturesHeader(source);
      const std::array<Imf::Header, 2> headers = { textures, ParticlesHeader(source, textures) };
      Imf::MultiPartOutputFile file(stream, headers.data(), static_cast<int>(headers.size()));
      WriteTextures(file, source);
      WriteParticles(file, source);
    });
}

struct OcclusionTextureFile::Internals
{
  std::string FileName;
  std::optional<Imf::MultiPartInputFile> File;
  std::optional<Imf::TiledInputPart> Textures;
  int Resolution = 0;
  std::int64_t TextureCount = 0;
  std::int64_t ParticleCount = 0;
  OcclusionParameters Parameters;

  void Open();
  void ReadHeader();
  void RequireSizes() const;
  void RequirePlausibleSize() const;
  std::int64_t ReadCount(const char* attribute) const;
  [[noreturn]] void RefuseForeign() const;
};

void OcclusionTextureFile::Internals::RefuseForeign() const
{
  RefuseExr(this->FileName,
    "it is an OpenEXR image, but not one of occlusion textures; choose a file that the occlusion "
    "texture writer has written.");
}

std::int64_t OcclusionTextureFile::Internals::ReadCount(const char* attribute) const
{
  const auto* count = this->File->header(0).findTypedAttribute<Imf::IntAttribute>(attribute);
  if (!count)
  {
    this->RefuseForeign();
  }
  if (count->value() < 0)
  {
    RefuseExr(this->FileName, std::string("its ") + attribute + " is negative; write it again.");
  }
  return count->value();
}

void OcclusionTextureFile::Internals::ReadHeader()
{
  const auto& header = this->File->header(0);
  const auto* strings = header.findTypedAttribute<Imf::StringVectorAttribute>(ParametersArray);
  if (!strings || this->File->parts() != 2 || !header.hasTileDescription() || !header.hasType() ||
    header.type() != Imf::TILEDIMAGE)
  {
    this->RefuseForeign();
  }
  this->TextureCount = this->ReadCount(TextureCountAttribute);
  this->ParticleCount = this->ReadCount(ParticleCountAttribute);
  this->Resolution = static_cast<int>(header.tileDescription().xSize);
  this->Parameters = OcclusionParameters::FromStrings(strings->value());
}

// Counts, tiles and windows must be what the writer makes of them: from here on they can be
// trusted.
void OcclusionTextureFile::Internals::RequireSizes() const
{
  const auto window = [this](int part) { return this->File->header(part).dataWindow(); };
  const auto is = [](const IMATH_NAMESPACE::Box2i& box, std::int64_t width, std::int64_t height)
  { return box.min == V2i(0) && box.max.x == width - 1 && box.max.y == height - 1; };
  const Imf::TileDescription& tiles = this->File->header(0).tileDescription();
  const Imf::Header& particles = this->File->header(1);
  const std::int64_t side = this->Resolution;
  const Grid textureGrid(this->TextureCount);
  const Grid particleGrid(this->ParticleCount);
  const bool consistent = tiles.ySize == tiles.xSize && tiles.mode == Imf::ONE_LEVEL &&
    is(window(0), textureGrid.Columns * side, textureGrid.Rows * side) &&
    is(window(1), particleGrid.Columns, particleGrid.Rows) &&
    this->File->header(0).channels().findChannel(TexelChannel) && particles.hasType() &&
    particles.type() == Imf::SCANLINEIMAGE && particles.channels().findChannel(RowChannel) &&
    particles.channels().findChannel(MeanChannel);
  if (!consistent)
  {
    RefuseExr(this->FileName,
      "its header contradicts itself (tiles, counts and sizes of the images); it is damaged, copy "
      "or write it again.");
  }
}

// Deflate cannot shrink by more than 1032 (zlib technical details): what claims to hold more than
// that is damaged, and nothing of the size that it claims must be allocated.
void OcclusionTextureFile::Internals::RequirePlausibleSize() const
{
  constexpr double largestRatio = 1032.0;
  const double fileBytes = static_cast<double>(std::filesystem::file_size(this->FileName));
  const double texels = double(this->TextureCount) * this->Resolution * this->Resolution;
  const double bytes = 4.0 * texels + 8.0 * static_cast<double>(this->ParticleCount);
  if (bytes > largestRatio * fileBytes)
  {
    RefuseExr(this->FileName,
      "it is too short for the textures that it announces; it is damaged or incomplete, copy or "
      "write it again.");
  }
}

void OcclusionTextureFile::Internals::Open()
{
  this->File.emplace(this->FileName.c_str());
  this->ReadHeader();
  this->RequireSizes();
  this->RequirePlausibleSize();
  this->Textures.emplace(*this->File, 0);
}

OcclusionTextureFile::OcclusionTextureFile(const std::string& fileName)
  : Internal(std::make_unique<Internals>())
{
  this->Internal->FileName = fileName;
  CheckExrFile(fileName, Limits);
  WithExrReadErrors(fileName, [this]() { this->Internal->Open(); });
}

OcclusionTextureFile::~OcclusionTextureFile() = default;

int OcclusionTextureFile::Resolution() const
{
  return this->Internal->Resolution;
}

std::int64_t OcclusionTextureFile::TextureCount() const
{
  return this->Internal->TextureCount;
}

std::int64_t OcclusionTextureFile::ParticleCount() const
{
  return this->Internal->ParticleCount;
}

const OcclusionParameters& OcclusionTextureFile::Parameters() const
{
  return this->Internal->Parameters;
}

void OcclusionTextureFile::ReadTexture(std::int64_t row, float* texels)
{
  Internals& file = *this->Internal;
  if (row < 0 || row >= file.TextureCount)
  {
    RefuseExr(file.FileName,
      "it has no texture " + std::to_string(row) + "; choose 0 to " +
        std::to_string(file.TextureCount - 1) + ".");
  }
  WithExrReadErrors(file.FileName,
    [&]()
    {
      const Grid grid(file.TextureCount);
      file.Textures->setFrameBuffer(TileBuffer(texels, file.Resolution));
      file.Textures->readTile(
        static_cast<int>(row % grid.Columns), static_cast<int>(row / grid.Columns));
    });
}

void OcclusionTextureFile::ReadParticles(std::int32_t* rows, float* means)
{
  Internals& file = *this->Internal;
  const Grid grid(file.ParticleCount);
  const int wholeLines = static_cast<int>(file.ParticleCount / grid.Columns);
  WithExrReadErrors(file.FileName,
    [&]()
    {
      Imf::InputPart part(*file.File, 1);
      if (wholeLines > 0)
      {
        part.setFrameBuffer(ParticleBuffer(rows, means, grid.Columns, 0, wholeLines));
        part.readPixels(0, wholeLines - 1);
      }
      if (wholeLines < grid.Rows)
      {
        std::vector<std::int32_t> lastRows(grid.Columns);
        std::vector<float> lastMeans(grid.Columns);
        part.setFrameBuffer(
          ParticleBuffer(lastRows.data(), lastMeans.data(), grid.Columns, wholeLines, 1));
        part.readPixels(wholeLines);
        const std::int64_t done = std::int64_t{ wholeLines } * grid.Columns;
        std::copy_n(lastRows.begin(), file.ParticleCount - done, rows + done);
        std::copy_n(lastMeans.begin(), file.ParticleCount - done, means + done);
      }
    });
  const bool valid = std::all_of(rows, rows + file.ParticleCount,
    [&](std::int32_t row) { return row >= -1 && row < file.TextureCount; });
  if (!valid)
  {
    RefuseExr(file.FileName, "it refers to textures that it lacks; it is damaged, write it again.");
  }
}

}
