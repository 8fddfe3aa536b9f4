// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Vec3_h
#define po_Vec3_h

#include <cmath>

namespace po
{
/// Three numbers with the few operations that ray code needs.
template <typename T>
struct Vec3
{
  T x = 0, y = 0, z = 0;

  template <typename U>
  [[nodiscard]] constexpr Vec3<U> as() const
  {
    return { static_cast<U>(x), static_cast<U>(y), static_cast<U>(z) };
  }
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

template <typename T>
[[nodiscard]] constexpr Vec3<T> operator+(Vec3<T> a, Vec3<T> b)
{
  return { a.x + b.x, a.y + b.y, a.z + b.z };
}

template <typename T>
[[nodiscard]] constexpr Vec3<T> operator-(Vec3<T> a, Vec3<T> b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}

template <typename T>
[[nodiscard]] constexpr Vec3<T> operator-(Vec3<T> a)
{
  return { -a.x, -a.y, -a.z };
}

template <typename T>
[[nodiscard]] constexpr Vec3<T> operator*(T s, Vec3<T> a)
{
  return { s * a.x, s * a.y, s * a.z };
}

template <typename T>
[[nodiscard]] constexpr bool operator==(Vec3<T> a, Vec3<T> b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

template <typename T>
[[nodiscard]] constexpr T dot(Vec3<T> a, Vec3<T> b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <typename T>
[[nodiscard]] constexpr Vec3<T> cross(Vec3<T> a, Vec3<T> b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

template <typename T>
[[nodiscard]] T length(Vec3<T> a)
{
  return std::sqrt(dot(a, a));
}

template <typename T>
[[nodiscard]] bool isFinite(Vec3<T> a)
{
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// The unit vector along a; a must not be zero.
template <typename T>
[[nodiscard]] Vec3<T> normalized(Vec3<T> a)
{
  return (T(1) / length(a)) * a;
}
}

#endif
