// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RimShares_h
#define po_RimShares_h

#include "Camera.h"
#include "Sphere.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/// How much of a pixel lies within a line along the rim of a sphere.
namespace po
{
/// The rays of a small part of the window. Lengths of directions are relative to that in the
/// middle.
struct RayPatch
{
  RayPencil rays;
  double scale;                ///< 1 / length of the direction in the middle
  float qx, qy, qxx, qxy, qyy; ///< squared length of a direction: 1 + 2 qx x + ... + qyy y^2
};

[[nodiscard]] RayPatch makeRayPatch(const RayPencil& rays);

/// The rim of one sphere as the rays of a patch see it.
///
/// The ray at (x, y) from the middle has the distance h = |m| / |d| from the sphere's centre, with
/// m = (centre - origin) x d linear in (x, y): in perspective all rays have one origin, in parallel
/// projection one direction.
struct Rim
{
  const Sphere* sphere;
  float radius;
  float m[3], mx[3], my[3];
};

[[nodiscard]] Rim makeRim(const RayPatch& patch, const Sphere& sphere);

/// One pixel that a line may cover.
struct RimPixel
{
  int rim;
  int pixel;
  float x, y;   ///< its centre, in pixels from the middle of the patch
  float width;  ///< of the line, in pixels
  float weight; ///< strength of the line
  bool isEdge;  ///< on the line for certain: all of it is covered if no rim is near
  std::int32_t frontPixel;
};

/// Pixels whose covered share is asked for, and the answers.
struct RimWork
{
  std::vector<std::int32_t> rims, pixels;
  std::vector<float> x, y, widths, weights, isEdge;
  std::vector<std::int32_t> frontPixels;
  std::vector<float> strengths; ///< weight times the share that the line covers
  std::vector<float> insides;   ///< weight times the share within the rim; 0 if the centre is

  std::size_t count = 0; ///< of pixels; the vectors are longer

  void add(const RimPixel& pixel);
};

/// Fills in the strengths of pixels whose rims are seen by the rays of one patch.
void findShares(const RayPatch& patch, const std::vector<Rim>& allRims, RimWork& work);
}

#endif
