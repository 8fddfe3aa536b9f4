// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereScene_h
#define po_SphereScene_h

#include "Embree.h"
#include "Sphere.h"

#include <limits>
#include <vector>

namespace po
{
/// Spheres in an Embree scene, with occlusion tests that need no epsilon.
///
/// A point outside (or on) a sphere can only see it where the sphere's centre lies ahead of the
/// ray: the ray's nearest approach to the centre is then at t > 0. Occlusion rays keep only such
/// hits, so rounding at the start of a ray can hit neither the sphere it starts on nor one that it
/// touches. The rule asks that the origin lies outside all spheres; samples inside another sphere
/// must be sorted out before (see OverlapFinder).
class SphereScene
{
public:
  static constexpr unsigned None = std::numeric_limits<unsigned>::max();

  /// Builds the acceleration structure in parallel. An empty scene is allowed.
  /// Throws std::runtime_error or std::bad_alloc when Embree cannot.
  explicit SphereScene(std::vector<Sphere> spheres);

  /// For rays of the caller's own making. Intersections are Embree's, unfiltered.
  [[nodiscard]] RTCScene handle() const { return scene_.get(); }

  [[nodiscard]] const std::vector<Sphere>& spheres() const { return spheres_; }

  /// Is anything hit between the origin and `distance`?
  ///
  /// @param origin a point outside all spheres, or on the surface of sphere `own`
  /// @param direction unit vector; it must point out of sphere `own`
  /// @param distance length of the ray, infinity for an unbounded one
  /// @param own sphere the ray starts on, or None
  [[nodiscard]] bool occluded(Vec3f origin, Vec3f direction, float distance, unsigned own) const;

private:
  DeviceHandle device_;
  std::vector<Sphere> spheres_;
  SceneHandle scene_;
};
}

#endif
