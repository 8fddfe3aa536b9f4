// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_VisibilityRecords_h
#define po_VisibilityRecords_h

#include "CompactRims.h"
#include "LoggedRims.h"
#include "LoggedVisibility.h"
#include "OcclusionEstimator.h"
#include "RecordMemory.h"
#include "StoredVisibility.h"
#include "SweepScene.h"
#include "SweepTexels.h"
#include "TexelRims.h"
#include "TextureFormula.h"

#include <hwy/cache_control.h>

#include <atomic>
#include <limits>
#include <memory>
#include <memory_resource>
#include <unordered_map>
#include <utility>
#include <vector>

namespace po
{
/// Weights that an open texel gets: what all spheres have in common.
struct OpenWeights
{
  std::vector<float> total;   ///< [slots], summed in the order of the directions
  std::vector<float> subsets; ///< [ErrorSubsets][slots]
};

/// Points in the texels, and what they count for.
struct SweepEpoch
{
  TexelPatterns patterns;
  std::vector<float> weights; ///< of an open point, in the order of TexelPatterns
};

/// The visibility of the listed spheres, in memory that is taken when one is first seen: at 16 x 16
/// texels 1 KiB, 0.25 for it and its neighbours, some hundred bytes more where others overlap it,
/// and 4 KiB more where it is watched. Out of core the visibility is in a file, and what overlaps a
/// sphere takes some dozen bytes.
///
/// Threads may call clearInside() and keep() for different axes at once. All results are
/// independent of their order. Spheres are named by their index in the SweepScene.
class VisibilityRecords
{
public:
  /// What is known of a sphere's surface.
  enum class Surface : std::uint8_t
  {
    Unknown,
    Whole, ///< no part is inside others
    Cut,
    Buried,
    Alone,   ///< open all over, not swept
    Occluder ///< no particle: never looked at, since it only occludes
  };

  /// @param listed flags by sphere: whose visibility is asked for
  /// @param alone flags by sphere: known to be open all over
  /// @param watched the spheres that error bars come from
  /// @param log takes what is seen of the listed spheres, out of core; null: memory does
  VisibilityRecords(const BakeScene& scene, const SweepScene& order, const SweepTexels& texels,
    std::uint64_t seed, const std::vector<std::uint8_t>& listed,
    const std::vector<std::uint8_t>& alone, const std::vector<unsigned>& watched,
    std::unique_ptr<LoggedVisibility> log = nullptr);
  VisibilityRecords(const VisibilityRecords&) = delete;
  VisibilityRecords& operator=(const VisibilityRecords&) = delete;

  /// The points that are looked at now.
  [[nodiscard]] const TexelPatterns& patterns() const { return epochs_[epoch_].patterns; }
  /// All points that were looked at so far.
  [[nodiscard]] const std::vector<SweepEpoch>& epochs() const { return epochs_; }
  [[nodiscard]] const SweepTexels& texels() const { return texels_; }
  [[nodiscard]] const OpenWeights& openWeights() const { return open_; }

  /// Of the SweepScene.
  [[nodiscard]] std::size_t spheres() const { return order_.size(); }
  [[nodiscard]] bool isListed(unsigned sphere) const
  {
    return log_ ? log_->isListed(sphere) : spheres_[sphere].place != NoPlace;
  }

  /// Fetches, while other work goes on, what prefetchRims() needs of a sphere.
  void prefetch(unsigned sphere) const
  {
    if (!log_)
    {
      hwy::Prefetch(&spheres_[sphere]);
    }
    else if (compactRims_)
    {
      compactRims_->prefetchPlace(sphere);
    }
  }

  /// Fetches what clearCovered() needs, if the sphere has been looked at.
  void prefetchRims(unsigned sphere) const;

  /// Fetches sums and rims of a sphere in memory, if there are such, while other work goes on.
  void prefetchResult(unsigned sphere) const;

  /// Tells that a direction of an earlier block has seen a sphere. Not while threads look at any.
  void markSeen(unsigned sphere)
  {
    log_ ? void(wasSeen_[sphere] = 1) : void(spheres_[sphere].wasSeen = true);
  }

  /// Clears the bits of texels that are wholly inside others, of a sphere that was marked as seen;
  /// false if none is left. Fetches what clearInside() needs then.
  bool clearCovered(unsigned sphere, GroupMask* mask);

  /// Fetches what keep() needs of a sphere that was seen before, while other work goes on.
  void prefetchMasks(unsigned sphere, std::size_t axis) const;

  /// Clears the bits of points that lie inside other spheres, for a sphere that is seen, maybe for
  /// the first time; false if none is left.
  bool clearInside(unsigned sphere, std::size_t pattern, GroupMask* mask);

