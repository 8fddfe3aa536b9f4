// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_FrameTracer_h
#define po_FrameTracer_h

#include "Camera.h"
#include "DepthSource.h"
#include "SphereScene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// Where in their pixels rays go, and what they do not see.
struct FrameSettings
{
  double sampleX = 0.5; ///< place of the ray in its pixel, 0 (left) to 1
  double sampleY = 0.5; ///< 0 (lower edge) to 1
  /// Of each sphere of the scene: not 0 if rays pass it; null: they pass none.
  const std::uint8_t* hidden = nullptr;
};

/// What each pixel of a window sees, row by row from the lower left corner.
struct TracedFrame
{
  static constexpr float NoDepth = 2;

  int width = 0;
  int height = 0;
  double sampleX = 0.5, sampleY = 0.5; ///< as in FrameSettings
  std::vector<double> t;             ///< distance along the ray in world units, +infinity: nothing
  std::vector<std::uint32_t> sphere; ///< index into the scene's spheres, or SphereScene::None
  std::vector<Vec3f> normal;         ///< local outward unit normal of a hit, otherwise 0
  std::vector<float> windowDepth;    ///< 0 at the near and 1 at the far plane, NoDepth: nothing
  std::vector<DepthRange> tiles;     ///< range of t in each tile of DepthTileSize pixels

  [[nodiscard]] std::size_t pixels() const { return sphere.size(); }

  /// Makes pixels show nothing.
  void clear(const PixelRange& range);
};

/// What a frame cost.
struct TraceCounters
{
  std::size_t rays = 0;         ///< Embree rays, repeated ones included
  std::size_t hits = 0;         ///< pixels that show a sphere
  std::size_t tiles = 0;        ///< tiles in the window
  std::size_t tilesSkipped = 0; ///< tiles that cannot show any sphere
};

/// Traces one ray a pixel, in parallel; the result does not depend on threads.
///
/// Embree finds candidates in single precision, from a start close to the spheres; each candidate
/// is then intersected in double precision, so that t and normal are right to double rounding for
/// any distance of the eye. A sphere that the near plane cuts is not drawn for the rays that start
/// inside of it: they go on to what is behind, so that a flight through a cloud stays clear.
/// Spheres beyond the far plane are not seen.
TraceCounters traceFrame(const SphereScene& scene, const PrimaryRays& rays,
  const FrameSettings& settings, TracedFrame& frame);

/// Traces what is seen behind a frame of the same rays and settings: the next front of another
/// sphere (of two in the very same place only one is met).
/// @param wanted of each pixel: 0 if it need not be looked at
TraceCounters traceBehind(const SphereScene& scene, const PrimaryRays& rays,
  const FrameSettings& settings, const TracedFrame& inFront,
  const std::vector<std::uint8_t>& wanted, TracedFrame& frame);
}

#endif
