// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RecordMemory_h
#define po_RecordMemory_h

#include <tbb/enumerable_thread_specific.h>

#include <cstddef>
#include <memory_resource>

namespace po
{
/// Pieces of whole huge pages, where the system has such. Particles are visited in the order of
/// their depth: with pages of 4 KiB nearly every visit has to look up where its page is.
class HugePageResource : public std::pmr::memory_resource
{
public:
  static constexpr std::size_t PageSize = std::size_t(2) << 20;

private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override;
  void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override;
  [[nodiscard]] bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override
  {
    return this == &other;
  }
};

/// Memory for many small arrays, given back all at once. Threads take theirs side by side.
class RecordMemory
{
public:
  RecordMemory()
    : pools_(HugePageResource::PageSize, &pages_)
  {
  }
  RecordMemory(const RecordMemory&) = delete;
  RecordMemory& operator=(const RecordMemory&) = delete;

  /// Of the calling thread: others must not allocate from it.
  [[nodiscard]] std::pmr::memory_resource* ofThread() { return &pools_.local(); }

  /// Elements are not initialised.
  template <typename T>
  [[nodiscard]] T* allocate(std::size_t count)
  {
    return static_cast<T*>(ofThread()->allocate(count * sizeof(T), alignof(T)));
  }

private:
  HugePageResource pages_;
  tbb::enumerable_thread_specific<std::pmr::monotonic_buffer_resource> pools_;
};
}

#endif
