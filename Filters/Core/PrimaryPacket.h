// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_PrimaryPacket_h
#define po_PrimaryPacket_h

#include "Camera.h"
#include "Embree.h"
#include "Sphere.h"

#include <cstddef>
#include <cstdint>

namespace po
{
/// The eye rays of 4 x 4 pixels and what they hit, lane by lane (row by row), in vector code.
///
/// Everything is in double precision but what Embree takes. The numbers mean what they mean in
/// PrimaryRay.
struct PrimaryPacket
{
  static constexpr int Side = 4;
  static constexpr std::size_t Size = Side * Side;

  // Rays.
  alignas(64) double directionX[Size], directionY[Size], directionZ[Size];
  alignas(64) double originX[Size], originY[Size], originZ[Size];
  alignas(64) double inverseLength[Size]; ///< of the direction before it was made a unit vector
  alignas(64) double start[Size];         ///< s at which Embree's ray begins

  // Candidates, one a lane, in the order x, y, z, radius; of radius 0: none.
  alignas(64) float sphere[4][Size];
  alignas(64) std::uint32_t id[Size]; ///< SphereScene::None: no candidate

  // Fronts, as in TracedFrame, also where there is no candidate.
  alignas(64) double t[Size];
  alignas(64) float normalX[Size], normalY[Size], normalZ[Size];
  alignas(64) float windowDepth[Size];
  /// 1 where there is a candidate whose front may not be the nearest, else 0: it is not met between
  /// the near and the far plane, or far from the start, or t is another multiple of s in each lane.
  alignas(64) float isDoubtful[Size];
};

/// Makes the rays of pixels [x0, x0 + 4) x [y0, y0 + 4) and hands them to Embree's packet, which is
/// ready to be traced when this returns.
///
/// @param sampleX, sampleY the place of the ray in its pixel, 0 to 1
/// @param start where rays begin, at the near plane if that is farther
/// @param clipStart whether the near plane may be farther
void makeRays(const PrimaryRayFunctions& rays, int x0, int y0, double sampleX, double sampleY,
  double start, bool clipStart, PrimaryPacket& packet, RTCRayHit16& query);

/// Intersects the front of each lane's candidate, whatever Embree found of it.
/// @return number of doubtful lanes
std::size_t meetFronts(const PrimaryRayFunctions& rays, int x0, int y0, double sampleX,
  double sampleY, PrimaryPacket& packet);
}

#endif
