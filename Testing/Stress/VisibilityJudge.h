// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_VisibilityJudge_h
#define po_VisibilityJudge_h

#include "Vec3.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

/// An independent judge of baked values. It shares no code of sampling, texels, intersection or
/// overlap with the product, only the vector type.
namespace judge
{
using po::Vec3d;

/// A sphere as the input has it: in double precision, of any unit, anywhere.
struct Ball
{
  Vec3d center;
  double radius = 0;
};

/// What was found of one texel.
struct Texel
{
  int points = 0;  ///< drawn on the texel's area
  int outside = 0; ///< of these outside all other balls, a ray from each
  int open = 0;    ///< rays that met nothing

  [[nodiscard]] double value() const { return outside > 0 ? double(open) / outside : 0; }
  [[nodiscard]] double outsideShare() const { return points > 0 ? double(outside) / points : 0; }
};

/// Visibility in double precision, by rays through a tree of boxes.
///
/// Every ray has a point of its own, uniform on the texel, and a direction of its own, with the
/// density cos / pi: the number of open rays of a texel is binomial, so that its standard error is
/// known. All is computed relative to the centre of the ball that is looked at; a difference of two
/// centres is the only thing that rounding touches, and it is exact for neighbours.
class Judge
{
public:
  explicit Judge(std::vector<Ball> balls);

  [[nodiscard]] const std::vector<Ball>& balls() const { return balls_; }

  /// Texel (row, column) of resolution^2, of the ball `id`. Two equal balls at one place do not
  /// bury each other.
  /// @param distance rays end there, in the unit of the input
  [[nodiscard]] Texel look(std::size_t id, int resolution, int row, int column, int points,
    double distance = std::numeric_limits<double>::infinity()) const;

  /// Is every other ball below the horizon of every point of the texel, by `margin` radii? Its
  /// value is then 1, and whatever darkens it is a false hit.
  [[nodiscard]] bool isOpen(
    std::size_t id, int resolution, int row, int column, double margin = 1e-4) const;

private:
  struct Node
  {
    Vec3d low, high;
    std::size_t first, last; ///< in order_
    std::size_t right;       ///< the other child; the left one comes next. 0 in a leaf
  };

  std::size_t build(std::size_t first, std::size_t last);
  template <typename Meets, typename Visit>
  bool any(Vec3d from, Meets meets, Visit visit) const;
  [[nodiscard]] bool isInside(std::size_t id, Vec3d offset) const;
  [[nodiscard]] bool isBlocked(std::size_t id, Vec3d offset, Vec3d way, double distance) const;

  std::vector<Ball> balls_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};
}

#endif
