// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ThreadSanitizer_parallel_for_h
#define po_ThreadSanitizer_parallel_for_h

// TBB's parallel_for, with what it guarantees told to the thread sanitizer, which cannot see it
// since TBB's library is not instrumented: what happens before the loop is seen by every call of
// the body, and what any call does is seen after the loop. Calls of the body are in no order
// between each other.
//
// All of TBB comes first: its own headers must not see the macro below.
#include_next <tbb/parallel_for.h>

#include <tbb/tbb.h>

#include <sanitizer/tsan_interface.h>

#include <tuple>
#include <utility>

namespace tbb
{
namespace po_tsan
{
/// The two moments of a loop; only their addresses matter.
struct Loop
{
  char begin = 0, end = 0;

  Loop() { __tsan_release(&begin); }
  ~Loop() { __tsan_acquire(&end); }
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;
};

/// Refers to the body where the caller has it: copies of it would be made in TBB's threads, in an
/// order that the sanitizer cannot see.
template <typename Body>
class ToldBody
{
public:
  ToldBody(const Body& body, Loop& loop)
    : body_(&body)
    , loop_(&loop)
  {
  }

  template <typename... Arguments>
  void operator()(Arguments&&... arguments) const
  {
    __tsan_acquire(&loop_->begin);
    struct End
    {
      Loop* loop;
      ~End() { __tsan_release(&loop->end); }
    } end{ loop_ };
    (*body_)(std::forward<Arguments>(arguments)...);
  }

private:
  const Body* body_;
  Loop* loop_;
};

template <typename Range, typename Body>
void parallel_for_that_is_told(const Range& range, const Body& body)
{
  Loop loop;
  tbb::parallel_for(range, ToldBody<Body>(body, loop));
}

template <typename Index, typename Body>
void parallel_for_that_is_told(Index first, Index last, const Body& body)
{
  Loop loop;
  tbb::parallel_for(first, last, ToldBody<Body>(body, loop));
}
}
using po_tsan::parallel_for_that_is_told;
}

#define parallel_for parallel_for_that_is_told

#endif
