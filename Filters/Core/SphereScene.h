// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereScene_h
#define po_SphereScene_h

#include "Embree.h"
#include "OccluderMesh.h"
#include "SphereSet.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace po
{
/// Spheres, and maybe triangles, in an Embree scene, with occlusion tests that need no epsilon.
///
/// Rays from a sphere's surface begin just so far off it that Embree cannot report it, computed for
/// each ray (see rayStart()). What lies between is met all the same, from its far side, but for
/// chords shorter than that: a few millionths of the radius as a rule.
///
/// Where that would be too far a filter looks at the hits instead. A point outside (or on) a sphere
/// can only see it where the sphere's centre lies ahead of the ray: the ray's nearest approach to
/// the centre is then at t > 0. The filter keeps only such hits, so rounding at the start of a ray
/// can hit neither the sphere it starts on nor one that it touches. The two ways tell apart at most
/// the rays from points that lie inside another sphere by rounding alone.
///
/// Both ask that the origin lies outside all spheres; samples inside another sphere must be sorted
/// out before (see OverlapFinder).
///
/// Triangles stop occlusion rays from both sides. They need no such rule: a ray starts on a sphere,
/// so on a triangle only by chance, and a triangle that cuts through the sphere is met by the rays
/// that leave towards it, from whichever side they start. They have no far side either: beside them
/// all rays begin on the surface, with the filter.
class SphereScene
{
public:
  static constexpr unsigned None = std::numeric_limits<unsigned>::max();

  /// Embree's geometry ids.
  static constexpr unsigned SphereGeometry = 0;
  static constexpr unsigned TriangleGeometry = 1;

  /// Builds the acceleration structure in parallel. An empty scene is allowed. The mesh is copied.
  /// Throws std::runtime_error or std::bad_alloc when Embree cannot.
  explicit SphereScene(std::shared_ptr<const SphereSet> set, const OccluderMesh& mesh = {});
  explicit SphereScene(SphereSet set, const OccluderMesh& mesh = {})
    : SphereScene(std::make_shared<const SphereSet>(std::move(set)), mesh)
  {
  }
  explicit SphereScene(std::vector<Sphere> spheres, const OccluderMesh& mesh = {})
    : SphereScene(SphereSet(std::move(spheres)), mesh)
  {
  }

  /// For rays of the caller's own making, relative to the origin of a brick of the set, with
  /// filters of single queries or none. In a scene with a mesh and one brick, hits on triangles
  /// have the geometry id TriangleGeometry.
  [[nodiscard]] RTCScene handle(std::size_t brick = 0) const { return scenes_[brick].get(); }

  [[nodiscard]] const SphereSet& set() const { return *set_; }
  [[nodiscard]] const std::vector<Sphere>& spheres() const { return set_->spheres(); }
  [[nodiscard]] bool hasMesh() const { return hasMesh_; }

  /// Nothing but spheres, in one brick.
  [[nodiscard]] bool isPlain() const { return !hasMesh_ && scenes_.size() == 1; }

  /// Is anything hit between the origin and `distance`?
  ///
  /// @param origin a point outside all spheres, or on the surface of sphere `own`; relative to the
  /// origin of the brick of `own`, if there is one, else to that of the set
  /// @param direction unit vector; it must point out of sphere `own`
  /// @param distance length of the ray, infinity for an unbounded one
  /// @param own sphere the ray starts on, or None
  /// @param hidden of each sphere: not 0 if the ray passes it; null: it passes none
  [[nodiscard]] bool occluded(Vec3f origin, Vec3f direction, float distance, unsigned own,
    const std::uint8_t* hidden = nullptr) const;

  /// Rays that occludedFrom() traces at once.
  static constexpr unsigned PacketSize = 16;

  /// The same for `count` parallel rays, 1 to PacketSize, from neighbouring points of one sphere.
  /// @return bit i tells of the ray from origins[i]
  [[nodiscard]] unsigned occludedFrom(
    const Vec3f* origins, unsigned count, Vec3f direction, float distance, unsigned own) const;

  /// Does any triangle come within `reach` of a point?
  [[nodiscard]] bool isMeshWithin(Vec3f point, float reach) const;

private:
  /// As many parallel rays as occludedFrom() traces, relative to a brick.
  struct Rays
  {
    const Vec3f* origins;
    unsigned count;
    Vec3f direction;
    float distance;
    unsigned own;
    const std::uint8_t* hidden;
    std::array<float, PacketSize> starts; ///< where they begin
    RTCFilterFunctionN filter;            ///< of hits, or null
  };

  void addSpheres(RTCScene scene, const Brick& brick);
  void addTriangles(RTCScene scene, const OccluderMesh& mesh);
  void chooseStarts(Rays& rays) const;
  [[nodiscard]] unsigned traceAll(const Rays& rays) const;
  [[nodiscard]] unsigned trace(RTCScene scene, const Rays& rays) const;
  [[nodiscard]] unsigned traceSingly(RTCScene scene, const Rays& rays) const;
  [[nodiscard]] unsigned tracePacket(RTCScene scene, const Rays& rays) const;
  [[nodiscard]] unsigned traceBricks(const Rays& rays) const;

  DeviceHandle device_;
  std::shared_ptr<const SphereSet> set_;
  bool hasMesh_;
  std::vector<SceneHandle> scenes_; ///< by brick; the only one holds the triangles too
  SceneHandle mesh_;                ///< the triangles beside several bricks, or null
};
}

#endif
