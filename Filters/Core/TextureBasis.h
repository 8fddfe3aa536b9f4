// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextureBasis_h
#define po_TextureBasis_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// A few textures of which all others are nearly sums: the mean and the principal components of a
/// sample, in the area-weighted inner product of the sphere.
///
/// (Gribble, Brownlee & Parker 2005 compressed such textures of particles so.)
struct TextureBasis
{
  int resolution = 0;
  double scale = 0; ///< of the stored numbers
  /// (1 + components) * T * T: the mean, then the components by falling variance, each times its
  /// standard deviation; values are these numbers times `scale`.
  std::vector<std::int16_t> numbers;

  [[nodiscard]] std::size_t texels() const
  {
    return static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution);
  }

  [[nodiscard]] std::size_t components() const
  {
    return numbers.empty() ? 0 : numbers.size() / texels() - 1;
  }

  /// One texel of the mean (row 0) or of a component (from row 1 on).
  [[nodiscard]] float value(std::size_t row, std::size_t texel) const
  {
    return static_cast<float>(scale * numbers[row * texels() + texel]);
  }
};

/// @param samples textures of T * T values one after the other, at least one
/// @param most the components that are wanted; those without variance are left out
[[nodiscard]] TextureBasis principalComponents(
  int resolution, const std::vector<float>& samples, std::size_t most);

/// Coefficients of textures in a basis, in standard deviations.
class TextureProjection
{
public:
  explicit TextureProjection(const TextureBasis& basis);

  /// Variance of each component: the mean square that it adds to a texture, over the sphere.
  [[nodiscard]] const std::vector<double>& variances() const { return variances_; }

  /// @param coefficients one of each component
  /// @return mean square difference of the texture from the mean
  double project(const float* texture, float* coefficients) const;

private:
  std::size_t components_;
  std::vector<float> mean_;
  std::vector<float> shares_;
  std::vector<float> weights_; ///< [texel][component]
  std::vector<double> variances_;
};

/// Quantizers for a normal variable of variance 1: 2^bits equal steps about 0 with the least mean
/// square error (Max, Quantizing for minimum distortion, 1960); 0 bits: the value 0.
struct Quantizer
{
  static constexpr int MaximumBits = 8;
  static constexpr std::array<double, MaximumBits + 1> Steps = { 0, 1.5958, 0.9957, 0.5860, 0.3352,
    0.1881, 0.1041, 0.0569, 0.0308 };
  static constexpr std::array<double, MaximumBits + 1> Errors = { 1, 0.3634, 0.1188, 0.03744,
    0.01154, 0.003490, 0.001040, 0.000304, 0.0000878 };

  [[nodiscard]] static std::uint32_t encode(float value, int bits);
  [[nodiscard]] static float decode(std::uint32_t code, int bits);
};

/// Shares bits out among components, each to the one that gains most by it. Trailing components
/// without bits are left out.
[[nodiscard]] std::vector<std::uint8_t> shareBits(const std::vector<double>& variances, int bits);
}

#endif
