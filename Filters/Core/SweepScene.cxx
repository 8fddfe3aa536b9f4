// SPDX-License-Identifier: BSD-3-Clause
#include "SweepScene.h"

#include "SweepOrder.h"

#include <algorithm>

namespace po
{
SweepScene::SweepScene(const SphereSet& set)
  : set_(set)
{
  if (set.size() == 0)
  {
    return;
  }
  const SweepOrder order(set);
  if (!takeAsTheyAre(order))
  {
    takeInOrder(order);
  }
  std::for_each(bands_.begin(), bands_.end(), [this](Band& band) { addBlocks(band); });
}

/// False where the set has another order, or repetitions.
bool SweepScene::takeAsTheyAre(const SweepOrder& order)
{
  SweepOrder::Place last = order.placeOf(0);
  for (unsigned index = 0; index < set_.size(); ++index)
  {
    const SweepOrder::Place place = order.placeOf(index);
    if (index > 0 && (!order.isBefore(last, place) || order.areEqual(index - 1, index)))
    {
      bands_.clear();
      return false;
    }
    addToBands(index, index == 0 || place.band != last.band || place.brick != last.brick);
    last = place;
  }
  spheres_ = set_.spheres().data();
  size_ = set_.size();
  return true;
}

void SweepScene::takeInOrder(const SweepOrder& order)
{
  const std::vector<SweepOrder::Place> places = order.sorted();
  indexOf_.resize(places.size());
  source_.reserve(places.size());
  ordered_.reserve(places.size());
  for (unsigned i = 0; i < places.size(); ++i)
  {
    const SweepOrder::Place& place = places[i];
    if (i == 0 || !order.areEqual(places[i - 1].source, place.source))
    {
      source_.push_back(place.source);
      ordered_.push_back(set_.spheres()[place.source]);
      const bool begins =
        i == 0 || place.band != places[i - 1].band || place.brick != places[i - 1].brick;
      addToBands(static_cast<unsigned>(ordered_.size() - 1), begins);
    }
    indexOf_[place.source] = static_cast<unsigned>(ordered_.size() - 1);
  }
  spheres_ = ordered_.data();
  size_ = ordered_.size();
}

/// @param begins a new band
void SweepScene::addToBands(unsigned index, bool begins)
{
  const float radius = set_.spheres()[source(index)].radius;
  if (begins)
  {
    const Brick& brick = set_.bricks()[set_.brickOf(source(index))];
    bands_.push_back({ index, index, radius, radius, brick.origin, 0, 0 });
  }
  Band& band = bands_.back();
  band.last = index + 1;
  band.smallestRadius = std::min(band.smallestRadius, radius);
  band.largestRadius = std::max(band.largestRadius, radius);
}

void SweepScene::addBlocks(Band& band)
{
  band.firstBlock = static_cast<unsigned>(blocks_.size());
  for (unsigned first = band.first; first < band.last; first += BlockSize)
  {
    blocks_.push_back(makeBlock(first, std::min(first + BlockSize, band.last)));
  }
  band.lastBlock = static_cast<unsigned>(blocks_.size());
}

SweepScene::Block SweepScene::makeBlock(unsigned first, unsigned last) const
{
  Vec3d low = center(first);
  Vec3d high = low;
  float radius = 0;
  for (unsigned i = first; i < last; ++i)
  {
    const Vec3d c = center(i);
    low = { std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z) };
    high = { std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z) };
    radius = std::max(radius, sphere(i).radius);
  }
  const Vec3d half = 0.5 * (1 + 1e-6) * (high - low);
  return { first, last, 0.5 * (low + high), half.as<float>(), static_cast<float>(length(half)),
    radius };
}

std::vector<unsigned> SweepScene::indicesOf(std::vector<unsigned> sources) const
{
  std::transform(sources.begin(), sources.end(), sources.begin(),
    [this](unsigned source) { return indexOf(source); });
  return sources;
}

std::vector<std::uint8_t> SweepScene::flagsOf(const std::vector<unsigned>& sources) const
{
  std::vector<std::uint8_t> flags(size(), 0);
  for (const unsigned source : sources)
  {
    flags[indexOf(source)] = 1;
  }
  return flags;
}
}
