// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextureSizes_h
#define po_TextureSizes_h

#include <cstddef>
#include <vector>

namespace po
{
/// The sizes n of n x n texels that a texture of T x T may be stored at, ascending: the powers of 2
/// below T, and T.
[[nodiscard]] std::vector<int> textureSizes(int resolution);

/// Share of the sphere that each texel of T x T covers; they add up to 1.
[[nodiscard]] std::vector<float> texelShares(int resolution);

/// Stands n x n texels in for T x T: a value is looked up between them by the same bilinear rule,
/// wrapped in azimuth and clamped at the poles.
class TextureResampler
{
public:
  TextureResampler(int resolution, int size);

  [[nodiscard]] int size() const { return size_; }

  /// The n x n values whose lookups come near the texture, in area-weighted least squares: the mean
  /// under each texel's weights, then corrected by what is left (Landweber's iteration).
  /// @param texture T * T values
  void reduce(const float* texture, float* reduced) const;

  /// The same in least squares of other weights.
  /// @param weights T * T, positive
  void reduce(const float* texture, const float* weights, float* reduced) const;

  /// What is looked up at the centres of the T x T texels.
  void enlarge(const float* reduced, float* texture) const;

private:
  /// The two of n texels that a centre of one of T lies between, along one axis.
  struct Pair
  {
    int first, second;
    float weight; ///< of the second
  };

  using Weights = std::vector<float>;

  void sum(const float* texture, const float* weights, float* sums) const;
  [[nodiscard]] Weights gathered(const float* weights) const;
  void reduce(const float* texture, const float* weights, const Weights& gathered, int corrections,
    float* reduced) const;

  int resolution_;
  int size_;
  std::vector<Pair> columns_, rows_;
  std::vector<float> shares_; ///< of the sphere, by texel of T x T
  Weights gathered_;          ///< that lookups give each of n x n texels in all, area-weighted
};
}

#endif
