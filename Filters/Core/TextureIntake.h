// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextureIntake_h
#define po_TextureIntake_h

#include "BakeSettings.h"
#include "ProcessGroup.h"
#include "TextureTable.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace po
{
/// Takes the textures of a bake one after the other, in as little memory as their form allows.
///
/// Bytes stand for shares of the largest value of all. Before a uniform background no value is
/// above 1, so that the largest is known as soon as one texel is fully open: from then on textures
/// are made bytes at once, with the same result. Until then, before other backgrounds, and where
/// textures are stored in another form, linear values are kept, 4 bytes a texel.
class TextureIntake
{
public:
  /// @param particles how many textures to expect
  TextureIntake(const BakeSettings& settings, std::size_t particles);

  /// The texture of the next particle: T x T texels, or with Storage::OneValue one.
  void add(const float* texture);

  /// The same for one of zeros: that of a particle that no light reaches.
  void addDark();

  /// Brings what was taken into the form that the settings ask for.
  /// @param noise see storeTextures
  /// @param rowOf set to the row of each particle
  /// Throws WorkStopped.
  [[nodiscard]] EncodedTable finish(
    double noise, const ProcessGroup& group, std::vector<std::int32_t>& rowOf);

private:
  void beginBytes();

  const BakeSettings& settings_;
  std::size_t particles_;
  double brightest_; ///< no value is above it
  TextureTable linear_;
  std::optional<ByteTable> bytes_; ///< in place of the linear ones
  std::vector<std::int32_t> rowOf_;
  std::optional<std::size_t> dark_; ///< place of a particle that no light reaches
};
}

#endif
