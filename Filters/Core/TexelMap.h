// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TexelMap_h
#define po_TexelMap_h

#include "Vec3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace po
{
// The texture of a sphere: T x T texels in latitude and longitude, row-major. Row j covers polar
// angles [j pi/T, (j+1) pi/T] from +z, column i azimuths [2 pi i/T, 2 pi (i+1)/T] from +x towards
// +y. In (u, v) both ranges are [0, 1]; texel centres lie at half-integers of u T and v T.

/// Position on the texture: u = azimuth / 2 pi in [0, 1), v = polar angle / pi in [0, 1].
struct TextureCoordinate
{
  double u, v;
};

/// Index of texel (row j, column i).
[[nodiscard]] constexpr std::size_t texelIndex(int resolution, int row, int column)
{
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(resolution) +
    static_cast<std::size_t>(column);
}

/// Texture coordinate of a direction of any length but zero; accurate at the poles too.
[[nodiscard]] TextureCoordinate textureCoordinate(Vec3d direction);

/// Unit vector of a texture coordinate: the inverse of textureCoordinate.
[[nodiscard]] Vec3d textureDirection(TextureCoordinate coordinate);

/// One texel's piece of the unit sphere.
class TexelPatch
{
public:
  TexelPatch(int resolution, int row, int column);

  /// Maps the unit square to the texel with uniform area: cos(theta) is linear in the area
  /// (Archimedes), so z is interpolated, not theta.
  /// @param s, t in [0, 1]: along the azimuth, along the polar angle
  [[nodiscard]] Vec3d point(double s, double t) const
  {
    const double z = top_ + t * height_;
    const double azimuth = azimuth_ + s * azimuthWidth_;
    const double radius = std::sqrt(std::max(0.0, (1 - z) * (1 + z)));
    return { radius * std::cos(azimuth), radius * std::sin(azimuth), z };
  }

private:
  double top_;          ///< z of the upper edge
  double height_;       ///< z of the lower edge minus that of the upper: negative
  double azimuth_;      ///< of the left edge, radians
  double azimuthWidth_; ///< radians
};

/// A single point of texel (row, column): see TexelPatch::point.
[[nodiscard]] inline Vec3d texelPoint(int resolution, int row, int column, double s, double t)
{
  return TexelPatch(resolution, row, column).point(s, t);
}

/// Area of a texel of row j on the unit sphere, in steradians; the T x T areas add up to 4 pi.
[[nodiscard]] double texelArea(int resolution, int row);

/// The largest angle between a texel's centre, textureDirection((i + 1/2)/T, (j + 1/2)/T), and any
/// point of the texel, in radians.
[[nodiscard]] double texelAngularRadius(int resolution, int row);

/// The four texels and weights of a bilinear lookup: wrapped in azimuth, clamped at the poles.
/// Indices are row-major: row * columns + column.
struct BilinearTexels
{
  std::array<std::size_t, 4> index;
  std::array<float, 4> weight; ///< adds up to 1
};

[[nodiscard]] BilinearTexels bilinearTexels(int columns, int rows, TextureCoordinate coordinate);

[[nodiscard]] inline BilinearTexels bilinearTexels(int resolution, TextureCoordinate coordinate)
{
  return bilinearTexels(resolution, resolution, coordinate);
}
}

#endif
