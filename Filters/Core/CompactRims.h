// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_CompactRims_h
#define po_CompactRims_h

#include "OverlapFinder.h"
#include "SweepTexels.h"
#include "TexelRims.h"

#include <hwy/cache_control.h>
#include <tbb/enumerable_thread_specific.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace po
{
/// TexelRims of the spheres of a sweep in a quarter of the memory, for bakes out of core: caps are
/// kept as the numbers of the spheres that cut them off, and made again, with the same bits, when
/// they are looked at.
///
/// Threads may call all functions at once.
class CompactRims
{
public:
  /// @param set whose spheres overlap
  /// @param spheres how many may be listed. All must outlive this.
  CompactRims(const SphereSet& set, const SweepTexels& texels, std::size_t spheres);

  /// Keeps what the caps of a sphere cut, unless that was done.
  /// @param source its number in the set
  void keep(unsigned sphere, unsigned source, const std::vector<BuriedCap>& caps);

  [[nodiscard]] bool isListed(unsigned sphere) const { return codeOf(sphere) != None; }

  /// Fetches, while other work goes on, what prefetch() needs.
  void prefetchPlace(unsigned sphere) const { hwy::Prefetch(&codes_[sphere]); }

  /// Fetches what is kept of a sphere while other work goes on.
  void prefetch(unsigned sphere) const;

  /// Clears the bits of texels that are wholly inside, of a listed sphere; false if none is left.
  bool clearCovered(unsigned sphere, GroupMask* mask) const;

  /// The same as clearInside() of TexelCaps.h, of a listed sphere.
  bool clearInside(unsigned sphere, unsigned source, const TexelPatterns& patterns,
    std::size_t pattern, GroupMask* mask) const;

  /// All of a sphere; null if it is not listed. Good until the calling thread's next call of any
  /// function.
  [[nodiscard]] const TexelRims* find(unsigned sphere, unsigned source) const;

private:
  /// Where the bytes of a sphere begin: the chunk, and how many times four bytes from its start.
  using Code = std::uint32_t;
  static constexpr Code None = 0; ///< there is no chunk 0
  static constexpr unsigned ChunkShift = 16;
  static constexpr Code MostChunks = Code(1) << 15;
  static constexpr std::size_t Unit = 4;
  static constexpr std::size_t ChunkBytes = Unit << ChunkShift;

  /// What a thread has left of its chunk.
  struct Room
  {
    Code next = 0;
    std::size_t left = 0; ///< units
  };

  [[nodiscard]] Code codeOf(unsigned sphere) const
  {
    return codes_[sphere].load(std::memory_order_acquire);
  }
  [[nodiscard]] const std::uint8_t* bytesOf(Code code) const;
  [[nodiscard]] const TexelRims& read(Code code, unsigned source, const GroupMask* mask) const;
  [[nodiscard]] Code store(const std::vector<std::uint8_t>& bytes);
  [[nodiscard]] Code addChunk(std::size_t bytes);

  const SphereSet& set_;
  const SweepTexels& texels_;
  std::vector<std::atomic<Code>> codes_;                ///< by sphere
  std::vector<std::unique_ptr<std::uint8_t[]>> chunks_; ///< room for all of them: never moved
  Code usedChunks_ = 1;
  std::mutex chunksMutex_;
  tbb::enumerable_thread_specific<Room> rooms_;
};
}

#endif
