// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ForEachHit_h
#define po_ForEachHit_h

#include "ForEachTile.h"
#include "FrameTracer.h"

namespace po
{
/// Calls f(x, y, pixel) for all pixels that show a sphere, tiles in parallel.
template <typename Function>
void forEachHit(const TracedFrame& frame, const Function& f)
{
  forEachTile(frame.width, frame.height,
    [&](const PixelRange& tile)
    {
      for (int y = tile.y0; y < tile.y1; ++y)
      {
        const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width);
        for (int x = tile.x0; x < tile.x1; ++x)
        {
          const std::size_t pixel = row + static_cast<std::size_t>(x);
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
