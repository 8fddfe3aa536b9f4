// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextureIntake_h
#define po_TextureIntake_h

#include "BakeSettings.h"
#include "ProcessGroup.h"
#include "SpilledTextures.h"
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
/// textures are stored in another form, linear values are kept, 4 bytes a texel: those that become
/// bytes in a temporary file, if that is wanted.
class TextureIntake
{
public:
  /// @param particles how many textures to expect
  /// @param outOfCore linear values that become bytes wait in a temporary file
  TextureIntake(const BakeSettings& settings, std::size_t particles, bool outOfCore = false);

  /// Does the storage leave out less where more is visible? What is visible then takes a byte a
  /// texel of particles that are overlapped.
  [[nodiscard]] static bool weighsTexels(const BakeSettings& settings);

  /// Do linear values wait in a file out of core? Else they are in memory all the same.
  [[nodiscard]] static bool spills(const BakeSettings& settings);

  /// The texture of the next particle: T x T texels, or with Storage::OneValue one.
  /// @param shares [T * T] of the texels' area outside other particles; not read of one value
  void add(const float* texture, const float* shares);

  /// The same for one of zeros: that of a particle that no light reaches.
  void addDark();

  /// Brings what was taken into the form that the settings ask for.
  /// @param noise see storeTextures
  /// @param rowOf set to the row of each particle
  /// Throws WorkStopped, and what ScratchFile throws.
  [[nodiscard]] EncodedTable finish(
    double noise, const ProcessGroup& group, std::vector<std::int32_t>& rowOf);

private:
  std::int32_t insert(const float* texture, const float* shares);
  void toBytes(double maximum, std::size_t expected);

  const BakeSettings& settings_;
  std::size_t particles_;
  double brightest_; ///< no value is above it
  TextureTable linear_;
  std::optional<SpilledTextures> spilled_; ///< in place of these
  std::optional<ByteTable> bytes_;         ///< in place of the linear ones
  std::optional<TexelWeights> weights_;    ///< of storages that weigh texels
  std::vector<std::int32_t> rowOf_;
  std::optional<std::size_t> dark_; ///< place of a particle that no light reaches
};
}

#endif
