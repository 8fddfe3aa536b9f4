// SPDX-License-Identifier: BSD-3-Clause
#include "Camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace po
{
namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();

Vec3d row(const Matrix4& a, std::size_t i)
{
  return { a[4 * i], a[4 * i + 1], a[4 * i + 2] };
}

double homogeneous(const Matrix4& a, std::size_t i, Vec3d p)
{
  return dot(row(a, i), p) + a[4 * i + 3];
}

/// The point e with a e = alpha, b e = beta, c e = gamma (Cramer's rule).
Vec3d meet(Vec3d a, double alpha, Vec3d b, double beta, Vec3d c, double gamma)
{
  const double determinant = dot(a, cross(b, c));
  return (1 / determinant) * (alpha * cross(b, c) + beta * cross(c, a) + gamma * cross(a, b));
}

WindowFunction<Vec3d> transformPoints(const Matrix4& a, const WindowFunction<Vec3d>& f)
{
  return { transformPoint(a, f.base), transformVector(a, f.dx), transformVector(a, f.dy) };
}

WindowFunction<Vec3d> transformVectors(const Matrix4& a, const WindowFunction<Vec3d>& f)
{
  return { transformVector(a, f.base), transformVector(a, f.dx), transformVector(a, f.dy) };
}

std::array<Vec3d, 8> corners(Vec3d low, Vec3d high)
{
  std::array<Vec3d, 8> points;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = { (i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z };
  }
  return points;
}

/// The factor of all lengths, or 0 if directions differ by more than rounding.
double evenScale(const Matrix4& a)
{
  const Vec3d x = transformVector(a, { 1, 0, 0 }), y = transformVector(a, { 0, 1, 0 }),
              z = transformVector(a, { 0, 0, 1 });
  const double squared = dot(x, x), tolerance = 1e-14 * squared;
  const bool even = std::abs(dot(y, y) - squared) <= tolerance &&
    std::abs(dot(z, z) - squared) <= tolerance && std::abs(dot(x, y)) <= tolerance &&
    std::abs(dot(y, z)) <= tolerance && std::abs(dot(z, x)) <= tolerance;
  return even ? std::sqrt(squared) : 0;
}

bool isFinite(const Matrix4& a)
{
  double sum = 0;
  for (const double value : a)
  {
    sum += std::abs(value);
  }
  return std::isfinite(sum);
}
}

Matrix4 multiply(const Matrix4& a, const Matrix4& b)
{
  Matrix4 product{};
  for (std::size_t i = 0; i < 4; ++i)
  {
    for (std::size_t j = 0; j < 4; ++j)
    {
      for (std::size_t k = 0; k < 4; ++k)
      {
        product[4 * i + j] += a[4 * i + k] * b[4 * k + j];
      }
    }
  }
  return product;
}

Vec3d transformPoint(const Matrix4& a, Vec3d p)
{
  return { homogeneous(a, 0, p), homogeneous(a, 1, p), homogeneous(a, 2, p) };
}

Vec3d transformVector(const Matrix4& a, Vec3d v)
{
  return { dot(row(a, 0), v), dot(row(a, 1), v), dot(row(a, 2), v) };
}

Vec3d transformTransposed(const Matrix4& a, Vec3d v)
{
  return v.x * row(a, 0) + v.y * row(a, 1) + v.z * row(a, 2);
}

std::optional<Matrix4> invertAffine(const Matrix4& a)
{
  const Vec3d x = row(a, 0), y = row(a, 1), z = row(a, 2);
  const double determinant = dot(x, cross(y, z));
  const Vec3d c0 = (1 / determinant) * cross(y, z);
  const Vec3d c1 = (1 / determinant) * cross(z, x);
  const Vec3d c2 = (1 / determinant) * cross(x, y);
  Matrix4 inverse{ c0.x, c1.x, c2.x, 0, c0.y, c1.y, c2.y, 0, c0.z, c1.z, c2.z, 0, 0, 0, 0, 1 };
  const Vec3d offset = transformVector(inverse, { a[3], a[7], a[11] });
  inverse[3] = -offset.x;
  inverse[7] = -offset.y;
  inverse[11] = -offset.z;
  return isFinite(a) && isFinite(inverse) ? std::optional(inverse) : std::nullopt;
}

Camera bandOf(const Camera& camera, int first, int rows)
{
  Camera band = camera;
  band.height = rows;
  // In clip space y goes from -w to w over all rows; the band's shall do so over its own.
  const double stretch = static_cast<double>(camera.height) / rows;
  const double shift = (camera.height - 2.0 * first - rows) / rows;
  for (std::size_t column = 0; column < 4; ++column)
  {
    band.eyeToClip[4 + column] =
      stretch * camera.eyeToClip[4 + column] + shift * camera.eyeToClip[12 + column];
  }
  return band;
}

std::optional<PrimaryRays> PrimaryRays::make(const Camera& camera, const Matrix4& localToWorld)
{
  const std::optional<Matrix4> eyeToWorld = invertAffine(camera.worldToEye);
  const std::optional<Matrix4> worldToLocal = invertAffine(localToWorld);
  if (!eyeToWorld || !worldToLocal || camera.width < 1 || camera.height < 1)
  {
    return std::nullopt;
  }
  PrimaryRays rays;
  rays.f_.width = camera.width;
  rays.f_.height = camera.height;
  rays.localToWorld_ = localToWorld;
  rays.f_.worldPerLocal = evenScale(localToWorld);
  rays.worldToLocal_ = *worldToLocal;
  rays.localToClip_ = multiply(camera.eyeToClip, multiply(camera.worldToEye, localToWorld));
  rays.setEyeRays(camera.eyeToClip);
  rays.worldOrigin_ = transformPoints(*eyeToWorld, rays.eyeOrigin_);
  rays.f_.worldDirection = transformVectors(*eyeToWorld, rays.eyeDirection_);
  rays.f_.localOrigin = transformPoints(*worldToLocal, rays.worldOrigin_);
  rays.f_.localDirection = transformVectors(*worldToLocal, rays.f_.worldDirection);
  return rays;
}

