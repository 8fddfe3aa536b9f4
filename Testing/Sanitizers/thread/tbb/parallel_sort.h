// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ThreadSanitizer_parallel_sort_h
#define po_ThreadSanitizer_parallel_sort_h

// The threads of TBB's sort swap elements in an order that the thread sanitizer cannot see, and run
// none of the project's code but comparisons: under this sanitizer one thread sorts.
#include <algorithm>

namespace tbb
{
template <typename Iterator>
void sort_by_one_thread(Iterator first, Iterator last)
{
  std::sort(first, last);
}

template <typename Iterator, typename Compare>
void sort_by_one_thread(Iterator first, Iterator last, const Compare& compare)
{
  std::sort(first, last, compare);
}
}

#include "parallel_for.h" // includes TBB's own parallel_sort before the macro

#define parallel_sort sort_by_one_thread

#endif
