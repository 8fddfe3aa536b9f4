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
  /// directions as if these were independent. Subsets of a lattice complement each other: measured,
  /// the true error was mostly below the estimate, down to half of it where much is hidden.
  struct SquaredError
  {
    double sum = 0;  ///< weighted by outside area
    double area = 0; ///< the sum of the weights
  };
  [[nodiscard]] SquaredError squaredError(unsigned sphere) const;

private:
  /// What is common to all fine texels of one sphere.
  struct FineTexels
  {
    std::vector<float> irradiance; ///< [slots] of the open outside part
    std::vector<float> share;      ///< [slots] outside share
    std::vector<float> weight;     ///< [slots] sum(w)
  };
  [[nodiscard]] FineTexels fineTexels(unsigned sphere) const;

  /// @param weight [slots], in place of that of the fine texels
  void coarsen(const FineTexels& fine, const float* sums, const float* weight, float* values,
    float* shares) const;

  const VisibilityRecords& records_;
  std::vector<float> irradiance_;     ///< [patterns][slots]
  std::vector<float> openIrradiance_; ///< [slots], mean over the patterns
  std::vector<double> areas_;         ///< of a fine texel, by row
};
}

#endif
