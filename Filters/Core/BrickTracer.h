// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BrickTracer_h
#define po_BrickTracer_h

#include "FrameTracer.h"
#include "FrontFinder.h"
#include "PrimaryPacket.h"

#include <cstddef>

namespace po
{
/// Traces one brick of a scene. All its work is relative to the brick's origin, which moves the
/// origins of rays and leaves lengths as they are. The first brick's tracer writes every pixel;
/// those of others, which follow it in each tile, write where they find something nearer.
class BrickTracer
{
public:
  BrickTracer(const SphereScene& scene, std::size_t brick, const PrimaryRays& rays,
    const FrameSettings& settings, TracedFrame& frame);

  [[nodiscard]] bool maySee(const PixelRange& tile) const
  {
    return !intersect(tile, seen_).empty();
  }

  void traceTile(const PixelRange& tile, TraceCounters& counters) const;

  /// What is behind the front that a pixel shows.
  void traceBehind(int x, int y, const TracedFrame& inFront, TraceCounters& counters) const;

private:
  [[nodiscard]] bool isFirst() const { return number_ == 0; }
  void clearFirst(const PixelRange& range) const;

  // Rays.
  [[nodiscard]] PrimaryRay rayAt(int x, int y) const;
  [[nodiscard]] Front find(const PrimaryRay& ray, double start, TraceCounters& counters) const;

  // Packets of pixels.
  void tracePacket(const PixelRange& range, TraceCounters& counters) const;
  [[nodiscard]] bool findCandidates(
    const PixelRange& range, RTCRayHit16& query, PrimaryPacket& packet) const;
  void copyPacket(
    const PixelRange& range, const PrimaryPacket& packet, TraceCounters& counters) const;
  void mergePacket(
    const PixelRange& range, const PrimaryPacket& packet, TraceCounters& counters) const;
  void traceDoubtful(
    const PixelRange& range, const PrimaryPacket& packet, TraceCounters& counters) const;

  // Single pixels.
  [[nodiscard]] std::size_t pixelOf(int x, int y) const;
  [[nodiscard]] bool isBehind(std::size_t pixel, double t) const;
  void countHit(std::size_t pixel, TraceCounters& counters) const;
  void store(
    std::size_t pixel, const PrimaryRay& ray, const Front& front, TraceCounters& counters) const;
  void storeNothing(std::size_t pixel) const;

  const SphereScene& scene_;
  std::size_t number_;
  const Brick& brick_;
  const PrimaryRays& rays_;
  PrimaryRayFunctions functions_; ///< relative to the brick
  const FrameSettings& settings_;
  TracedFrame& frame_;
  PixelRange seen_; ///< nothing is to be seen outside
  double start_;    ///< no ray meets a sphere before
  bool isCut_;      ///< the near plane may be behind some fronts
};
}

#endif
