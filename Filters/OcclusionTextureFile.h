// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OcclusionTextureFile_h
#define po_OcclusionTextureFile_h

#include "ParticleOcclusionFiltersModule.h"

#include "GeometryHash.h"
#include "OcclusionParameters.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

// Texture tables in OpenEXR files.
//
// A file has two parts, since OpenEXR allows one layout a part:
//
// "textures", tiled, one channel Y of linear values, FLOAT or HALF. One T x T tile is one texture,
// so that a texture can be read without the others. Tiles fill a grid that is nearly square, row by
// row: the file opens in any viewer as an atlas, and both sides stay small for any number of
// textures. Tiles after the last texture are zero. The first texel row of a texture (at +z) is on
// top.
//
// "particles", scan lines, a UINT channel "texture" (row of the particle's texture in the table;
// 4294967295 = none) and a FLOAT channel "AO" (mean visibility), folded in rows of equal width. The
// rest of the last row is padding. UINT channels "place0" and "place1", which files may lack, are
// the halves of what placeHashes says of each particle: so it is found in any order, and by
// processes that have a part of the particles.
//
// The header of "textures" holds the counts (int "textureCount", "particleCount"), the bake's
// parameters (string vector "AmbientOcclusionParameters" of "key=value" in their order) and, as
// string "geometry", what hashGeometry says of the particles.
namespace po
{
/// How texels are stored in a file.
enum class TexelPrecision
{
  Float = 0, ///< 32 bits
  Half = 1   ///< 16 bits: rounded by up to 1/2048 of the value
};

/// A texture table as the writer needs it. Pointers are borrowed.
struct OcclusionTextureSource
{
  int resolution = 0; ///< T, texels on a side of a texture, 1 to 1024
  std::int64_t textureCount = 0;
  std::int64_t particleCount = 0;
  OcclusionParameters parameters;
  std::string geometry; ///< of the particles, see hashGeometry; may be empty
  /// Half needs values of at most 65,504; bytes of UInt8Gamma2 come back as they were where the
  /// maximum is at least 1/128.
  TexelPrecision precision = TexelPrecision::Float;
  /// Stores the T * T linear values of a texture; called once a texture in ascending order.
  std::function<void(std::int64_t row, float* texels)> texture;
  const std::int32_t* rows = nullptr; ///< particleCount rows; -1 = no texture
  const float* means = nullptr;       ///< particleCount mean visibilities
  const PlaceHash* places = nullptr;  ///< particleCount places, or null: the file has none
};

/// Writes the file beside and renames it; holds one texture at a time. Throws a std::runtime_error
/// that names the file.
PARTICLEOCCLUSIONFILTERS_EXPORT void writeOcclusionTextures(
  const std::string& fileName, const OcclusionTextureSource& source);

/// A texture file that is open for reading. All members throw a std::runtime_error that names the
/// file, the fault and the cure. Threads may read from one object at the same time.
class PARTICLEOCCLUSIONFILTERS_EXPORT OcclusionTextureFile
{
public:
  /// Reads the headers and the offsets of the tiles (8 bytes a texture), no pixels.
  explicit OcclusionTextureFile(const std::string& fileName);
  ~OcclusionTextureFile();
  OcclusionTextureFile(const OcclusionTextureFile&) = delete;
  OcclusionTextureFile& operator=(const OcclusionTextureFile&) = delete;

  [[nodiscard]] int resolution() const;
  [[nodiscard]] std::int64_t textureCount() const;
  [[nodiscard]] std::int64_t particleCount() const;
  [[nodiscard]] const OcclusionParameters& parameters() const;
  [[nodiscard]] const std::string& geometry() const; ///< empty if the file does not say it
  [[nodiscard]] TexelPrecision precision() const;

  /// Reads the T * T linear values of one texture: exactly one tile of the file.
  void readTexture(std::int64_t row, float* texels) const;

  /// Reads the row (-1 = none, else checked against textureCount) and the mean of every particle.
  void readParticles(std::int32_t* rows, float* means) const;

  [[nodiscard]] bool hasPlaces() const;

  /// Reads the place of every particle, of a file that has them.
  [[nodiscard]] std::vector<PlaceHash> readPlaces() const;

private:
  struct Internals;
  std::unique_ptr<Internals> internals_;
};
}

#endif
