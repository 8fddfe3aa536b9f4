// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Sampling_h
#define po_Sampling_h

#include "Constants.h"
#include "Random.h"
#include "Vec3.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace po
{
struct Point2
{
  double x, y;
};

/// The unit square cut into `count` strata of equal area, for any count.
///
/// round(sqrt(count)) rows share the strata as evenly as whole numbers allow; the height of a row
/// is its share, so all areas are 1 / count. 49 strata are the usual 7 x 7.
class StratifiedSquare
{
public:
  explicit StratifiedSquare(int count);

  [[nodiscard]] int size() const { return static_cast<int>(strata_.size()); }

  /// Point of stratum k: (jx, jy) in [0, 1)^2 placed uniformly inside it.
  [[nodiscard]] Point2 point(int k, double jx, double jy) const
  {
    const Stratum& s = strata_[static_cast<std::size_t>(k)];
    return { s.x + jx * s.width, s.y + jy * s.height };
  }

private:
  struct Stratum
  {
    double x, y, width, height;
  };
  std::vector<Stratum> strata_;
};

/// Fills `order` with a uniformly random permutation of 0 ... size - 1 (Fisher and Yates).
void randomPermutation(Random& random, std::vector<std::uint32_t>& order);

/// Unit square to unit disk, area-preserving and with little distortion (Shirley and Chiu 1997).
[[nodiscard]] inline Point2 diskFromSquare(Point2 square)
{
  const double a = 2 * square.x - 1;
  const double b = 2 * square.y - 1;
  // Which is the larger cannot be foreseen: the rest is the same for both, without a branch.
  const bool wide = std::abs(a) > std::abs(b);
  const double radius = wide ? a : b;
  const double angle = radius == 0 ? 0 : Pi / 4 * ((wide ? b : a) / radius);
  const double along = radius * std::cos(angle);
  const double across = radius * std::sin(angle);
  return wide ? Point2{ along, across } : Point2{ across, along };
}

/// The inverse of diskFromSquare.
[[nodiscard]] Point2 squareFromDisk(Point2 disk);

/// Unit square to the hemisphere about +z with density cos(theta) / pi per steradian: a uniform
/// point of the disk is lifted onto the hemisphere (Malley's method).
[[nodiscard]] inline Vec3d cosineHemisphereFromSquare(Point2 square)
{
  const Point2 d = diskFromSquare(square);
  return { d.x, d.y, std::sqrt(std::max(0.0, 1 - d.x * d.x - d.y * d.y)) };
}

/// Density of cosineHemisphereFromSquare per steradian.
[[nodiscard]] double cosineHemispherePdf(Vec3d direction);

/// The inverse of cosineHemisphereFromSquare.
[[nodiscard]] Point2 squareFromCosineHemisphere(Vec3d direction);

/// Turns a direction given about +z into one about the unit vector n, with a branchless basis
/// (Duff et al. 2017).
[[nodiscard]] inline Vec3d aboutNormal(Vec3d n, Vec3d direction)
{
  const double sign = std::copysign(1.0, n.z);
  const double a = -1 / (sign + n.z);
  const double b = n.x * n.y * a;
  const Vec3d tangent{ 1 + sign * n.x * n.x * a, sign * b, -sign * n.x };
  const Vec3d bitangent{ b, sign + n.y * n.y * a, -n.y };
  return direction.x * tangent + direction.y * bitangent + direction.z * n;
}
}

#endif
