// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_DepthLaplacian_h
#define po_DepthLaplacian_h

#include <optional>
#include <string>

/// Silhouettes from a depth image.
///
/// A depth is the distance t in world units along the normalised eye ray (perspective) or along the
/// view direction (parallel). A value that is not finite is background and counts as one depth.
/// A pixel is an edge where 8 t(centre) - sum of t(8 neighbours) exceeds the threshold; beyond the
/// image the border is repeated.
///
/// Which side is drawn: only the positive side counts, as in the thesis that this follows, and with
/// this sign the centre is then farther away than its neighbours. So the line lies on the pixels
/// just behind a jump: it surrounds the object in front without covering any of it, and the front
/// pixels, where the same jump is negative, are never counted a second time. Along a jump of J that
/// runs straight through the grid the value is 3 J behind, -3 J in front and 0 beyond: one line,
/// one pixel wide. On a diagonal the line closes its corners (pixels that touch the front by a
/// corner only have 1 J). Planes in parallel projection give 0, and surfaces that bulge towards the
/// eye, such as spheres, give a negative value: neither has lines inside. In the outermost pixels
/// the repeated border counts a plane that recedes towards it with 3 times its slope per pixel.
namespace po
{
/// Automatic threshold, as a share of the farthest visible depth. It follows the scale of the data
/// and stays above the rounding of a 24-bit z-buffer (below 1/1000 of the farthest depth as long as
/// the near plane is nearer than that by no more than the factor of 1000 that VTK allows).
constexpr double AutomaticThresholdShare = 0.01;

/// Automatic background: this many thresholds behind the farthest geometry. A background pixel
/// beside any geometry then exceeds the threshold by a factor of two or more, whatever rounding.
constexpr double BackgroundMargin = 2.0;

struct SilhouetteParameters
{
  /// World units, >= 0; 0 = automatic.
  double threshold = 0.0;
  /// World units, >= 0; 0 = automatic, just behind the farthest geometry.
  double backgroundDepth = 0.0;
};

/// Says which parameter is out of its range; empty if none is.
[[nodiscard]] std::string faultOf(const SilhouetteParameters& parameters);

/// What SilhouetteParameters come to in one image, in world units.
struct EdgeRule
{
  double threshold;
  double background;
};

/// Row-major image, pixel (i, j) at depth[j * width + i].
template <typename T>
struct DepthImage
{
  const T* depth;
  int width;
  int height;
};

/// Half-open range of pixels.
struct PixelBlock
{
  int columnBegin;
  int columnEnd;
  int rowBegin;
  int rowEnd;
};

/// Largest finite depth; nothing where all is background.
template <typename T>
[[nodiscard]] std::optional<double> farthestDepth(const DepthImage<T>& image);

/// Resolves the automatic values; `farthest` is what farthestDepth returned for the same image.
[[nodiscard]] EdgeRule resolveEdgeRule(
  const SilhouetteParameters& parameters, std::optional<double> farthest);

/// 8 t(i, j) - sum of the eight neighbours, with `background` for every value that is not finite.
template <typename T>
[[nodiscard]] double depthLaplacian(const DepthImage<T>& image, int i, int j, double background);

/// Writes 1 (edge) or 0 to strength[j * Width + i] for the pixels of the block. Reads the whole
/// image, writes nothing outside of the block: blocks may run in parallel.
template <typename T>
void markSilhouettes(
  const DepthImage<T>& image, const EdgeRule& rule, const PixelBlock& block, float* strength);
}

#endif
