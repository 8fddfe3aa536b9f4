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

  /// Was a sphere never seen, and is not known to be buried? The textures of all these are the
  /// same: values 0, and shares 1, since they are not looked for.
  [[nodiscard]] bool isDark(unsigned sphere) const
  {
    return records_.sums(sphere) == nullptr && !records_.isBuried(sphere);
  }

  /// Fills the T * T values and outside shares of a sphere.
  void fill(unsigned sphere, float* values, float* shares) const;

  /// Squared standard errors of a watched sphere's texels.
  [[nodiscard]] SquaredError squaredError(unsigned sphere) const;

private:
  /// What of a sphere that others overlap is outside.
  struct CutSurface
  {
    OutsideSurface surface;
    std::vector<float> weights; ///< [slots] of its points that are outside: what open texels sum to
    std::vector<float> rims;    ///< [rimGroups][GroupSize] of weights
  };

  void lookAt(const TexelRims& rims, CutSurface& cut) const;
  void lookAtRim(const TexelRims& rims, std::size_t rim, CutSurface& cut) const;
  void weigh(const TexelRims& rims, CutSurface& cut) const;
  [[nodiscard]] std::vector<float> subsetWeights(const CutSurface& cut) const;

  const VisibilityRecords& records_;
  std::vector<TexelPoints> points_; ///< of each epoch
  TextureFormula formula_;
  TextureSmoothing smoothing_;
};
}

#endif
