// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_VisibleFit_h
#define po_VisibleFit_h

#include "TextureBasis.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// Coefficients in a basis for textures of which not all is visible: such that what is visible
/// differs as little as can be, whatever becomes of the rest.
///
/// Under such weights components are not orthogonal. So coefficients are those of least squares,
/// quantized, and then changed one after the other to the step that suits the others best.
class VisibleFit
{
public:
  explicit VisibleFit(const TextureBasis& basis);

  /// What is the same for all numbers of bits; [K] and [K][K] for K components.
  struct Texture
  {
    std::vector<float> products;     ///< weighted, of the components among each other
    std::vector<float> root;         ///< Cholesky's, of the products
    std::vector<float> meanProducts; ///< of the components and the difference from the mean
    double square = 0;               ///< weighted square of that difference
  };

  /// @param values [T * T]
  /// @param weights [T * T] shares of the sphere that count, at least those of weight 1 (see
  /// TexelWeights)
  [[nodiscard]] Texture prepare(const float* values, const float* weights) const;

  /// Coefficients as they are decoded, one for each of the bits.
  [[nodiscard]] static std::vector<float> fit(
    const Texture& texture, const std::vector<std::uint8_t>& bits);

  /// Weighted square of the difference that coefficients leave.
  [[nodiscard]] static double squareLeft(
    const Texture& texture, const std::vector<float>& coefficients);

private:
  std::size_t texels_;
  std::vector<float> mean_;       ///< [texels]
  std::vector<float> components_; ///< [texels][K]
  std::vector<float> floor_;      ///< [texels] the least weights
  std::vector<float> ofFloor_;    ///< [K][K] products under these
};
}

#endif
