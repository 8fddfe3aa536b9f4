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

Point2 diskFromSquare(Point2 square)
{
  const double a = 2 * square.x - 1;
  const double b = 2 * square.y - 1;
  if (a == 0 && b == 0)
  {
    return { 0, 0 };
  }
  const bool wide = std::abs(a) > std::abs(b);
  const double radius = wide ? a : b;
  const double angle = wide ? Pi / 4 * (b / a) : Pi / 2 - Pi / 4 * (a / b);
  return { radius * std::cos(angle), radius * std::sin(angle) };
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

Vec3d cosineHemisphereFromSquare(Point2 square)
{
  const Point2 d = diskFromSquare(square);
  return { d.x, d.y, std::sqrt(std::max(0.0, 1 - d.x * d.x - d.y * d.y)) };
}

double cosineHemispherePdf(Vec3d direction)
{
  return std::max(0.0, direction.z) / Pi;
}

Point2 squareFromCosineHemisphere(Vec3d direction)
{
  return squareFromDisk({ direction.x, direction.y });
}

Vec3d aboutNormal(Vec3d n, Vec3d direction)
{
  const double sign = std::copysign(1.0, n.z);
  const double a = -1 / (sign + n.z);
  const double b = n.x * n.y * a;
  const Vec3d tangent{ 1 + sign * n.x * n.x * a, sign * b, -sign * n.x };
  const Vec3d bitangent{ b, sign + n.y * n.y * a, -n.y };
  return direction.x * tangent + direction.y * bitangent + direction.z * n;
}
}
