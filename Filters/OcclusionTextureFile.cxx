// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionTextureFile.h"

#include "ExrFile.h"
#include "OcclusionTextureLayout.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfStringVectorAttribute.h>
#include <ImfTiledInputPart.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <optional>
#include <vector>

using IMATH_NAMESPACE::V2i;

namespace po
{
namespace
{
/// The widest atlas is ceil(sqrt(2^31)) tiles; its pixels are checked against the file's size.
constexpr ExrLimits Limits = { 1 << 26, 1 << 26, MaximumTileSide, std::int64_t{ 1 } << 40 };
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
  std::string geometry;
  TexelPrecision precision = TexelPrecision::Float;
  std::mutex mutex; ///< OpenEXR keeps where a tile goes in the object that reads it

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
  if (const auto* text = header.findTypedAttribute<Imf::StringAttribute>(GeometryAttribute))
  {
    geometry = text->value();
  }
  const Imf::Channel* texels = header.channels().findChannel(TexelChannel);
  precision = texels && texels->type == Imf::HALF ? TexelPrecision::Half : TexelPrecision::Float;
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
  const TileGrid textureGrid(textureCount);
  const TileGrid particleGrid(particleCount);
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
  const double bytesPerTexel = precision == TexelPrecision::Half ? 2.0 : 4.0;
  const double bytes = bytesPerTexel * texels + 8.0 * static_cast<double>(particleCount);
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

const std::string& OcclusionTextureFile::geometry() const
{
  return internals_->geometry;
}

TexelPrecision OcclusionTextureFile::precision() const
{
  return internals_->precision;
}

void OcclusionTextureFile::readTexture(std::int64_t row, float* texels) const
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
      const TileGrid grid(file.textureCount);
      const std::lock_guard lock(file.mutex);
      file.textures->setFrameBuffer(tileBuffer(Imf::FLOAT, texels, file.resolution));
      file.textures->readTile(
        static_cast<int>(row % grid.columns), static_cast<int>(row / grid.columns));
    });
}

bool OcclusionTextureFile::hasPlaces() const
{
  return std::all_of(PlaceChannels.begin(), PlaceChannels.end(),
    [this](const char* name) { return internals_->file->header(1).channels().findChannel(name); });
}

std::vector<PlaceHash> OcclusionTextureFile::readPlaces() const
{
  Internals& file = *internals_;
  const TileGrid grid(file.particleCount);
  std::vector<PlaceHash> places(std::size_t(grid.columns) * grid.rows); // with the padding
  withExrReadErrors(file.fileName,
    [&]()
    {
      const std::lock_guard lock(file.mutex);
      Imf::InputPart part(*file.file, 1);
      Imf::FrameBuffer frame;
      addPlaces(frame, places.data(), grid.columns, 0, grid.rows);
      part.setFrameBuffer(frame);
      part.readPixels(0, grid.rows - 1);
    });
  places.resize(static_cast<std::size_t>(file.particleCount));
  return places;
}

void OcclusionTextureFile::readParticles(std::int32_t* rows, float* means) const
{
  Internals& file = *internals_;
  const TileGrid grid(file.particleCount);
  const int wholeLines = static_cast<int>(file.particleCount / grid.columns);
  withExrReadErrors(file.fileName,
    [&]()
    {
      const std::lock_guard lock(file.mutex);
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
