// SPDX-License-Identifier: BSD-3-Clause
#include "DividedSpheres.h"

#include "SharedTiles.h"
#include "SilhouetteRims.h"

#include <algorithm>
#include <iterator>

namespace po
{
std::vector<DepthRange> DividedSpheres::ownRanges() const
{
  return own_.empty() ? std::vector<DepthRange>() : TracedDepth(own_).ranges();
}

void DividedSpheres::appendOwn(const std::vector<int>& tiles, const std::vector<DepthRange>& ranges,
  ProcessGroup::Words& words) const
{
  for (const TracedLayer& layer : own_)
  {
    std::vector<int> seen;
    std::copy_if(tiles.begin(), tiles.end(), std::back_inserter(seen),
      [&](int tile)
      {
        const auto at = static_cast<std::size_t>(tile);
        const DepthRange& range = layer.frame.tiles[at];
        return range.hasGeometry() && range.nearest <= ranges[at].farthest;
      });
    if (!seen.empty())
    {
      appendTiles(layer, seen, process_, words);
    }
  }
}

void DividedSpheres::assemble(const ProcessGroup::Words& words, std::vector<DepthRange> ranges)
{
  all_.assemble(camera_, words, std::move(ranges));
}

void DividedSpheres::findLines(const SilhouetteRule& rule, SilhouetteImage& image) const
{
  findTracedSilhouettes(all_, rule, image, { true, true });
}
}
