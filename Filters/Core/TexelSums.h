// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelSums_h
#define po_TexelSums_h

#include "BackgroundIrradiance.h"
#include "OverlapFinder.h"
#include "SharedDirections.h"
#include "SweepTexels.h"
#include "TexelExposure.h"

#include <array>
#include <cstddef>
#include <vector>

namespace po
{
/// Interleaved subsets of directions whose spread is the error bar.
inline constexpr std::size_t DirectionSubsets = 4;

/// The subset of a direction: runs of 16 take turns, as each of them is spread evenly.
[[nodiscard]] inline std::size_t subsetOf(const SharedDirection& direction)
{
  return direction.index / 16 % DirectionSubsets;
}

/// What a particle of which all is open sums to: the weights of the directions that texels face.
struct OpenSums
{
  explicit OpenSums(std::size_t slots)
    : total(slots, 0.0f)
    , subsets(DirectionSubsets * slots, 0.0f)
  {
  }

  void add(const SharedDirections& set);

  std::vector<float> total;   ///< [slots], summed in the order of the directions
  std::vector<float> subsets; ///< [DirectionSubsets][slots]
};

/// What is summed over the directions for one particle; arrays have an entry for each slot.
struct TexelSums
{
  /// @param spread whether the subsets are kept, for an error bar
  TexelSums(std::size_t slotCount, bool spread);

  [[nodiscard]] bool hasSubsets() const { return !subsets.empty(); }
  [[nodiscard]] bool isCut() const { return !weights.empty(); }

  /// Makes room for what a particle needs that others overlap.
  void makeCut();

  /// Adds the weights of a direction.
  /// @param exposed the texels that face it outside other spheres
  /// @param seen those of them that see the background
  void add(const SharedDirection& direction, const GroupMask* exposed, const GroupMask* seen);

  std::size_t slots;
  bool buried = false;        ///< the whole surface lies inside one other sphere
  std::vector<float> sums;    ///< of texels that see the background
  std::vector<float> subsets; ///< [DirectionSubsets][slots] of the same; may be empty
  std::vector<float> weights; ///< of exposed texels; empty where the particle is not cut
  std::vector<float>
    subsetWeights;               ///< [DirectionSubsets][slots] of the same; empty without subsets
  std::vector<float> shares;     ///< outside share; empty where the particle is not cut
  std::vector<float> irradiance; ///< of the open outside part; empty where it is not cut
};

/// Makes textures out of sums.
///
/// A texel of the fine grid is sum(w V) / sum(w), the share of the open sky's light that arrives,
/// times the irradiance of an open surface; both sums run over the points outside other spheres. An
/// open texel is thus exactly 1 under the uniform background, a dark one exactly 0. Texels of the
/// texture are means over the outside area of theirs.
class SumTextures
{
public:
  /// @param patterns the points over which a texel's irradiance and outside share are means
  SumTextures(
    const SweepTexels& texels, const TexelPatterns& patterns, const Background& background);

  /// Finds the outside shares of a cut particle and the irradiance there.
  void measureCut(const TexelExposure& exposure, TexelSums& sums) const;

  /// Fills the T * T values and outside shares of a particle.
  void fill(const TexelSums& sums, const OpenSums& open, float* values, float* shares) const;

  /// Squared standard errors of a particle's texels, from the spread of its subsets as if these
  /// were independent.
  struct SquaredError
  {
    double sum = 0;  ///< weighted by outside area
    double area = 0; ///< the sum of the weights

    /// Root of the mean.
    [[nodiscard]] double rms() const;
  };
  [[nodiscard]] SquaredError squaredError(const TexelSums& sums, const OpenSums& open) const;

private:
  void coarsen(const TexelSums& cut, const float* sums, const float* weights, float* values,
    float* shares) const;
  [[nodiscard]] std::size_t texelCount() const;

  const SweepTexels& texels_;
  bool uniform_;                      ///< an open surface receives 1 everywhere
  std::vector<float> ones_;           ///< for all points of a group
  std::vector<float> irradiance_;     ///< of all points, in the order of TexelPatterns
  std::vector<float> openIrradiance_; ///< [slots], mean over the patterns
  std::vector<double> areas_;         ///< of a fine texel, by row
};
}

#endif
