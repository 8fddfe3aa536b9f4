// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SingleRay_h
#define po_SingleRay_h

#include "Embree.h"
#include "Vec3.h"

#include <cstddef>
#include <cstring>

namespace po
{
/// Is anything hit between `start` and `distance`, that the filter, if there is one, lets count?
[[nodiscard]] inline bool isStopped(RTCScene scene, RayQueryContext& context, const Vec3f& origin,
  float start, const Vec3f& direction, float distance, RTCFilterFunctionN filter = nullptr)
{
  // Embree reads four floats at once. Written one by one, just before, they would keep it waiting
  // for a tenth of the time that a ray takes.
  using FourFloats __attribute__((vector_size(16))) = float;
  const FourFloats from{ origin.x, origin.y, origin.z, start };
  const FourFloats towards{ direction.x, direction.y, direction.z, 0 }; // and the time
  RTCRay ray;
  static_assert(offsetof(RTCRay, tnear) == 12 && offsetof(RTCRay, time) == 28);
  std::memcpy(&ray.org_x, &from, sizeof(from));
  std::memcpy(&ray.dir_x, &towards, sizeof(towards));
  ray.tfar = distance;
  ray.mask = 0xFFFFFFFFu;
  ray.id = 0;
  ray.flags = 0;
  occluded1(scene, context, ray, filter);
  return ray.tfar < 0; // Embree marks an occluded ray with -infinity
}
}

#endif
