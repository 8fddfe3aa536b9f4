// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereDistances_h
#define po_SphereDistances_h

#include "Camera.h"
#include "Sphere.h"

namespace po
{
/// Distances t at which rays through the centres of pixels meet a sphere that they show, side by
/// side from pixel (x, y) on, in double precision; `distances` has room for 8 more.
void distancesTo(const Sphere& sphere, const PrimaryRayFunctions& rays, int x, int y, int count,
  double* distances);
}

#endif
