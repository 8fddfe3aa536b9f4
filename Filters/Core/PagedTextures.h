// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_PagedTextures_h
#define po_PagedTextures_h

#include "TextureLoader.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace po
{
/// Keeps those textures of a source in memory that pictures show, within a budget.
///
/// Whoever draws asks for the textures of a view, collects what has arrived, and looks textures up.
/// A thread reads what is asked for in the meantime; nobody waits for it but in wait(). A texture
/// that was asked for since the view began stays until the next view begins; others make room for
/// those that are needed, the least recently used first. So what is shown in the end depends on the
/// view and the budget alone: where the budget is too small for the view, those textures that were
/// asked for first are there.
///
/// For one thread, but for find(), which any number of threads may call between the other calls.
class PagedTextures
{
public:
  /// @param textures number of textures in the source, less than 2^31
  /// @param textureBytes what the source stores for each of them, in bytes
  /// @param budget bytes that textures may take, with 16 bytes of book-keeping for each. The index,
  /// 4 bytes for each texture of the source, is extra.
  /// Throws std::system_error where no thread can be started.
  PagedTextures(std::shared_ptr<const TextureSource> source, std::size_t textures,
    std::size_t textureBytes, std::size_t budget);

  /// Number of textures in the source.
  [[nodiscard]] std::size_t size() const { return slotOf_.size(); }

  /// Textures that the budget holds.
  [[nodiscard]] std::size_t capacity() const { return capacity_; }

  /// Another view begins: what has arrived is collected, and nothing else is needed any more.
  void beginView();

  /// Asks for textures of the view, the most important first. Those that are in memory count as
  /// used now; the others are read, as far as there is room beside what the view has asked for.
  /// @return how many of them are not in memory
  std::size_t demand(const std::vector<std::int32_t>& rows);

  /// Makes what has been read available to find().
  /// @return number of textures
  std::size_t collect();

  /// Waits until all that can come has come, and collects it.
  void wait();

  /// Is there anything that was asked for and has not been collected, nor failed?
  [[nodiscard]] bool isLoading() const { return loading_ > 0; }

  /// Would collect() change anything?
  [[nodiscard]] bool hasNews() const { return isLoading() && loader_.hasNews(); }

  /// The texels of a texture, or null if it is not in memory.
  [[nodiscard]] const void* find(std::int32_t row) const
  {
    const std::int32_t slot = slotOf_[static_cast<std::size_t>(row)];
    return slot < 0 ? nullptr : texelsOf(slot);
  }

  /// Textures in memory.
  [[nodiscard]] std::size_t resident() const { return used_ - loading_; }

  /// What they and those that are being read take; never above the budget.
  [[nodiscard]] std::size_t bytes() const { return used_ * slotBytes(); }

  /// Why nothing is read any more; empty while all is well. What is in memory stays.
  [[nodiscard]] std::string error() const { return loader_.error(); }

private:
  static constexpr std::int32_t None = -1; ///< no slot
  static constexpr std::size_t ChunkSlots = 1024;

  /// A place for a texture. Those whose textures have arrived form a list by their last use.
  struct Slot
  {
    std::int32_t row = None;
    std::int32_t newer = None, older = None;
    std::uint32_t view = 0; ///< that asked for it last
  };

  [[nodiscard]] std::size_t slotBytes() const { return textureBytes_ + sizeof(Slot); }
  [[nodiscard]] std::byte* texelsOf(std::int32_t slot) const
  {
    const auto i = static_cast<std::size_t>(slot);
    return chunks_[i / ChunkSlots].get() + i % ChunkSlots * textureBytes_;
  }

  /// Slots of textures that are being read are kept in the index as negative numbers below None.
  [[nodiscard]] static std::int32_t asLoading(std::int32_t slot) { return -2 - slot; }

  [[nodiscard]] std::int32_t takeSlot();
  void addSlot();
  void evict();
  void release(std::int32_t slot);
  void releaseLoading(const std::vector<TextureLoad>& loads);
  void giveUp();
  void link(std::int32_t slot);
  void unlink(std::int32_t slot);

  std::size_t textureBytes_;
  std::size_t capacity_;
  std::vector<std::int32_t> slotOf_;                 ///< of each texture: None, loading, or a slot
  std::vector<std::unique_ptr<std::byte[]>> chunks_; ///< texels of ChunkSlots slots each
  std::deque<Slot> slots_;
  std::vector<std::int32_t> free_;
  std::int32_t newest_ = None, oldest_ = None;
  std::size_t used_ = 0, loading_ = 0;
  std::uint32_t view_ = 0;
  TextureLoader loader_; ///< the last member: it writes to the others' memory
};
}

#endif
