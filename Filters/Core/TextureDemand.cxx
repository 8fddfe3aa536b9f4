// SPDX-License-Identifier: BSD-3-Clause
#include "TextureDemand.h"

#include "FrameTracer.h"
#include "OcclusionTextures.h"

#include <algorithm>
#include <tuple>

namespace po
{
const std::vector<std::int32_t>& TextureDemand::of(const TracedFrame& frame,
  const std::vector<std::int64_t>& particles, const OcclusionTextures& textures,
  std::size_t textureCount)
{
  placeOf_.resize(textureCount, 0);
  seen_.clear();
  count(frame, particles, textures);
  std::sort(seen_.begin(), seen_.end(),
    [](const Seen& a, const Seen& b)
    { return std::tuple(b.pixels, a.row) < std::tuple(a.pixels, b.row); });
  rows_.resize(seen_.size());
  std::transform(
    seen_.begin(), seen_.end(), rows_.begin(), [](const Seen& seen) { return seen.row; });
  return rows_;
}

/// Neighbouring pixels mostly show the same sphere: they are counted together.
void TextureDemand::count(const TracedFrame& frame, const std::vector<std::int64_t>& particles,
  const OcclusionTextures& textures)
{
  const std::vector<std::uint32_t>& spheres = frame.sphere;
  for (std::size_t first = 0, end = 0; first < spheres.size(); first = end)
  {
    const std::uint32_t sphere = spheres[first];
    for (end = first + 1; end < spheres.size() && spheres[end] == sphere;)
    {
      ++end;
    }
    const std::int32_t row = sphere == SphereScene::None ? -1 : textures.rowOf(particles[sphere]);
    if (row >= 0)
    {
      entryOf(row).pixels += static_cast<std::uint32_t>(end - first);
    }
  }
}

/// Places of an earlier frame tell themselves by pointing to another row: nothing is cleared.
TextureDemand::Seen& TextureDemand::entryOf(std::int32_t row)
{
  std::uint32_t& place = placeOf_[static_cast<std::size_t>(row)];
  if (place >= seen_.size() || seen_[place].row != row)
  {
    place = static_cast<std::uint32_t>(seen_.size());
    seen_.push_back({ row, 0 });
  }
  return seen_[place];
}
}
