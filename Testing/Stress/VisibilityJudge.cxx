// SPDX-License-Identifier: BSD-3-Clause
#include "VisibilityJudge.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace judge
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr std::size_t LeafSize = 4;

/// Uniform numbers from a counter (SplitMix64).
class Numbers
{
public:
  Numbers(std::uint64_t id, std::uint64_t texel)
    : state_(id * 0x9E3779B97F4A7C15ull + (texel + 1) * 0xD1B54A32D192ED03ull)
  {
  }

  double next()
  {
    std::uint64_t v = (state_ += 0x9E3779B97F4A7C15ull);
    v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9ull;
    v = (v ^ (v >> 27)) * 0x94D049BB133111EBull;
    return static_cast<double>((v ^ (v >> 31)) >> 11) * 0x1p-53;
  }

private:
  std::uint64_t state_;
};

/// The unit vector of a polar angle, given by its cosine, and an azimuth.
Vec3d unit(double cosine, double azimuth)
{
  const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
  return { sine * std::cos(azimuth), sine * std::sin(azimuth), cosine };
}

/// Row j covers polar angles [j pi/T, (j+1) pi/T], column i azimuths [2 pi i/T, 2 pi (i+1)/T];
/// equal areas have equal heights.
Vec3d pointOfTexel(int resolution, int row, int column, double s, double t)
{
  const double top = std::cos(Pi * row / resolution);
  const double bottom = std::cos(Pi * (row + 1) / resolution);
  return unit(top + t * (bottom - top), 2 * Pi * (column + s) / resolution);
}

/// A direction about the normal with the density cos / pi.
Vec3d cosineDirection(Vec3d normal, double s, double t)
{
  const Vec3d aside = std::abs(normal.x) < 0.6 ? Vec3d{ 1, 0, 0 } : Vec3d{ 0, 1, 0 };
  const Vec3d x = po::normalized(po::cross(normal, aside));
  const Vec3d y = po::cross(normal, x);
  const double sine = std::sqrt(s);
  return po::normalized(
    sine * std::cos(2 * Pi * t) * x + sine * std::sin(2 * Pi * t) * y + std::sqrt(1 - s) * normal);
}

/// The largest angle between the middle of a texel and a point of it, by trying its edges; the
/// middle ones of these count too, where a texel is wide.
double angularRadius(int resolution, int row, Vec3d middle)
{
  double radius = 0;
  for (int i = 0; i <= 16; ++i)
  {
    for (const double t : { 0.0, 0.5, 1.0 })
    {
      const double cosine =
        po::dot(middle, pointOfTexel(resolution, row, 0, static_cast<double>(i) / 16, t));
      radius = std::max(radius, std::acos(std::clamp(cosine, -1.0, 1.0)));
    }
  }
  return radius;
}

double part(Vec3d v, int axis)
{
  return axis == 0 ? v.x : (axis == 1 ? v.y : v.z);
}

/// Whether a ray, or the point where it starts, meets a box.
bool meetsBox(Vec3d low, Vec3d high, Vec3d from, Vec3d way, double distance)
{
  double enter = 0;
  double leave = distance;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double a = part(low, axis) - part(from, axis);
    const double b = part(high, axis) - part(from, axis);
    const double w = part(way, axis);
    if (w == 0)
    {
      if (a > 0 || b < 0)
      {
        return false;
      }
      continue;
    }
    enter = std::max(enter, std::min(a / w, b / w));
    leave = std::min(leave, std::max(a / w, b / w));
  }
  return enter <= leave;
}
}

Judge::Judge(std::vector<Ball> balls)
  : balls_(std::move(balls))
  , order_(balls_.size())
{
  std::iota(order_.begin(), order_.end(), std::size_t(0));
  // Equal balls are one obstacle.
  const auto numbers = [this](std::size_t i)
  {
    const Ball& b = balls_[i];
    return std::tuple(b.center.x, b.center.y, b.center.z, b.radius);
  };
  std::sort(order_.begin(), order_.end(),
    [&](std::size_t a, std::size_t b) { return numbers(a) < numbers(b); });
  order_.erase(std::unique(order_.begin(), order_.end(),
                 [&](std::size_t a, std::size_t b) { return numbers(a) == numbers(b); }),
    order_.end());
  if (!order_.empty())
  {
    build(0, order_.size());
  }
}

