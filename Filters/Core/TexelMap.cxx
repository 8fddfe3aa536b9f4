// SPDX-License-Identifier: BSD-3-Clause
#include "TexelMap.h"

#include "Constants.h"

#include <algorithm>
#include <cmath>

namespace po
{
TextureCoordinate textureCoordinate(Vec3d d)
{
  const double azimuth = std::atan2(d.y, d.x);
  // acos(z) has no digits left near the poles; the angle from both legs has.
  const double polar = std::atan2(std::hypot(d.x, d.y), d.z);
  double u = azimuth / (2 * Pi);
  u -= std::floor(u);
  return { u < 1 ? u : 0.0, polar / Pi }; // -1e-17 wraps to 1 by rounding
}

Vec3d textureDirection(TextureCoordinate c)
{
  const double azimuth = 2 * Pi * c.u;
  const double polar = Pi * c.v;
  const double s = std::sin(polar);
  return { s * std::cos(azimuth), s * std::sin(azimuth), std::cos(polar) };
}

TexelPatch::TexelPatch(int resolution, int row, int column)
  : top_(std::cos(Pi * row / resolution))
  , height_(std::cos(Pi * (row + 1) / resolution) - top_)
  , azimuth_(2 * Pi * column / resolution)
  , azimuthWidth_(2 * Pi / resolution)
{
}

double texelArea(int resolution, int row)
{
  const double top = std::cos(Pi * row / resolution);
  const double bottom = std::cos(Pi * (row + 1) / resolution);
  return 2 * Pi / resolution * (top - bottom);
}

double texelAngularRadius(int resolution, int row)
{
  if (resolution == 1)
  {
    return Pi; // the one texel is the whole sphere
  }
  // On a row's upper and lower edge the distance from the centre grows with the azimuth, so the
  // farthest point of the texel is a corner.
  const Vec3d center = textureDirection({ 0.5 / resolution, (row + 0.5) / resolution });
  double radius = 0;
  for (const int edge : { row, row + 1 })
  {
    const Vec3d corner = textureDirection({ 0.0, static_cast<double>(edge) / resolution });
    radius = std::max(radius, std::acos(std::clamp(dot(center, corner), -1.0, 1.0)));
  }
  return radius;
}

BilinearTexels bilinearTexels(int columns, int rows, TextureCoordinate c)
{
  const double x = c.u * columns - 0.5;
  const double y = c.v * rows - 0.5;
  // Both are at least -1/2: cutting off after adding 1 is a floor, without a call.
  const int i = static_cast<int>(x + 1) - 1;
  const int j = static_cast<int>(y + 1) - 1;
  const auto fx = static_cast<float>(x - i);
  const auto fy = static_cast<float>(y - j);

  const int i0 = i < 0 ? columns - 1 : i;
  const int i1 = i + 1 < columns ? i + 1 : 0;
  const int j0 = std::clamp(j, 0, rows - 1);
  const int j1 = std::clamp(j + 1, 0, rows - 1);
  return { { texelIndex(columns, j0, i0), texelIndex(columns, j0, i1), texelIndex(columns, j1, i0),
             texelIndex(columns, j1, i1) },
    { (1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy } };
}
}
