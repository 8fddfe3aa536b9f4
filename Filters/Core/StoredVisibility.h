// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_StoredVisibility_h
#define po_StoredVisibility_h

#include "AxisWeights.h"
#include "RecordMemory.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// What the directions of a sweep see of the listed particles, in memory (LoggedVisibility: out of
/// core). Particles are named by their places in the list, where neighbours should follow each
/// other: the masks of a few of them lie side by side, since a direction meets them one soon after
/// another. Sums, the larger part, are only there for particles that were seen.
///
/// Threads may call keep() for different particles or axes at once.
class StoredVisibility
{
public:
  /// @param watched [places] flags of those that have sums by subset too
  /// @param memory that it takes
  StoredVisibility(
    const SweepTexels& texels, std::vector<std::uint8_t> watched, RecordMemory& memory);

  /// Fetches what keep() needs, if it is there, while other work goes on.
  void prefetch(std::size_t place, std::size_t axis) const;

  /// Keeps what a direction of axis `axis` of the block sees, beside what the other direction does.
  void keep(std::size_t place, std::size_t axis, const GroupMask* mask);

  /// Adds the weights of a block. Its masks are gone then.
  void addBlock(const std::vector<AxisWeights>& axes, std::size_t subset);

  /// [slots] weights of the directions that are seen; null where there are none.
  [[nodiscard]] const float* sums(std::size_t place) const;
  /// [ErrorSubsets][slots], of a watched place; null where nothing was seen.
  [[nodiscard]] const float* subsetSums(std::size_t place) const;

private:
  static constexpr std::size_t ChunkPlaces = 4;

  /// Neighbours of which one was seen; their masks [AxesPerBlock][ChunkPlaces][groups] follow in
  /// memory, so that no pointer to them must be waited for. Masks and marks are kept by axis: two
  /// axes never write to the same byte.
  struct alignas(64) Chunk
  {
    std::array<std::array<std::uint8_t, ChunkPlaces>, AxesPerBlock> seen{}; ///< in this block
    std::array<float*, ChunkPlaces> sums{}; ///< [slots], then [ErrorSubsets][slots] where watched

    [[nodiscard]] GroupMask* masks() { return reinterpret_cast<GroupMask*>(this + 1); }
  };

  [[nodiscard]] std::size_t maskAt(std::size_t place, std::size_t axis) const
  {
    return (axis * ChunkPlaces + place % ChunkPlaces) * groups_;
  }
  Chunk& findOrMakeChunk(std::size_t place);
  void addChunk(std::size_t chunk, const std::vector<AxisWeights>& axes, std::size_t subset);
  [[nodiscard]] float* makeSums(bool watched);

  std::size_t groups_;
  std::size_t slots_;
  std::vector<std::uint8_t> watched_; ///< flags by place
  RecordMemory& memory_;
  std::vector<std::atomic<Chunk*>> chunks_; ///< by place / ChunkPlaces
};
}

#endif
