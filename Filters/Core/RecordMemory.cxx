// SPDX-License-Identifier: BSD-3-Clause
#include "RecordMemory.h"

#include <algorithm>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace po
{
void* HugePageResource::do_allocate(std::size_t bytes, std::size_t alignment)
{
  const std::size_t size = (bytes + PageSize - 1) / PageSize * PageSize;
  void* memory = ::operator new(size, std::align_val_t(std::max(alignment, PageSize)));
#ifdef __linux__
  // A wish: without huge pages all is the same, but slower.
  madvise(memory, size, MADV_HUGEPAGE);
#endif
  return memory;
}

void HugePageResource::do_deallocate(void* memory, std::size_t, std::size_t alignment)
{
  ::operator delete(memory, std::align_val_t(std::max(alignment, PageSize)));
}
}
