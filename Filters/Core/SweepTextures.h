// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SweepTextures_h
#define po_SweepTextures_h

#include "TextureFormula.h"
#include "VisibilityRecords.h"

#include <vector>

namespace po
{
/// Makes textures out of what a sweep has summed. Spheres are named by their index in the
/// SweepScene.
class SweepTextures
{
public:
  /// @param smoothing of what so many directions leave
  SweepTextures(
    const VisibilityRecords& records, const Background& background, TextureSmoothing smoothing);

  /// Fills the T * T values and outside shares of a sphere. Of one that was never seen the
  /// shares are not looked for: values 0, shares 1.
  void fill(unsigned sphere, float* values, float* shares) const;

  /// Squared standard errors of a watched sphere's texels.
  [[nodiscard]] SquaredError squaredError(unsigned sphere) const;

private:
  [[nodiscard]] std::vector<float> subsetWeights(const CutSphere& cut) const;

  const VisibilityRecords& records_;
  TextureFormula formula_;
  TextureSmoothing smoothing_;
  std::vector<float> dark_; ///< [ErrorSubsets][slots] zeros
};
}

#endif
