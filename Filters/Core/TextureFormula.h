// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextureFormula_h
#define po_TextureFormula_h

#include "BackgroundIrradiance.h"
#include "FineTextures.h"
#include "SweepTexels.h"
#include "TexelExposure.h"
#include "TextureSmoothing.h"

#include <cstddef>
#include <vector>

namespace po
{
/// Subsets of directions whose spread is the error bar.
inline constexpr std::size_t ErrorSubsets = 4;

/// Squared standard errors of texels, summed over their area.
struct SquaredError
{
  double sum = 0;  ///< weighted by outside area
  double area = 0; ///< the sum of the weights

  void add(const SquaredError& other);

  /// Root of the mean.
  [[nodiscard]] double rms() const;
};

/// What of a particle's fine texels is outside all others, [slots] each.
struct OutsideSurface
{
  std::vector<float> shares;     ///< of the texel's area
  std::vector<float> irradiance; ///< of the outside part, were it open
};

/// Makes textures out of sums over directions.
///
/// A texel of the fine grid is sum(w V) / sum(w), the share of the open sky's light that arrives,
/// times the irradiance of an open surface; both sums run over the points outside other spheres. An
/// open texel is thus exactly 1 under the uniform background, a dark one exactly 0. Texels of the
/// texture are means over the outside area of theirs.
class TextureFormula
{
public:
  /// @param patterns the points over which a texel's irradiance and outside share are means
  TextureFormula(
    const SweepTexels& texels, const TexelPatterns& patterns, const Background& background);

  /// Of a particle that nothing overlaps.
  [[nodiscard]] const OutsideSurface& whole() const { return whole_; }
  /// Of one whose points are exposed like this.
  /// @param surface is overwritten, and keeps its memory
  void cut(const TexelExposure& exposure, OutsideSurface& surface) const;

  /// The same in two steps: texels that are outside as a whole, and then group by group what rims
  /// cross.
  void cutWhole(const GroupMask* outside, OutsideSurface& surface) const;
  /// @param points [GroupSize] how many of a texel's points are outside
  /// @param irradiance [GroupSize] their sum
  void cutGroup(
    std::size_t group, const float* points, const float* irradiance, OutsideSurface& surface) const;

  /// [TexelPatterns::Count][GroupSize] of the points of a group; null where it is 1 everywhere.
  [[nodiscard]] const float* irradianceOf(std::size_t group) const
  {
    return uniform_ ? nullptr : irradiance_.data() + TexelPatterns::index(0, group * GroupSize);
  }

  /// Number of texels of a texture.
  [[nodiscard]] std::size_t texels() const { return areas_.size(); }

  /// Fills the values and outside shares of a texture.
  /// @param sums [slots] weights of the directions that are seen
  /// @param weights [slots] of all directions
  void fill(const OutsideSurface& surface, const float* sums, const float* weights, float* values,
    float* shares) const;

  /// Fills a texture all alike.
  void fill(float value, float share, float* values, float* shares) const;

  /// The errors of a smoothed texture: from the spread of the subsets, as if these were
  /// independent, and from what smoothing changes beyond the noise that it takes out.
  /// @param sums, weights [ErrorSubsets][slots]
  [[nodiscard]] SquaredError squaredError(const OutsideSurface& surface, const float* sums,
    const float* weights, const TextureSmoothing& smoothing) const;

private:
  void addParts(const SweepTexels& texels);
  void addIrradiance(
    const SweepTexels& texels, const TexelPatterns& patterns, const Background& background);

  /// A fine texel and the texel of the texture that it is a part of.
  struct Part
  {
    std::size_t slot;
    std::size_t texel;
    float area; ///< its share of the texel's area
  };

  std::size_t groups_;
  bool isWhole_;                  ///< each texel is one fine texel
  bool uniform_;                  ///< an open surface receives 1 everywhere
  std::vector<float> ones_;       ///< for all points of a group
  std::vector<float> irradiance_; ///< of all points, in the order of TexelPatterns, if not uniform
  OutsideSurface whole_;
  FineTextures fine_; ///< used if isWhole_
  std::vector<Part> parts_;
  std::vector<float> areas_;       ///< of the texels: the sums of their parts, 1 up to rounding
  std::vector<double> steradians_; ///< of the texels
};
}

#endif
