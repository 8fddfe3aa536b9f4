// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OcclusionTextureLayout_h
#define po_OcclusionTextureLayout_h

// How texture tables lie in OpenEXR files (see OcclusionTextureFile.h): what the writer and the
// reader share. Internal to the module: includes OpenEXR.

#include "GeometryHash.h"

#include <ImfFrameBuffer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace po
{
inline constexpr int MaximumTileSide = 1024;
inline constexpr std::int64_t MaximumTextureCount = std::int64_t{ 1 } << 31;

inline constexpr const char* TexturesPart = "textures";
inline constexpr const char* ParticlesPart = "particles";
inline constexpr const char* TexelChannel = "Y";
inline constexpr const char* RowChannel = "texture";
inline constexpr const char* MeanChannel = "AO";
inline constexpr std::array<const char*, 2> PlaceChannels = { "place0", "place1" };
inline constexpr const char* TextureCountAttribute = "textureCount";
inline constexpr const char* ParticleCountAttribute = "particleCount";
inline constexpr const char* GeometryAttribute = "geometry";

/// A nearly square arrangement of `count` things in rows. Never empty, as no EXR image may be.
struct TileGrid
{
  explicit TileGrid(std::int64_t count)
    : columns(std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))))))
    , rows(std::max<int>(1, static_cast<int>((count + columns - 1) / columns)))
  {
  }
  int columns;
  int rows;
};

/// Every tile goes through the same buffer: coordinates are relative to the tile.
template <typename Texel>
Imf::FrameBuffer tileBuffer(Imf::PixelType type, Texel* texels, int side)
{
  Imf::FrameBuffer frame;
  frame.insert(TexelChannel,
    Imf::Slice(type, reinterpret_cast<char*>(texels), sizeof(Texel), sizeof(Texel) * side, 1, 1,
      0.0, true, true));
  return frame;
}

/// OpenEXR wants pointers to mutable memory for writing too, but does not change it.
inline Imf::FrameBuffer particleBuffer(
  const std::int32_t* rows, const float* means, int width, int firstLine, int lines)
{
  const IMATH_NAMESPACE::V2i origin(0, firstLine);
  Imf::FrameBuffer frame;
  frame.insert(RowChannel, Imf::Slice::Make(Imf::UINT, rows, origin, width, lines));
  frame.insert(MeanChannel, Imf::Slice::Make(Imf::FLOAT, means, origin, width, lines));
  return frame;
}

/// Adds what stands for the particles' places (see PlaceHash).
inline void addPlaces(
  Imf::FrameBuffer& frame, const PlaceHash* places, int width, int firstLine, int lines)
{
  const IMATH_NAMESPACE::V2i origin(0, firstLine);
  for (std::size_t half = 0; half < PlaceChannels.size(); ++half)
  {
    frame.insert(PlaceChannels[half],
      Imf::Slice::Make(Imf::UINT, places->data() + half, origin, width, lines, sizeof(PlaceHash)));
  }
}
}

#endif
