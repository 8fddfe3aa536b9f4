// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ArrivedTiles_h
#define po_ArrivedTiles_h

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace po
{
/// Sorts what processes have sent by its member `tile`, in the order of processes where that is the
/// same, and calls f(first, last) for what is of one tile, in parallel.
template <typename Arrived, typename Function>
void forEachTileOf(std::vector<Arrived>& arrived, const Function& f)
{
  std::stable_sort(arrived.begin(), arrived.end(),
    [](const Arrived& a, const Arrived& b) { return a.tile < b.tile; });
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < arrived.size(); ++i)
  {
    if (i == 0 || arrived[i].tile != arrived[i - 1].tile)
    {
      starts.push_back(i);
    }
  }
  starts.push_back(arrived.size());
  tbb::parallel_for(std::size_t(1), starts.size(),
    [&](std::size_t i) { f(&arrived[starts[i - 1]], arrived.data() + starts[i]); });
}
}

#endif
