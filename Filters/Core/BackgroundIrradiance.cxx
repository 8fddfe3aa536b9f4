// SPDX-License-Identifier: BSD-3-Clause
#include "BackgroundIrradiance.h"

#include "Constants.h"
#include "TexelMap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
// Cells of the sky and points of the map, in latitude and longitude. Irradiance is smooth: nearly
// all of it lies in spherical harmonics up to degree 2 (Ramamoorthi and Hanrahan 2001).
constexpr int CellRows = 48;
constexpr int CellColumns = 96;
constexpr int MapRows = 64;
constexpr int MapColumns = 128;

double bilinear(const ImageBackground& image, TextureCoordinate coordinate)
{
  const BilinearTexels texels = bilinearTexels(image.width, image.height, coordinate);
  double value = 0;
  for (std::size_t k = 0; k < texels.index.size(); ++k)
  {
    value += static_cast<double>(texels.weight[k]) * image.luminance[texels.index[k]];
  }
  return value;
}

/// (1/pi) integral of L(w) w dw over one cell of the sky: at least two points a pixel each way.
Vec3d cellMoment(const ImageBackground& image, int row, int column)
{
  const int pointsDown = std::max(4, (2 * image.height + CellRows - 1) / CellRows);
  const int pointsAlong = std::max(4, (2 * image.width + CellColumns - 1) / CellColumns);
  Vec3d moment;
  for (int j = 0; j < pointsDown; ++j)
  {
    const double v = (row + (j + 0.5) / pointsDown) / CellRows;
    const double solidAngle =
      std::sin(Pi * v) * Pi / CellRows / pointsDown * 2 * Pi / CellColumns / pointsAlong;
    for (int i = 0; i < pointsAlong; ++i)
    {
      const TextureCoordinate at{ (column + (i + 0.5) / pointsAlong) / CellColumns, v };
      moment = moment + (bilinear(image, at) * solidAngle / Pi) * textureDirection(at);
    }
  }
  return moment;
}

ImageBackground irradianceMap(const ImageBackground& image)
{
  std::vector<Vec3d> moments(static_cast<std::size_t>(CellRows * CellColumns));
  tbb::parallel_for(0, CellRows,
    [&](int row)
    {
      for (int column = 0; column < CellColumns; ++column)
      {
        moments[static_cast<std::size_t>(row * CellColumns + column)] =
          cellMoment(image, row, column);
      }
    });
  ImageBackground map{ MapColumns, MapRows,
    std::vector<float>(static_cast<std::size_t>(MapRows * MapColumns)) };
  tbb::parallel_for(0, MapRows,
    [&](int row)
    {
      for (int column = 0; column < MapColumns; ++column)
      {
        const Vec3d normal =
          textureDirection({ (column + 0.5) / MapColumns, (row + 0.5) / MapRows });
        double sum = 0;
        for (const Vec3d& moment : moments)
        {
          sum += std::max(0.0, dot(moment, normal));
        }
        map.luminance[static_cast<std::size_t>(row * MapColumns + column)] =
          static_cast<float>(sum);
      }
    });
  return map;
}
}

BackgroundIrradiance::BackgroundIrradiance(const Background& background)
  : source_(background)
{
  if (const auto* image = std::get_if<ImageBackground>(&background))
  {
    source_ = irradianceMap(*image);
  }
  else if (auto* gradient = std::get_if<GradientBackground>(&source_))
  {
    // (1/pi) integral of (b + (t - b)(1 + w.up)/2) cos = b + (t - b)(1/2 + n.up/3): again linear
    // in the height of the normal, with two thirds of the slope.
    const double middle = (gradient->bottom + gradient->top) / 2;
    const double half = (gradient->top - gradient->bottom) / 3;
    gradient->bottom = middle - half;
    gradient->top = middle + half;
  }
}

double BackgroundIrradiance::operator()(Vec3d normal) const
{
  return luminance(source_, normal);
}
}
