// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ForEachHit_h
#define po_ForEachHit_h

#include "FrameTracer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace po
{
/// Calls f(x, y, pixel) for all pixels that show a sphere, rows in parallel.
template <typename Function>
void forEachHit(const TracedFrame& frame, const Function& f)
{
  tbb::parallel_for(tbb::blocked_range<int>(0, frame.height),
    [&](const tbb::blocked_range<int>& rows)
    {
      for (int y = rows.begin(); y < rows.end(); ++y)
      {
        std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width);
        for (int x = 0; x < frame.width; ++x, ++pixel)
        {
          if (frame.sphere[pixel] != SphereScene::None)
          {
            f(x, y, pixel);
          }
        }
      }
    });
}

}

#endif
