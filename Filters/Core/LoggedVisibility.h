// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_LoggedVisibility_h
#define po_LoggedVisibility_h

#include "AxisWeights.h"
#include "MaskCode.h"
#include "ScratchFile.h"

#include <tbb/enumerable_thread_specific.h>

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace po
{
/// What the directions of a sweep see of the listed particles, out of core: the masks are written
/// to a temporary file as they come, and are summed when the sweep is over, for a part of the list
/// at a time. The sums have the same bits as in memory.
///
/// A mask takes 2 bytes for each group of texels of which some that face the direction are hidden,
/// and 6 more: at 16 x 16 texels and 144 directions 1.5 kB a particle in a gas, 0.1 where most are
/// buried.
///
/// Threads may call keep() at once. Throws what ScratchFile throws.
class LoggedVisibility
{
public:
  /// @param spheres of the list in its order, by their index in a SweepScene of `size`; some may be
  /// there twice
  /// @param watched of these
  LoggedVisibility(const SweepTexels& texels, const std::vector<unsigned>& spheres,
    std::size_t size, const std::vector<unsigned>& watched);

  /// Writes what a direction of axis `axis` of the block sees of a listed sphere.
  /// @param upward which of the two directions
  /// @param facing the texels that face it; `mask` has no others
  void keep(
    unsigned sphere, std::size_t axis, bool upward, const GroupMask* facing, const GroupMask* mask);

  /// Ends a block of axes, of which keep() told.
  void endBlock(const std::vector<AxisWeights>& axes, std::size_t subset);

  /// How many particles of the list are summed at a time.
  [[nodiscard]] std::size_t placesPerPart() const { return placesPerPart_; }

  /// Sums the masks of the list's places [part * placesPerPart(), ...), in place of those of
  /// another part. The sweep must be over.
  void load(std::size_t part);

  /// [slots] weights of the directions that are seen, of a sphere of the part that is loaded; null
  /// for one that was never seen.
  [[nodiscard]] const float* sums(unsigned sphere) const;
  /// [ErrorSubsets][slots], of a watched sphere of any part that was loaded; null for one that was
  /// never seen.
  [[nodiscard]] const float* subsetSums(unsigned sphere) const;

  /// Bytes of the file.
  [[nodiscard]] std::uint64_t fileSize() const { return file_.size(); }

private:
  static constexpr unsigned NoPlace = ~0u;

  /// Masks of one axis and part, as they are in the file.
  struct Extent
  {
    std::uint64_t position;
    std::uint32_t words;
    std::uint32_t axis;
  };

  /// Masks that a thread has not written yet, of one part.
  struct Buffer
  {
    MaskWords words;
    std::uint32_t axis = 0;
  };

  struct SweptAxis
  {
    AxisWeights weights;
    std::size_t subset;
  };

  struct Subsets
  {
    std::vector<float> sums; ///< [ErrorSubsets][slots]
    bool seen = false;
  };

  void write(std::size_t place, std::uint32_t axis, bool upward, const GroupMask* facing,
    const GroupMask* mask);
  void flush(std::size_t part, Buffer& buffer);
  void beginPart(std::size_t part);
  void addExtents(const Extent* first, const Extent* last);
  void addMasks(const std::uint16_t* words, const Extent& extent, std::size_t firstPlace,
    std::size_t lastPlace);
  void addMask(std::size_t place, const SweptAxis& axis, const GroupMask* mask);
  [[nodiscard]] std::size_t placeInPart(unsigned sphere) const;

  const SweepTexels& texels_;
  std::size_t placesPerPart_;
  std::vector<unsigned> placeOf_; ///< first one of each sphere in the list, or NoPlace
  std::unordered_map<unsigned, std::vector<unsigned>> repeats_; ///< by sphere: in other parts
  std::unordered_map<unsigned, Subsets> subsets_;               ///< by place, of watched ones
  ScratchFile file_;
  std::size_t bufferWords_; ///< that a thread gathers for a part
  tbb::enumerable_thread_specific<std::vector<Buffer>> buffers_; ///< by part
  std::vector<std::vector<Extent>> extents_;                     ///< by part
  std::mutex extentsMutex_;
  std::vector<SweptAxis> axes_;
  std::size_t part_ = 0;                 ///< that is loaded
  std::vector<std::uint8_t> seen_;       ///< flags by place in it
  std::vector<float> sums_;              ///< by place in it, [places][slots]
  std::vector<Subsets*> subsetsOfPlace_; ///< by place in it, null where not watched
};
}

#endif
