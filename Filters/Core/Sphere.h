// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Sphere_h
#define po_Sphere_h

#include "Vec3.h"

namespace po
{
/// A sphere in the layout of Embree's sphere points: centre and radius interleaved, 16 bytes.
struct Sphere
{
  float x, y, z, radius;

  [[nodiscard]] constexpr Vec3f center() const { return { x, y, z }; }
};
static_assert(sizeof(Sphere) == 16);
}

#endif