void PrimaryRays::setEyeRays(const Matrix4& p)
{
  const Vec3d p0 = row(p, 0), p1 = row(p, 1), p2 = row(p, 2), p3 = row(p, 3);
  const bool perspective = dot(p3, p3) > 0;

  // Ahead is where w grows (perspective) or z grows (parallel).
  const Vec3d axis = cross(p0, p1);
  const double sign = dot(perspective ? p3 : p2, axis) < 0 ? -1 : 1;
  eyeDirection_ = { sign * axis, sign * cross(p1, p3), sign * cross(p3, p0) };
  f_.perspective = perspective;
  if (perspective)
  {
    eyeOrigin_ = { meet(p0, -p[3], p1, -p[7], p3, -p[15]), {}, {} };
  }
  else
  {
    eyeOrigin_ = { meet(p0, -p[3], p1, -p[7], axis, 0), meet(p0, p[15], p1, 0, axis, 0),
      meet(p0, 0, p1, p[15], axis, 0) };
  }
  f_.originZ = { homogeneous(p, 2, eyeOrigin_.base), dot(p2, eyeOrigin_.dx),
    dot(p2, eyeOrigin_.dy) };
  f_.originW = { homogeneous(p, 3, eyeOrigin_.base), dot(p3, eyeOrigin_.dx),
    dot(p3, eyeOrigin_.dy) };
  f_.directionZ = { dot(p2, eyeDirection_.base), dot(p2, eyeDirection_.dx),
    dot(p2, eyeDirection_.dy) };
  f_.directionW = { dot(p3, eyeDirection_.base), dot(p3, eyeDirection_.dx),
    dot(p3, eyeDirection_.dy) };
}

PrimaryRay PrimaryRays::at(double windowX, double windowY) const
{
  const double x = f_.clipX(windowX), y = f_.clipY(windowY);
  const Vec3d direction = f_.localDirection.at(x, y);
  const double localLength = length(direction);
  const double worldPerLocal =
    f_.worldPerLocal > 0 ? f_.worldPerLocal : length(f_.worldDirection.at(x, y)) / localLength;
  const double z = f_.originZ.at(x, y), w = f_.originW.at(x, y);
  const double dz = f_.directionZ.at(x, y), dw = f_.directionW.at(x, y);
  // z = -w on the near plane, z = w on the far one; both are linear along the ray.
  const double nearest = dz + dw > 0 ? -(z + w) / (dz + dw) : -Infinity;
  const double farthest = dw - dz < 0 ? -(w - z) / (dw - dz) : Infinity;
  return { f_.localOrigin.at(x, y), (1 / localLength) * direction, nearest * localLength,
    farthest * localLength, worldPerLocal, z, w, dz / localLength, dw / localLength };
}

Vec3d PrimaryRays::worldDirection(double x, double y) const
{
  return normalized(f_.worldDirection.at(f_.clipX(x), f_.clipY(y)));
}

Vec3d PrimaryRays::worldPoint(double x, double y, double t) const
{
  return worldOrigin_.at(f_.clipX(x), f_.clipY(y)) + t * worldDirection(x, y);
}

PixelRange PrimaryRays::pixelsOfBox(Vec3d low, Vec3d high) const
{
  double x0 = Infinity, y0 = Infinity, x1 = -Infinity, y1 = -Infinity;
  for (const Vec3d& p : corners(low, high))
  {
    const double w = homogeneous(localToClip_, 3, p);
    if (!(w > 0))
    {
      return { 0, 0, f_.width, f_.height }; // beside or behind the eye
    }
    const double x = homogeneous(localToClip_, 0, p) / w, y = homogeneous(localToClip_, 1, p) / w;
    x0 = std::min(x0, x);
    y0 = std::min(y0, y);
    x1 = std::max(x1, x);
    y1 = std::max(y1, y);
  }
  const auto toPixel = [](double clip, int size, double slack)
  { return static_cast<int>(std::clamp(0.5 * (clip + 1) * size + slack, 0.0, double(size))); };
  return { toPixel(x0, f_.width, -1), toPixel(y0, f_.height, -1), toPixel(x1, f_.width, 2),
    toPixel(y1, f_.height, 2) };
}

double PrimaryRays::startOfBox(Vec3d low, Vec3d high) const
{
  if (f_.perspective)
  {
    const Vec3d eye = f_.localOrigin.base;
    const auto beside = [](double p, double a, double b) {
      return std::max({ a - p, p - b, 0.0 });
    };
    return length(Vec3d{
      beside(eye.x, low.x, high.x), beside(eye.y, low.y, high.y), beside(eye.z, low.z, high.z) });
  }
  // s = (p - origin) . direction, linear in the point and in the position in the window.
  const Vec3d direction = normalized(f_.localDirection.base);
  double start = Infinity;
  for (const Vec3d& p : corners(low, high))
  {
    start = std::min(start, dot(p - f_.localOrigin.base, direction));
  }
  return start - std::abs(dot(f_.localOrigin.dx, direction)) -
    std::abs(dot(f_.localOrigin.dy, direction));
}

bool PrimaryRays::isCutByNearPlane(Vec3d low, Vec3d high) const
{
  for (const Vec3d& p : corners(low, high))
  {
    if (homogeneous(localToClip_, 2, p) < -homogeneous(localToClip_, 3, p))
    {
      return true;
    }
  }
  return false;
}

PixelRange intersect(const PixelRange& a, const PixelRange& b)
{
  return { std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1) };
}
}
