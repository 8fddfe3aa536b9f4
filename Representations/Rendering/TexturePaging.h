// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexturePaging_h
#define po_TexturePaging_h

#include "MapperInput.h"
#include "OcclusionTextures.h"

#include "vtkType.h"

#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

class vtkPolyData;

namespace po
{
class EncodedTextureFile;

/// Textures of particles in a file, of which a mapper loads those that are seen.
class TexturePaging
{
public:
  /// Opens the file and reads what it says of the particles; again only when one of the arguments
  /// changes. Whatever fails, an error says so and there are no textures.
  /// @param file name of a texture file, see OcclusionTextureFile; empty: none
  /// @param budget MiB that textures in memory may take, see PagedTextures
  [[nodiscard]] MapperMessages update(vtkPolyData& points, const std::string& file, double budget);

  /// The next update opens the file anew.
  void forget();

  /// Is there a file, if only one that cannot be used?
  [[nodiscard]] bool isOn() const { return !std::get<2>(source_).empty(); }

  /// Empty without a file that can be used.
  [[nodiscard]] const OcclusionTextures& textures() const { return textures_; }

  /// Is direct light in the textures?
  [[nodiscard]] bool hasBakedLight() const;

  /// Another number for other textures.
  [[nodiscard]] std::uint64_t version() const { return version_; }

  /// Why textures no longer arrive; once, then nothing.
  [[nodiscard]] std::string takeError();

private:
  using Source = std::tuple<vtkPolyData*, vtkMTimeType, std::string>;

  void open(vtkPolyData& points, const std::string& file, std::vector<std::string>& warnings);
  void page(double budget, std::vector<std::string>& warnings);

  Source source_{ nullptr, 0, {} };
  double budget_ = 0;
  std::shared_ptr<const EncodedTextureFile> file_;
  std::vector<std::int32_t> rows_; ///< of each point
  std::vector<float> means_;       ///< of each point
  OcclusionTextures textures_;
  std::uint64_t version_ = 0;
  bool isErrorTaken_ = false;
};
}

#endif
