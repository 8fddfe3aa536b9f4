// SPDX-License-Identifier: BSD-3-Clause
#include "DepthSource.h"

namespace po
{
double depthSpread(const std::vector<DepthRange>& ranges)
{
  std::vector<double> depths;
  for (const DepthRange& range : ranges)
  {
    if (range.hasGeometry())
    {
      depths.push_back(range.nearest);
      depths.push_back(range.farthest);
    }
  }
  if (depths.empty())
  {
    return 0;
  }
  const auto quantile = [&](std::size_t percent)
  {
    const auto at =
      depths.begin() + static_cast<std::ptrdiff_t>((depths.size() - 1) * percent / 100);
    std::nth_element(depths.begin(), at, depths.end());
    return *at;
  };
  const double low = quantile(5);
  return quantile(95) - low;
}
}
