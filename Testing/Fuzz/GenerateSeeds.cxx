// SPDX-License-Identifier: BSD-3-Clause
// Writes the seeds of all fuzz targets, one folder each: small files of every layout, and bytes
// from which data sets and parameters are made.
#include "ExrTestSupport.h"

#include "OcclusionTextureFile.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTileDescription.h>
#include <ImfTiledOutputFile.h>

#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace
{
void writeTextureFile(const fs::path& file, int resolution, std::int64_t textures,
  std::int64_t particles, const char* encoding)
{
  std::mt19937 random(1);
  std::vector<std::int32_t> rows(static_cast<std::size_t>(particles));
  std::vector<float> means(rows.size(), 0.5f);
  for (std::int32_t& row : rows)
  {
    row = static_cast<std::int32_t>(random() % static_cast<unsigned>(textures + 1)) - 1;
  }
  po::OcclusionTextureSource source;
  source.resolution = resolution;
  source.textureCount = textures;
  source.particleCount = particles;
  source.parameters.set("resolution", resolution);
  source.parameters.set("encoding", encoding);
  source.parameters.set("maximum", 1.0);
  source.texture = [&](std::int64_t, float* texels)
  {
    for (int i = 0; i < resolution * resolution; ++i)
    {
      texels[i] = std::generate_canonical<float, 24>(random);
    }
  };
  source.rows = rows.data();
  source.means = means.data();
  po::writeOcclusionTextures(file.string(), source);
}

void writeTextureFiles(const fs::path& folder)
{
  writeTextureFile(folder / "bytes", 4, 3, 5, po::UInt8Gamma2);
  writeTextureFile(folder / "floats", 2, 9, 20, po::Float32Linear);
  writeTextureFile(folder / "one", 1, 1, 1, po::UInt8Gamma2);
  writeTextureFile(folder / "none", 2, 0, 3, po::Float32Linear);
}

void writeImage(const fs::path& file, const std::vector<const char*>& channels, Imf::PixelType type,
  Imf::Compression compression, bool tiled)
{
  constexpr int Width = 8, Height = 6;
  Imf::Header header(Width, Height);
  header.compression() = compression;
  std::vector<float> floats(Width * Height, 0.5f);
  std::vector<half> halves(floats.begin(), floats.end());
  Imf::FrameBuffer frame;
  for (const char* channel : channels)
  {
    header.channels().insert(channel, Imf::Channel(type));
    const void* pixels = type == Imf::HALF ? static_cast<const void*>(halves.data())
                                           : static_cast<const void*>(floats.data());
    frame.insert(channel, Imf::Slice::Make(type, pixels, IMATH_NAMESPACE::V2i(0), Width, Height));
  }
  if (tiled)
  {
    header.setTileDescription(Imf::TileDescription(4, 4, Imf::ONE_LEVEL));
    Imf::TiledOutputFile out(file.c_str(), header);
    out.setFrameBuffer(frame);
    out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
    return;
  }
  Imf::OutputFile out(file.c_str(), header);
  out.setFrameBuffer(frame);
  out.writePixels(Height);
}

void writeBackgrounds(const fs::path& folder)
{
  const std::vector<const char*> rgb = { "R", "G", "B" };
  for (int compression = Imf::NO_COMPRESSION; compression < Imf::NUM_COMPRESSION_METHODS;
       ++compression)
  {
    const auto kind = static_cast<Imf::Compression>(compression);
    const std::string name = std::to_string(compression);
    writeImage(folder / ("rgb" + name), rgb, Imf::HALF, kind, false);
    writeImage(folder / ("tiled" + name), { "Y" }, Imf::FLOAT, kind, true);
  }
}

void writeRandomBytes(const fs::path& folder)
{
  std::mt19937 random(2);
  for (int i = 0; i < 24; ++i)
  {
    Bytes bytes(16 + static_cast<std::size_t>(i) * 24);
    for (char& byte : bytes)
    {
      byte = static_cast<char>(random());
    }
    writeBytes((folder / std::to_string(i)).string(), bytes);
  }
}

fs::path emptyFolder(const fs::path& path)
{
  fs::remove_all(path);
  fs::create_directories(path);
  return path;
}
}

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 1;
  }
  const fs::path folder(argv[1]);
  writeTextureFiles(emptyFolder(folder / "TextureFile"));
  writeBackgrounds(emptyFolder(folder / "Background"));
  for (const char* target : { "ArrayLayouts", "Parameters", "BakedTextures" })
  {
    writeRandomBytes(emptyFolder(folder / target));
  }
  return 0;
}
