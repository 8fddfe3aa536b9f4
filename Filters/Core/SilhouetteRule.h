// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouetteRule_h
#define po_SilhouetteRule_h

#include <limits>
#include <string>

/// What counts as a silhouette, and how it looks: parameters as users set them, and the rule that
/// they come to in one picture.
namespace po
{
/// What lengths along the line of sight are given in.
enum class SilhouetteUnit
{
  World = 0, ///< units of the data
  Radii = 1  ///< mean particle radii
};

/// The only numbers of samples along each side of a pixel.
[[nodiscard]] constexpr bool isSampleCount(int samples)
{
  return samples == 1 || samples == 2 || samples == 4 || samples == 8;
}

/// The widest line, in pixels.
constexpr double WidestLine = 8;

struct SilhouetteParameters
{
  /// Laplacian above which a sample is an edge, in `unit`, >= 0: three times the jump along a
  /// straight edge. 0: automatic.
  double threshold = 0;
  SilhouetteUnit unit = SilhouetteUnit::World;
  /// More or fewer lines: 0 none, 0.5 those of the threshold, 1 all. The threshold is multiplied by
  /// ((1 - density) / density)^2.
  double density = 0.5;
  /// Depth of the background in world units, >= 0. 0: automatic, behind whatever it borders on.
  double backgroundDepth = 0;
  /// Draw lines against the background.
  bool backgroundLines = true;
  /// Take the slopes on both sides off a jump, so that planes seen at a grazing angle, creases and
  /// the bulge of a sphere have no lines.
  bool slopeTest = true;
  /// Samples along each side of a pixel: 1 (off), 2, 4 or 8.
  int samples = 4;
  /// Pixels, 1 to WidestLine.
  double width = 1;
  /// Let lines grow from `width` to `maximumWidth` with the jump.
  bool widthByJump = false;
  double maximumWidth = 3;
  /// Let lines darken from 0 to 1 with the jump.
  bool greyByJump = false;
  /// The jumps at which grey and width begin and end to grow, in `unit`, >= 0. 0: automatic, half
  /// of and four times the smallest jump that gets a line.
  double jumpFrom = 0;
  double jumpTo = 0;
};

/// Says which parameter is out of its range; empty if none is.
[[nodiscard]] std::string faultOf(const SilhouetteParameters& parameters);

/// Grows from 0 at `from` to 1 at `to`.
struct JumpRamp
{
  float from = 0;
  float to = 1;

  [[nodiscard]] float at(float jump) const
  {
    if (jump >= to)
    {
      return 1;
    }
    return jump > from ? (jump - from) / (to - from) : 0;
  }
};

/// SilhouetteParameters with all lengths in world units and nothing automatic left.
struct SilhouetteRule
{
  double threshold = 0; ///< Laplacian; infinite: no line at all
  double jump = 0;      ///< smallest jump that gets a line along a straight edge
  double background = std::numeric_limits<double>::infinity(); ///< infinite: automatic
  bool backgroundLines = true;
  bool slopeTest = true;
  int samples = 1;
  double width = 1;
  double maximumWidth = 1; ///< equal to `width` where width does not follow the jump
  bool greyByJump = false;
  JumpRamp ramp;

  [[nodiscard]] bool drawsNothing() const
  {
    return threshold == std::numeric_limits<double>::infinity();
  }
};

/// What the automatic threshold is derived from, in world units; 0: not known.
struct SilhouetteScale
{
  double meanRadius = 0; ///< of the particles
  double depthRange = 0; ///< extent of the data, or the spread of the visible depths
  double freeLength = 0; ///< see meanFreeLength()
};

/// The automatic Laplacian threshold, from what is known of the data: three times the largest of
/// these jumps.
/// - Two mean radii: they separate a particle from one that lies behind it and does not touch it.
/// - A fiftieth of the depths, so that large data sets of small particles show their large steps.
/// - The jump that one line of sight in six exceeds if particles lie scattered, so that gases do
/// not
///   turn black. Such a line, s long, meets its first particle at x and the next one J behind it,
///   with the densities exp(-x / L) / L and exp(-J / L) / L. So its jump is between J and the
///   longest there can be, s - x, with the probability
///   exp(-J / L) - (1 + (s - J) / L) exp(-s / L).
///   L is what the free length exceeds two mean radii by: what is closer is as good as touching. s
///   is the edge of a cube whose diagonal are the depths.
[[nodiscard]] double automaticThreshold(const SilhouetteScale& scale);

[[nodiscard]] SilhouetteRule resolve(
  const SilhouetteParameters& parameters, const SilhouetteScale& scale);
}

#endif
