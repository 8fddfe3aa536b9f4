// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SweepTextures_h
#define po_SweepTextures_h

#include "BackgroundIrradiance.h"
#include "VisibilityRecords.h"

#include <vector>

namespace po
{
/// Makes textures out of what a sweep has summed.
///
/// A texel of the fine grid is sum(w V) / sum(w), the share of the open sky's light that arrives,
/// times the irradiance of an open surface; both sums run over the points outside other spheres. An
/// open texel is thus exactly 1 under the uniform background, a dark one exactly 0. Texels of the
/// texture are means over the outside area of theirs. Spheres are named by their index in the
/// SweepScene.
class SweepTextures
{
public:
  SweepTextures(const VisibilityRecords& records, const Background& background);

  /// Fills the T * T values and outside shares of a sphere. Of one that was never seen the
  /// shares are not looked for: values 0, shares 1.
  void fill(unsigned sphere, float* values, float* shares) const;

  /// Squared standard errors of a watched sphere's texels, from the spread of the subsets of
  /// directions as if these were independent.
  struct SquaredError
  {
    double sum = 0;  ///< weighted by outside area
    double area = 0; ///< the sum of the weights

    void add(const SquaredError& other);

    /// Root of the mean.
    [[nodiscard]] double rms() const;
  };
  [[nodiscard]] SquaredError squaredError(unsigned sphere) const;

private:
  /// What is common to all fine texels of one sphere, [slots] each.
  struct FineTexels
  {
    std::vector<float> irradiance; ///< of the open outside part
    std::vector<float> share;      ///< outside share
    std::vector<float> weight;     ///< sum(w)
  };
  [[nodiscard]] FineTexels openTexels() const;
  [[nodiscard]] FineTexels cutTexels(const CutSphere& cut) const;

  /// @param weight [slots], in place of that of the fine texels
  void coarsen(const FineTexels& fine, const float* sums, const float* weight, float* values,
    float* shares) const;

  const VisibilityRecords& records_;
  bool uniform_;                  ///< the irradiance of an open surface is 1 everywhere
  std::vector<float> irradiance_; ///< in the order of TexelPatterns
  std::vector<float> ones_;       ///< as many
  FineTexels open_;               ///< of a sphere that nothing overlaps

  /// A fine texel of the sweep and the texel of the texture that it is a part of.
  struct Part
  {
    std::size_t slot;
    std::size_t texel;
    float area; ///< its share of the texel's area
  };
  std::vector<Part> parts_;
  std::vector<float> areas_; ///< of the texels: the sums of their parts, 1 up to rounding
};
}

#endif
