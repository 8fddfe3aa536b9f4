// SPDX-License-Identifier: BSD-3-Clause
#ifndef OcclusionTextureFile_h
#define OcclusionTextureFile_h

#include "ParticleOcclusionFiltersModule.h"

#include "OcclusionParameters.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

// Texture tables in OpenEXR files.
//
// A file has two parts, since OpenEXR allows one layout a part:
//
// "textures", tiled, one FLOAT channel Y of linear values. One T x T tile is one texture, so that
// a texture can be read without the others. Tiles fill a grid that is nearly square, row by row:
// the file opens in any viewer as an atlas, and both sides stay small for any number of textures.
// Tiles after the last texture are zero. The first texel row of a texture (at +z) is on top.
//
// "particles", scan lines, a UINT channel "texture" (row of the particle's texture in the table;
// 4294967295 = none) and a FLOAT channel "AO" (mean visibility), folded in rows of equal width. The
// rest of the last row is padding.
//
// The header of "textures" holds the counts (int "textureCount", "particleCount") and the bake's
// parameters (string vector "AmbientOcclusionParameters" of "key=value" in their order).
namespace po
{

/// A texture table as the writer needs it. Pointers are borrowed.
struct OcclusionTextureSource
{
  int Resolution = 0; ///< T, texels on a side of a texture, 1 to 1024
  std::int64_t TextureCount = 0;
  std::int64_t ParticleCount = 0;
  OcclusionParameters Parameters;
  /// Stores the T * T linear values of a texture; called once a texture in ascending order.
  std::function<void(std::int64_t row, float* texels)> Texture;
  const std::int32_t* Rows = nullptr; ///< ParticleCount rows; -1 = no texture
  const float* Means = nullptr;       ///< ParticleCount mean visibilities
};

/// Writes the file beside and renames it. Throws a std::runtime_error that names the file.
PARTICLEOCCLUSIONFILTERS_EXPORT void WriteOcclusionTextures(
  const std::string& fileName, const OcclusionTextureSource& source);

/// A texture file that is open for reading. All members throw a std::runtime_error that names the
/// file, the fault and the cure.
class PARTICLEOCCLUSIONFILTERS_EXPORT OcclusionTextureFile
{
public:
  /// Reads the headers and the offsets of the tiles (8 bytes a texture), no pixels.
  explicit OcclusionTextureFile(const std::string& fileName);
  ~OcclusionTextureFile();
  OcclusionTextureFile(const OcclusionTextureFile&) = delete;
  OcclusionTextureFile& operator=(const OcclusionTextureFile&) = delete;

  [[nodiscard]] int Resolution() const;
  [[nodiscard]] std::int64_t TextureCount() const;
  [[nodiscard]] std::int64_t ParticleCount() const;
  [[nodiscard]] const OcclusionParameters& Parameters() const;

  /// Reads the T * T linear values of one texture: exactly one tile of the file.
  void ReadTexture(std::int64_t row, float* texels);

  /// Reads the row (-1 = none, else checked against TextureCount) and the mean of every particle.
  void ReadParticles(std::int32_t* rows, float* means);

private:
  struct Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
