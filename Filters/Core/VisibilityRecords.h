// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_VisibilityRecords_h
#define po_VisibilityRecords_h

#include "OcclusionEstimator.h"
#include "SweepTexels.h"
#include "TexelExposure.h"

#include <tbb/concurrent_vector.h>

#include <array>
#include <atomic>
#include <memory>
#include <vector>

namespace po
{
/// Directions are swept in blocks of this many: in parallel, their masks kept, then summed in
/// order.
inline constexpr std::size_t SweepBlock = 16;

/// Interleaved subsets of directions whose spread is the error bar.
inline constexpr std::size_t SweepSubsets = 4;

/// What a sweep has found about one particle.
struct VisibilityRecord
{
  unsigned particle;
  bool buried = false;
  bool watched = false; ///< its subsets are summed too
  std::vector<BuriedCap> caps;
  TexelExposure exposure;                      ///< empty where every point is outside
  std::vector<float> sums;                     ///< [slots] weights of the directions that are seen
  std::vector<float> pastWeights;              ///< [slots] of exposed points, of ended epochs
  std::vector<GroupMask> masks;                ///< [SweepBlock][groups] of the block at hand
  std::array<std::uint8_t, SweepBlock> seen{}; ///< which of these masks are filled
  std::vector<float> subsetSums;               ///< [SweepSubsets][slots] if watched
};

/// Weights that an open texel gets: what all records have in common.
struct OpenWeights
{
  std::vector<float> total;          ///< [slots], summed in the order of the directions
  std::vector<float> subsets;        ///< [SweepSubsets][slots]
  std::vector<float> pastPatterns;   ///< [patterns][slots], ended epochs
  std::vector<float> latestPatterns; ///< [patterns][slots], this epoch
};

/// The visibility of particles, in memory that is taken when a particle is first seen: at 16 x 16
/// texels 1.7 KiB a visible particle and 3 KiB more where others overlap it.
///
/// Threads may call expose() and keep() for different directions at once. All results are
/// independent of their order.
class VisibilityRecords
{
public:
  /// @param listed flags by particle: whose visibility is asked for; others only occlude
  /// @param watched the particles that error bars come from
  VisibilityRecords(const BakeScene& scene, const SweepTexels& texels, std::uint64_t seed,
    std::vector<std::uint8_t> listed, const std::vector<unsigned>& watched);
  ~VisibilityRecords();
  VisibilityRecords(const VisibilityRecords&) = delete;
  VisibilityRecords& operator=(const VisibilityRecords&) = delete;

  [[nodiscard]] const TexelPatterns& patterns() const { return patterns_; }
  [[nodiscard]] const SweepTexels& texels() const { return texels_; }
  [[nodiscard]] const OpenWeights& openWeights() const { return open_; }

  /// Clears the bits of points that lie inside other spheres, for a particle that is seen, maybe
  /// for the first time; false if none is left.
  bool clearInside(
    unsigned particle, std::size_t pattern, const FacingTexels& facing, GroupMask* mask);

  /// Keeps what direction `index` of the block sees of a particle.
  void keep(
    unsigned particle, std::size_t index, const FacingTexels& facing, const GroupMask* mask);

  /// Adds the weights of a block.
  void addBlock(const std::vector<FacingTexels>& directions,
    const std::vector<std::size_t>& patterns, std::size_t subset);

  /// Goes on with new points in the texels.
  void nextEpoch();

  /// The record of a particle, null if it was never seen.
  [[nodiscard]] const VisibilityRecord* find(unsigned particle) const
  {
    return records_[particle].load(std::memory_order_acquire);
  }

  /// The weights of the points of a particle that are outside, [slots]: what an open texel sums to.
  [[nodiscard]] std::vector<float> outsideWeights(const VisibilityRecord& record) const;

  [[nodiscard]] std::uint64_t buried() const;

private:
  VisibilityRecord& findOrMake(unsigned particle);
  [[nodiscard]] std::unique_ptr<VisibilityRecord> make(unsigned particle) const;
  void addMasks(VisibilityRecord& record, const std::vector<FacingTexels>& directions,
    std::size_t subset) const;
  void addPatternWeights(const VisibilityRecord& record, const std::vector<float>& patternWeights,
    std::vector<float>& sums) const;

  const BakeScene& scene_;
  const SweepTexels& texels_;
  std::uint64_t seed_;
  std::uint32_t epoch_ = 0;
  TexelPatterns patterns_;
  OpenWeights open_;
  std::vector<std::uint8_t> listed_; ///< 1: listed, 2: watched too
  std::vector<std::atomic<VisibilityRecord*>> records_;
  /// 1 for particles that are known to have no part inside others: their records, which are far
  /// apart in memory, need not be read.
  std::vector<std::atomic<std::uint8_t>> whole_;
  tbb::concurrent_vector<std::unique_ptr<VisibilityRecord>> owned_;
};
}

#endif
