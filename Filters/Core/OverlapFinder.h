// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OverlapFinder_h
#define po_OverlapFinder_h

#include "Embree.h"
#include "SphereSet.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace po
{
/// The part of a sphere's surface that lies inside one neighbour: directions n with n . axis >
/// cosine.
struct BuriedCap
{
  Vec3d axis;         ///< unit vector from the sphere's centre towards the neighbour's
  double cosine;      ///< cosine of the cap's half angle, in (-1, 1)
  unsigned other = 0; ///< the neighbour
};

/// That of two spheres which are known to cut each other, with the bits that OverlapFinder finds.
[[nodiscard]] BuriedCap capBetween(const SphereSet& spheres, unsigned id, unsigned other);

/// What lies of one sphere's surface inside the others.
struct Overlaps
{
  bool buried = false;         ///< the whole surface lies inside one other sphere
  std::vector<BuriedCap> caps; ///< one for each sphere that cuts the surface
};

/// A sphere near another one.
struct Neighbour
{
  unsigned id;
  float gap; ///< distance of the two surfaces, negative where they overlap

  /// Nearest first; the number decides between equals.
  [[nodiscard]] bool operator<(const Neighbour& other) const
  {
    return gap != other.gap ? gap < other.gap : id < other.id;
  }
};

class SphereBoxes;

/// Finds the spheres that overlap a sphere, or come near it, for any mix of radii.
///
/// Embree's point query looks the neighbours up in a hierarchy of boxes; it does not see sphere
/// points (Embree 3 and 4), so the boxes are a user geometry. Sixteen spheres share a box: the
/// hierarchy takes 5 bytes a sphere, and 4 more where these are in another order than it. The
/// spheres must outlive the finder.
class OverlapFinder
{
public:
  explicit OverlapFinder(const SphereSet& spheres);
  ~OverlapFinder();
  OverlapFinder(const OverlapFinder&) = delete;
  OverlapFinder& operator=(const OverlapFinder&) = delete;

  /// The overlaps of sphere `id`. `result` is passed in to keep its memory.
  /// A sphere that coincides with this one (same centre and radius) buries nothing: both surfaces
  /// are seen.
  void find(unsigned id, Overlaps& result) const;

  /// The spheres whose surface comes within `reach` of that of sphere `id`, nearest first; of many
  /// the `limit` nearest, so that a full result may be incomplete. `result` keeps its memory.
  void findNear(unsigned id, float reach, std::size_t limit, std::vector<Neighbour>& result) const;

  /// Does the surface of any other sphere come within `reach` of that of sphere `id`?
  [[nodiscard]] bool hasNear(unsigned id, float reach) const;
  /// The same for a sphere that is none of these.
  [[nodiscard]] bool hasNear(const Sphere& sphere, float reach) const;

private:
  void addBoxes(const Brick& brick);
  template <typename Specific>
  void search(Specific& query, float reach, RTCPointQueryFunction visit) const;

  const SphereSet* spheres_;
  DeviceHandle device_;
  std::vector<std::unique_ptr<const SphereBoxes>> boxes_; ///< by brick
  std::vector<SceneHandle> scenes_;                       ///< by brick
};
}

#endif
