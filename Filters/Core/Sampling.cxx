// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling.h"

#include "Constants.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace po
{
StratifiedSquare::StratifiedSquare(int count)
{
  const int rows = std::max(1, static_cast<int>(std::lround(std::sqrt(count))));
  strata_.reserve(static_cast<std::size_t>(count));
  double y = 0;
  for (int row = 0; row < rows; ++row)
  {
    const int columns = count * (row + 1) / rows - count * row / rows;
    const double height = static_cast<double>(columns) / count;
    for (int column = 0; column < columns; ++column)
    {
      strata_.push_back({ static_cast<double>(column) / columns, y, 1.0 / columns, height });
    }
    y += height;
  }
}

void randomPermutation(Random& random, std::vector<std::uint32_t>& order)
{
  std::iota(order.begin(), order.end(), 0u);
  for (auto remaining = static_cast<std::uint32_t>(order.size()); remaining > 1; --remaining)
  {
    std::swap(order[remaining - 1], order[random.below(remaining)]);
  }
}

Point2 squareFromDisk(Point2 disk)
{
  const double radius = std::hypot(disk.x, disk.y);
  double angle = std::atan2(disk.y, disk.x);
  if (angle < -Pi / 4)
  {
    angle += 2 * Pi;
  }
  double a = 0;
  double b = 0;
  if (angle < Pi / 4)
  {
    a = radius;
    b = angle * a / (Pi / 4);
  }
  else if (angle < 3 * Pi / 4)
  {
    b = radius;
    a = -(angle - Pi / 2) * b / (Pi / 4);
  }
  else if (angle < 5 * Pi / 4)
  {
    a = -radius;
    b = (angle - Pi) * a / (Pi / 4);
  }
  else
  {
    b = -radius;
    a = -(angle - 3 * Pi / 2) * b / (Pi / 4);
  }
  return { (a + 1) / 2, (b + 1) / 2 };
}

double cosineHemispherePdf(Vec3d direction)
{
  return std::max(0.0, direction.z) / Pi;
}

Point2 squareFromCosineHemisphere(Vec3d direction)
{
  return squareFromDisk({ direction.x, direction.y });
}
}
