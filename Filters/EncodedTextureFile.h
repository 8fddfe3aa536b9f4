// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_EncodedTextureFile_h
#define po_EncodedTextureFile_h

#include "OcclusionTextureFile.h"
#include "OcclusionTextures.h"
#include "ParticleOcclusionFiltersModule.h"
#include "TextureLoader.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkPointSet;

namespace po
{
/// A texture file whose textures come in the encoding that its parameters name, as they were in the
/// table that was written.
class PARTICLEOCCLUSIONFILTERS_EXPORT EncodedTextureFile : public TextureSource
{
public:
  /// Reads what OcclusionTextureFile reads. Throws a std::runtime_error that names the file, also
  /// if its parameters do not describe its textures.
  explicit EncodedTextureFile(const std::string& fileName);

  [[nodiscard]] const OcclusionTextureFile& file() const { return file_; }
  [[nodiscard]] const TexelFormat& format() const { return format_; }

  /// Throws a std::runtime_error if the file is for another number of particles.
  /// @return a warning if the particles have other positions or radii than those of the file
  [[nodiscard]] std::string checkParticles(vtkPointSet& points) const;

  /// Reads the row (-1 = none) and the mean of each point: by the order of the points, or where
  /// that is another or only some of the particles are there, by their places, if the file has
  /// them. Throws what checkParticles throws.
  /// @return a warning if the particles have other positions or radii than those of the file
  [[nodiscard]] std::string readParticles(
    vtkPointSet& points, std::vector<std::int32_t>& rows, std::vector<float>& means) const;

  /// Stores format().textureBytes() bytes. For one thread at a time.
  void read(std::int32_t row, void* texels) const override;

private:
  [[nodiscard]] bool isSameGeometry(vtkPointSet& points) const;
  [[nodiscard]] bool findByPlace(
    vtkPointSet& points, std::vector<std::int32_t>& rows, std::vector<float>& means) const;
  [[nodiscard]] std::string radiusArray() const;

  std::string fileName_;
  OcclusionTextureFile file_;
  TexelFormat format_;
  mutable std::vector<float> values_; ///< of the texture that is being read
};
}

#endif
