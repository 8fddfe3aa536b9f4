// SPDX-License-Identifier: BSD-3-Clause
#include "SphereBoxes.h"

// Highway compiles this file once for each instruction set (SSE4, AVX2, AVX-512, NEON, ...) and
// chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "SphereBoxes.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

/// Vectors of more would wait for the spheres that were just copied one by one.
using Spheres = hn::CappedTag<float, 4>;

inline unsigned bitsOf(Spheres d, hn::Mask<Spheres> lanes)
{
  HWY_ALIGN std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, lanes, bytes);
  return bytes[0];
}

/// @param spheres [SphereBoxes::Size]
unsigned findNear(const Sphere* spheres, Vec3f point, float distance)
{
  constexpr float slack = 1e-5f; // for rounding
  const Spheres d;
  unsigned bits = 0;
  for (std::size_t i = 0; i < SphereBoxes::Size; i += hn::Lanes(d))
  {
    hn::Vec<Spheres> x, y, z, radius;
    hn::LoadInterleaved4(d, &spheres[i].x, x, y, z, radius);
    x = hn::Sub(x, hn::Set(d, point.x));
    y = hn::Sub(y, hn::Set(d, point.y));
    z = hn::Sub(z, hn::Set(d, point.z));
    const auto square = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
    const auto reach = hn::Mul(hn::Add(radius, hn::Set(d, distance)), hn::Set(d, 1 + slack));
    bits |= bitsOf(d, hn::Le(square, hn::Mul(reach, reach))) << i;
  }
  return bits;
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "BrickOrder.h"

#include <array>
#include <cmath>

namespace po
{
HWY_EXPORT(findNear);

SphereBoxes::SphereBoxes(const Brick& brick)
  : brick_(&brick)
  , places_(orderInSpace(brick))
{
}

unsigned SphereBoxes::near(unsigned box, Vec3f point, float distance) const
{
  const std::size_t count = spheresIn(box);
  if (places_.empty() && count == Size)
  {
    return HWY_DYNAMIC_DISPATCH(findNear)(&sphere(box, 0), point, distance);
  }
  std::array<Sphere, Size> spheres;
  if (count < Size)
  {
    spheres.fill({ NAN, NAN, NAN, NAN }); // near nothing
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    spheres[i] = sphere(box, i);
  }
  return HWY_DYNAMIC_DISPATCH(findNear)(spheres.data(), point, distance);
}
}
#endif
