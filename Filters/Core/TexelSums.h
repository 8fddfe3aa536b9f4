// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelSums_h
#define po_TexelSums_h

#include "SharedDirections.h"
#include "SweepTexels.h"
#include "TextureFormula.h"

#include <cstddef>
#include <vector>

namespace po
{
/// The subset of a direction: runs of 16 take turns, as each of them is spread evenly.
[[nodiscard]] inline std::size_t subsetOf(const SharedDirection& direction)
{
  return direction.index / 16 % ErrorSubsets;
}

/// What a particle of which all is open sums to: the weights of the directions that texels face.
struct OpenSums
{
  explicit OpenSums(std::size_t slots)
    : total(slots, 0.0f)
    , subsets(ErrorSubsets * slots, 0.0f)
  {
  }

  void add(const SharedDirections& set);

  std::vector<float> total;   ///< [slots], summed in the order of the directions
  std::vector<float> subsets; ///< [ErrorSubsets][slots]
};

/// What is summed over the directions for one particle; arrays have an entry for each slot.
struct TexelSums
{
  /// @param spread whether the subsets are kept, for an error bar
  TexelSums(std::size_t slotCount, bool spread);

  [[nodiscard]] bool hasSubsets() const { return !subsets.empty(); }
  [[nodiscard]] bool isCut() const { return !weights.empty(); }

  /// Makes room for what a particle needs that others overlap.
  void makeCut(OutsideSurface surface);

  /// Adds the weights of a direction.
  /// @param exposed the texels that face it outside other spheres
  /// @param seen those of them that see the background
  void add(const SharedDirection& direction, const GroupMask* exposed, const GroupMask* seen);

  std::size_t slots;
  bool buried = false;              ///< the whole surface lies inside one other sphere
  std::vector<float> sums;          ///< of texels that see the background
  std::vector<float> subsets;       ///< [ErrorSubsets][slots] of the same; may be empty
  std::vector<float> weights;       ///< of exposed texels; empty where the particle is not cut
  std::vector<float> subsetWeights; ///< [ErrorSubsets][slots] of the same; empty without subsets
  OutsideSurface outside;           ///< empty where the particle is not cut
};

/// Fills the T * T values and outside shares of a particle.
void fillTexture(const TextureFormula& formula, const TexelSums& sums, const OpenSums& open,
  float* values, float* shares);

/// Of one that has subsets.
[[nodiscard]] SquaredError squaredError(const TextureFormula& formula, const TexelSums& sums,
  const OpenSums& open, const TextureSmoothing& smoothing);
}

#endif
