// SPDX-License-Identifier: BSD-3-Clause
#include "DirectionSets.h"

#include "Random.h"

#include <algorithm>

namespace po
{
namespace
{
/// Kept sets may have so many slots of all their directions together, of 36 bytes each.
constexpr std::size_t MaximumKeptTexels = std::size_t(1) << 20;
}

std::vector<std::vector<Vec3d>> DirectionSets::lattice(int directions, std::uint64_t seed)
{
  constexpr std::size_t largest = SharedDirections::MaximumSize / 2;
  const std::vector<Vec3d> axes = sweepAxes((directions + 1) / 2, seed);
  std::vector<std::vector<Vec3d>> sets;
  for (std::size_t first = 0; first < axes.size(); first += largest)
  {
    const std::size_t last = std::min(first + largest, axes.size());
    sets.emplace_back(axes.begin() + static_cast<std::ptrdiff_t>(first),
      axes.begin() + static_cast<std::ptrdiff_t>(last));
  }
  return sets;
}

std::vector<std::vector<Vec3d>> DirectionSets::growing(int first, int total, std::uint64_t seed)
{
  std::vector<std::vector<Vec3d>> sets;
  std::uint64_t turn = 0;
  for (int done = 0; done < total; ++turn)
  {
    const int size = std::max(first, done);
    const auto more = lattice(size, turn == 0 ? seed : mixBits(seed + turn));
    sets.insert(sets.end(), more.begin(), more.end());
    done += size;
  }
  return sets;
}

DirectionSets::DirectionSets(const SweepTexels& texels, const Background& background,
  std::uint64_t seed, std::vector<std::vector<Vec3d>> axes, bool smooth)
  : texels_(texels)
  , background_(background)
  , seed_(seed)
  , axes_(std::move(axes))
  , smooth_(smooth)
{
}

std::unique_ptr<DirectionSet> DirectionSets::make(std::size_t index) const
{
  std::size_t first = 0;
  for (std::size_t before = 0; before < index; ++before)
  {
    first += 2 * axes_[before].size();
  }
  SharedDirections directions(
    texels_, background_, axes_[index], first, seed_, static_cast<std::uint32_t>(index));
  OpenSums open = index == 0 ? OpenSums(texels_.slots()) : last_->open;
  open.add(directions);
  const std::size_t all = first + 2 * axes_[index].size();
  return std::make_unique<DirectionSet>(DirectionSet{ std::move(directions), std::move(open),
    smooth_ ? TextureSmoothing(texels_, static_cast<int>(all)) : TextureSmoothing() });
}

const DirectionSet& DirectionSets::get(std::size_t index)
{
  if (index < kept_.size())
  {
    last_ = kept_[index].get();
    return *last_;
  }
  std::unique_ptr<DirectionSet> made = make(index);
  const std::size_t more = 2 * axes_[index].size() * texels_.slots();
  const bool keep =
    index == 0 || (index == kept_.size() && keptTexels_ + more <= MaximumKeptTexels);
  if (keep)
  {
    keptTexels_ += more;
    kept_.push_back(std::move(made));
    last_ = kept_.back().get();
  }
  else
  {
    passing_ = std::move(made);
    last_ = passing_.get();
  }
  return *last_;
}
}
