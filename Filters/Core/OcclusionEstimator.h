// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OcclusionEstimator_h
#define po_OcclusionEstimator_h

#include "BakeSettings.h"
#include "OccluderMesh.h"
#include "OverlapFinder.h"
#include "ProcessGroup.h"
#include "Progress.h"
#include "SphereCloud.h"
#include "SphereScene.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace po
{
/// What a bake works on; all lengths local (see SphereCloud).
///
/// Spheres are numbered through: first the particles, which receive, then the occluders' spheres,
/// which only cast. Light stops at both, and both bury what lies inside of them.
///
/// Where several processes bake together, each has a scene of all particles that matter to its own,
/// and lists its own when it asks an estimator.
class BakeScene
{
public:
  explicit BakeScene(SphereCloud cloud, const Occluders& occluders = {},
    const ProcessGroup& group = ProcessGroup::alone());

  /// Number of particles; also the number of the first sphere that is none.
  [[nodiscard]] std::size_t receivers() const { return receivers_; }

  /// A number that stands for a particle in the choice of random numbers. It depends on its
  /// id alone, or without ids on its sphere: a particle keeps its noise, whatever it is read after
  /// and whoever bakes it.
  [[nodiscard]] std::uint64_t randomKey(unsigned particle) const;

  [[nodiscard]] const SphereSet& set() const { return *set_; } ///< all spheres
  [[nodiscard]] bool hasMesh() const { return hasMesh_; }      ///< are there triangles?

  /// Builds what rays() returns, if that was not done yet; before threads of the caller's begin. A
  /// bake without rays does without its memory. Throws what SphereScene throws.
  void prepareRays() const;
  /// All spheres, and the triangles, once they are prepared; with triangles they always are.
  [[nodiscard]] const SphereScene& rays() const { return *rays_; }

private:
  std::size_t receivers_;
  std::shared_ptr<const SphereSet> set_;
  bool hasMesh_;
  mutable std::unique_ptr<const SphereScene> rays_;

public:
  const SphereCloud cloud;   ///< the particles' frame and ids; the set has their spheres
  OverlapFinder overlaps;    ///< of all spheres
  const ProcessGroup& group; ///< who bakes together
};

/// What was done and what could be skipped.
struct BakeCounters
{
  std::uint64_t particles = 0;        ///< particles baked
  std::uint64_t texels = 0;           ///< their texels
  std::uint64_t rays = 0;             ///< occlusion rays traced
  std::uint64_t samplesInside = 0;    ///< samples inside another sphere: no ray, no weight
  std::uint64_t texelsInside = 0;     ///< texels wholly inside another sphere: not sampled at all
  std::uint64_t particlesBuried = 0;  ///< particles inside one other sphere: not looked at further
  std::uint64_t particlesAlone = 0;   ///< sweep: nothing within the bounded distance, so open
  std::uint64_t particlesDark = 0;    ///< particles that no light reaches
  std::uint64_t texturesStored = 0;   ///< rows of the table
  std::uint64_t spheresClosed = 0;    ///< sweep: visits spared by closed cells
  std::uint64_t spheresNeverSeen = 0; ///< sweep: visits spared as no direction had shown the sphere
  std::uint64_t directionsBlack = 0;  ///< not looked along: the background is black there
  unsigned threads = 0;               ///< threads that took part

  void add(const BakeCounters& other);

  /// Of all processes. A direction that is black is so for all of them.
  [[nodiscard]] BakeCounters summed(const ProcessGroup& group) const;
};

/// Textures of consecutive particles as an estimator finds them, before dilation and encoding.
struct RawTextures
{
  std::size_t firstParticle;  ///< index in the cloud
  std::size_t count;          ///< number of particles
  const float* values;        ///< count * T * T linear values; 0 where the outside share is 0
  const float* outsideShares; ///< count * T * T shares of the texel's area outside other spheres
};

/// One way of finding the visibility of the background from every texel.
class OcclusionEstimator
{
public:
  using Sink = std::function<void(const RawTextures&)>;

  virtual ~OcclusionEstimator() = default;

  /// Estimates the listed particles, occluded by all there is, and hands them to `sink` in the
  /// order of the list, on the calling thread. Returns early when `progress` says so; what was
  /// handed out is then incomplete.
  virtual void estimate(const BakeScene& scene, const std::vector<unsigned>& particles,
    const BakeSettings& settings, Progress& progress, const Sink& sink,
    BakeCounters& counters) const = 0;

  /// RMS error of linear visibility of the last estimate, up to three times too large; 0 if not
  /// known.
  [[nodiscard]] virtual double estimatedError() const { return 0; }

  /// Upper bound of the working memory, in bytes a texel of all particles.
  [[nodiscard]] virtual double bytesPerTexel() const = 0;
};
}

#endif