  /// For a sphere that is not known to show anything it is not found out.
  [[nodiscard]] Surface surface(unsigned sphere) const
  {
    return surfaceOf(sphere).load(std::memory_order_relaxed);
  }
  /// Takes what another process has found out. What cuts a sphere is found again, if it is listed
  /// here, or else when that is needed. Threads may call this at once.
  void learn(unsigned sphere, Surface surface);

  /// Keeps what a direction of axis `axis` of the block sees of a sphere, beside what the other
  /// direction does.
  /// @param upward which of the two directions
  /// @param facing the texels that face it
  void keep(
    unsigned sphere, std::size_t axis, bool upward, const GroupMask* facing, const GroupMask* mask);

  /// Adds the weights of a block. Its masks are gone then.
  void addBlock(const std::vector<AxisWeights>& axes, std::size_t subset);

  /// Goes on with new points in the texels, after MostEpochs with the first ones again.
  void nextEpoch();

  /// Ends the sweep: out of core, what cuts the listed spheres goes to a file too. Only the
  /// functions below may be called from now on, and the scene is not needed any more.
  /// @param list the listed spheres, in the order of the list
  void end(const std::vector<unsigned>& list, const std::vector<unsigned>& watched);

  /// Makes known what there is of a place of the list: out of core of a part of it at a time.
  /// @return of how many places from there on that is known; may be more than there are
  std::size_t loadFor(std::size_t place) const;

  /// Gives up the log, and all else: nothing may be called any more.
  [[nodiscard]] std::unique_ptr<LoggedVisibility> takeLog() { return std::move(log_); }

  // Of a listed sphere; out of core it must be in the part that is loaded.

  /// [slots] weights of the directions that are seen; null for a sphere that was never seen.
  [[nodiscard]] const float* sums(unsigned sphere) const;
  /// [ErrorSubsets][slots], of a watched sphere; null for one that was never seen.
  [[nodiscard]] const float* subsetSums(unsigned sphere) const;
  /// What overlaps a sphere that was looked at; null if nothing does. Out of core it is good until
  /// the calling thread's next call of any function, and when the sweep has ended there are those
  /// of spheres that were seen or watched alone.
  [[nodiscard]] const TexelRims* rims(unsigned sphere) const;
  /// The whole surface is known to be inside another sphere.
  [[nodiscard]] bool isBuried(unsigned sphere) const;

  // Of the listed spheres.
  [[nodiscard]] std::uint64_t buried() const;
  [[nodiscard]] std::uint64_t alone() const;

private:
  static constexpr unsigned NoPlace = ~0u;
  /// Points of a texel that rims cross, together: 512.
  static constexpr std::size_t MostEpochs = 16;

  /// In memory: what is looked at together is side by side.
  struct SphereState
  {
    std::atomic<const TexelRims*> rims{ nullptr }; ///< of a cut one
    unsigned place = NoPlace;                      ///< among the listed ones
    std::atomic<Surface> surface{ Surface::Unknown };
    bool wasSeen = false; ///< in an earlier block
  };

  [[nodiscard]] const std::atomic<Surface>& surfaceOf(unsigned sphere) const
  {
    return log_ ? surfaces_[sphere] : spheres_[sphere].surface;
  }
  [[nodiscard]] std::atomic<Surface>& surfaceOf(unsigned sphere)
  {
    return log_ ? surfaces_[sphere] : spheres_[sphere].surface;
  }

  void beginEpoch();
  void keepRims(unsigned sphere, const std::vector<BuriedCap>& caps);
  Surface findSurface(unsigned sphere);
  [[nodiscard]] std::uint64_t countListed(Surface surface) const;
  [[nodiscard]] const TexelRims* findRims(unsigned sphere);
  [[nodiscard]] bool findCompactRims(unsigned sphere);
  [[nodiscard]] bool isAlone(unsigned sphere) const;

  const BakeScene& scene_;
  const SweepScene& order_;
  const SweepTexels& texels_;
  std::uint64_t seed_;
  std::vector<SphereState> spheres_;           ///< empty out of core
  std::vector<std::atomic<Surface>> surfaces_; ///< of the spheres, out of core
  std::vector<std::uint8_t> wasSeen_;          ///< as in SphereState, out of core
  std::vector<SweepEpoch> epochs_;
  std::size_t epoch_ = 0; ///< the present one
  OpenWeights open_;
  RecordMemory memory_;
  std::unique_ptr<StoredVisibility> stored_; ///< null: in the log
  std::unique_ptr<LoggedVisibility> log_;    ///< null: stored
  std::unique_ptr<CompactRims> compactRims_; ///< out of core, until the sweep has ended
  std::unique_ptr<LoggedRims> loggedRims_;   ///< out of core, from then on
  std::unordered_map<unsigned, const TexelRims*> watchedRims_; ///< beside these
  std::pmr::monotonic_buffer_resource watchedMemory_;          ///< of them
};
}

#endif