std::size_t Judge::build(std::size_t first, std::size_t last)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3d low{ infinity, infinity, infinity };
  Vec3d high = -low;
  for (std::size_t i = first; i < last; ++i)
  {
    const Ball& b = balls_[order_[i]];
    // A little wider than the ball: rounding must not lose it.
    const double r = b.radius * (1 + 1e-9);
    const Vec3d slack{ r + 1e-15 * std::abs(b.center.x), r + 1e-15 * std::abs(b.center.y),
      r + 1e-15 * std::abs(b.center.z) };
    const Vec3d from = b.center - slack;
    const Vec3d to = b.center + slack;
    low = { std::min(low.x, from.x), std::min(low.y, from.y), std::min(low.z, from.z) };
    high = { std::max(high.x, to.x), std::max(high.y, to.y), std::max(high.z, to.z) };
  }
  const std::size_t self = nodes_.size();
  nodes_.push_back({ low, high, first, last, 0 });
  if (last - first > LeafSize)
  {
    const Vec3d extent = high - low;
    const int axis =
      extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    const std::size_t middle = (first + last) / 2;
    std::nth_element(order_.begin() + static_cast<std::ptrdiff_t>(first),
      order_.begin() + static_cast<std::ptrdiff_t>(middle),
      order_.begin() + static_cast<std::ptrdiff_t>(last),
      [&](std::size_t a, std::size_t b)
      { return part(balls_[a].center, axis) < part(balls_[b].center, axis); });
    build(first, middle);
    const std::size_t right = build(middle, last);
    nodes_[self].right = right;
  }
  return self;
}

/// Calls visit(ball) for the balls in boxes that `meets` accepts, until it returns true.
/// @param from boxes are taken relative to it
template <typename Meets, typename Visit>
bool Judge::any(Vec3d from, Meets meets, Visit visit) const
{
  std::vector<std::size_t> stack;
  stack.reserve(64);
  if (!nodes_.empty())
  {
    stack.push_back(0);
  }
  while (!stack.empty())
  {
    const std::size_t index = stack.back();
    stack.pop_back();
    const Node& node = nodes_[index];
    if (!meets(node.low - from, node.high - from))
    {
      continue;
    }
    if (node.right != 0)
    {
      stack.push_back(node.right);
      stack.push_back(index + 1);
      continue;
    }
    for (std::size_t i = node.first; i < node.last; ++i)
    {
      if (visit(order_[i]))
      {
        return true;
      }
    }
  }
  return false;
}

bool Judge::isInside(std::size_t id, Vec3d offset) const
{
  const Ball& self = balls_[id];
  const auto meets = [offset](Vec3d low, Vec3d high)
  {
    return offset.x >= low.x && offset.x <= high.x && offset.y >= low.y && offset.y <= high.y &&
      offset.z >= low.z && offset.z <= high.z;
  };
  return any(self.center, meets,
    [&](std::size_t other)
    {
      const Ball& b = balls_[other];
      const Vec3d between = b.center - self.center;
      const bool same = po::dot(between, between) == 0 && b.radius == self.radius;
      return other != id && !same && po::length(offset - between) < b.radius;
    });
}

bool Judge::isBlocked(std::size_t id, Vec3d offset, Vec3d way, double distance) const
{
  const Ball& self = balls_[id];
  return any(
    self.center, [&](Vec3d low, Vec3d high) { return meetsBox(low, high, offset, way, distance); },
    [&](std::size_t other)
    {
      const Ball& b = balls_[other];
      const Vec3d toCenter = (b.center - self.center) - offset;
      const double along = po::dot(toCenter, way);
      if (other == id || along <= 0)
      {
        return false; // it lies behind a point that is outside of it
      }
      const double miss = po::length(toCenter - along * way);
      return miss < b.radius && along - std::sqrt((b.radius - miss) * (b.radius + miss)) < distance;
    });
}

Texel Judge::look(
  std::size_t id, int resolution, int row, int column, int points, double distance) const
{
  Numbers numbers(id, static_cast<std::uint64_t>(row) * 4096 + static_cast<std::uint64_t>(column));
  Texel found;
  found.points = points;
  for (int i = 0; i < points; ++i)
  {
    const double s = numbers.next();
    const double t = numbers.next();
    const Vec3d normal = pointOfTexel(resolution, row, column, s, t);
    const double u = numbers.next();
    const Vec3d way = cosineDirection(normal, u, numbers.next());
    const Vec3d offset = balls_[id].radius * normal;
    if (!isInside(id, offset))
    {
      ++found.outside;
      found.open += isBlocked(id, offset, way, distance) ? 0 : 1;
    }
  }
  return found;
}

bool Judge::isOpen(std::size_t id, int resolution, int row, int column, double margin) const
{
  const Ball& self = balls_[id];
  const Vec3d middle = pointOfTexel(resolution, row, column, 0.5, 0.5);
  const Vec3d first = pointOfTexel(resolution, row, 0, 0.5, 0.5);
  const double reach = angularRadius(resolution, row, first);
  for (std::size_t other = 0; other < balls_.size(); ++other)
  {
    const Vec3d between = balls_[other].center - self.center;
    const double distance = po::length(between);
    if (other == id || (distance == 0 && balls_[other].radius == self.radius))
    {
      continue;
    }
    const double angle =
      distance > 0 ? std::acos(std::clamp(po::dot(between, middle) / distance, -1.0, 1.0)) : 0;
    const double height = distance * std::cos(std::max(0.0, angle - reach));
    if (height + balls_[other].radius > self.radius * (1 - margin))
    {
      return false;
    }
  }
  return true;
}
}
