// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextureSmoothing_h
#define po_TextureSmoothing_h

#include "SweepTexels.h"

#include <cstddef>
#include <vector>

namespace po
{
/// Takes noise out of a texture: each texel moves towards its neighbours on the sphere, the less
/// the more directions it was made of.
///
/// Texels a and b exchange K(a, b) w_a w_b min(1 / S_a, 1 / S_b) of their difference, where K is a
/// kernel, w the outside area of a texel and S_a the sum of K(a, b) w_b: the rule of Metropolis et
/// al. (1953) for a walk from texel to texel. What one gains the other loses, so that the mean over
/// the outside area stays; values stay between the least and the largest, so that what is open, or
/// dark, all over keeps its exact values.
///
/// K(a, b) = d_a d_b G(a, b), where G is a Gaussian of the angle between the centres, and d makes
/// the S nearly equal, by two steps of the symmetric scaling of Knight, Ruiz and Ucar (2014). With
/// d = 1 a texel of which little is outside would keep most of its noise: its neighbours have more
/// to exchange with, and the smaller of the two 1 / S counts. In molecules, where few points are
/// outside in many texels, that takes a tenth off the error.
///
/// The width of the Gaussian is where the error was least, over the families and files of the
/// benchmarks at T = 16 and 32: sqrt(0.1^2 + (pi / 2T)^2) (96 / D)^(1/4) radians for D directions,
/// 0.14 at the defaults. It narrows as the noise, about D^(-1/2), falls. There the error falls by a
/// tenth (gas) to three tenths (pack, overlap), as it would with 1.2 to 2 times the directions.
/// Textures of fewer than 12 rows are means over finer texels already and are left as they are.
class TextureSmoothing
{
public:
  /// Leaves textures as they are.
  TextureSmoothing() = default;

  /// @param directions over the whole sphere that the texture is made of
  TextureSmoothing(const SweepTexels& texels, int directions);

  /// @param values [T * T], linear
  /// @param shares [T * T] of the texels' area outside other spheres
  void apply(float* values, const float* shares) const;

  /// A neighbour: where its row begins in padded arrays, turned so that it is above the texel.
  struct Tap
  {
    std::size_t offset;
    float kernel;
  };

private:
  struct Weights
  {
    std::vector<float> areas;   ///< d w, padded
    std::vector<float> scales;  ///< 1 / S, padded; 0 where w is
    std::vector<float> factors; ///< [T * T], and some more: d; 0 where w is
  };

  void addTaps(double width);
  [[nodiscard]] std::size_t rowOffset(std::size_t row) const;
  /// Rows, continued at both ends as they go around.
  /// @param texels and GroupSize more
  void pad(const std::vector<float>& texels, std::vector<float>& padded) const;
  void weigh(const float* shares, Weights& weights) const;
  void sumOverKernel(
    const std::vector<float>& outside, Weights& weights, std::vector<float>& sums) const;

  std::size_t side_ = 0; ///< T; 0: nothing to do
  std::size_t margin_ = 0;
  std::size_t stride_ = 0;
  std::vector<Tap> taps_;
  std::vector<std::size_t> firstTap_; ///< [T + 1] by row
  std::vector<float> areas_;          ///< [T * T]
  Weights whole_;                     ///< of a sphere that nothing overlaps
};
}

#endif
