// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexturePacker_h
#define po_TexturePacker_h

#include "PackedFormat.h"
#include "ProcessGroup.h"
#include "TextureSizes.h"
#include "TextureTable.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// What storing a texture may change: the RMS, over the area outside other particles, of the
/// difference from what was baked.
///
/// A bake errs by `noise` anyway. What is left out of a texture is at worst not noise at all; then
/// the error grows from noise to sqrt(noise^2 + difference^2), so that the difference that adds
/// `error` to it is sqrt(error^2 + 2 error noise). Both are RMS errors of linear visibility, which
/// is the displayed value.
[[nodiscard]] double allowedDifference(double error, double noise);

/// Chooses how a texture is packed.
class TexturePacker
{
public:
  /// A texture in its packed form.
  struct Code
  {
    std::vector<std::uint8_t> bytes; ///< whole words
    double squareError = 0;          ///< square difference, integrated over what is visible
    double area = 1;                 ///< that is visible, as a share of the sphere
  };

  virtual ~TexturePacker() = default;

  [[nodiscard]] virtual Code pack(const WeighedTexture& texture) const = 0;

  /// What integrals over a texture's visible area are taken with.
  struct Area
  {
    const float* weights; ///< [T * T]: shares of the sphere
    double sum;           ///< of them; 1 of a whole particle
  };

  /// @param memory for the weights, where they are not those of a whole particle
  [[nodiscard]] Area areaOf(const WeighedTexture& texture, std::vector<float>& memory) const;

  [[nodiscard]] const PackedFormat& format() const { return format_; }

protected:
  TexturePacker(int resolution, double maximum);

  /// n x n texels, n = textureSizes(resolution)[kind].
  [[nodiscard]] Code packSize(const float* texture, const Area& area, std::size_t kind) const;

  /// Coefficients, in standard deviations, as class c of the format.
  [[nodiscard]] Code packClass(std::size_t c, const std::vector<float>& coefficients) const;

  [[nodiscard]] std::size_t sizes() const { return resamplers_.size(); }
  [[nodiscard]] std::size_t texelsPerTexture() const { return shares_.size(); }

  PackedFormat format_;

private:
  std::vector<TextureResampler> resamplers_;
  std::vector<float> shares_;
};

/// Each texture at the smallest size that does not change what is visible of it by more than is
/// allowed.
class SizePacker : public TexturePacker
{
public:
  SizePacker(int resolution, double maximum, double allowed);

  [[nodiscard]] Code pack(const WeighedTexture& texture) const override;

private:
  double allowed_;
};

/// Packs a table and gives up its values; equal codes are stored once.
/// @param rowOf the row of each particle, changed to the first word of its texture; negative
/// entries (no texture) stay
[[nodiscard]] EncodedTable packTable(
  TextureTable&& table, const TexturePacker& packer, std::vector<std::int32_t>& rowOf);
}

#endif
