// SPDX-License-Identifier: BSD-3-Clause
#include "TileFiller.h"

#include <hwy/base.h>

namespace po
{
namespace
{
/// Calls action(place) for the bits that are set.
template <typename Action>
void forEachBit(BlockBits bits, const Action& action)
{
  for (; bits != 0; bits &= bits - 1)
  {
    action(static_cast<std::size_t>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits)));
  }
}
}

TileFiller::TileFiller(const SweepScene& scene, const BlockProjection& projection,
  const SweepParticipants& participants, ClosedCells& cells)
  : scene_(scene)
  , projection_(projection)
  , participants_(participants)
  , cells_(cells)
{
}

ReceiverExtent TileFiller::extentOf(const SweepScene::Band& band) const
{
  ReceiverExtent extent;
  for (unsigned i = band.firstBlock; i < band.lastBlock; ++i)
  {
    const BlockBits spheres = participants_.spheres[i];
    if (spheres != 0)
    {
      const SweepScene::Block& block = scene_.blocks()[i];
      const Vec3f middle = projection_.project(block.middle, band.origin);
      extent.add(middle.x, middle.y, projection_.reachX(block), projection_.reachY(block),
        hwy::PopCount(spheres));
    }
  }
  return extent;
}

void TileFiller::fill(const SweepScene::Band& band, const SeenMarks& seen, DepthTiles& tiles)
{
  findBlocks(band, tiles);
  if (participants_.useClosedCells)
  {
    closeCells(band, tiles);
  }
  for (const NearBlock& block : blocks_)
  {
    add(block, band, seen, tiles);
  }
}

void TileFiller::findBlocks(const SweepScene::Band& band, const DepthTiles& tiles)
{
  blocks_.clear();
  for (unsigned i = 0; i < scene_.blocks().size(); ++i)
  {
    const BlockBits spheres = participants_.spheres[i];
    const SweepScene::Block& block = scene_.blocks()[i];
    const Vec3f middle = projection_.project(block.middle, band.origin);
    if (spheres != 0 && tiles.mayReach(middle.x, middle.y, block.distance, block.radius))
    {
      const bool isBefore = i < band.firstBlock;
      blocks_.push_back({ i, isBefore, !isBefore && i < band.lastBlock, spheres });
    }
  }
}

/// Spheres that were shown before close most cells. What is hidden then needs to close none: to
/// close takes several times as long as to find that out.
void TileFiller::closeCells(const SweepScene::Band& band, const DepthTiles& tiles)
{
  cells_.begin(tiles.area(), band.largestRadius);
  closeBy(band, [this](const NearBlock& block) { return shownOf(block); });
  if (&participants_.spheres != &participants_.shown)
  {
    dropHidden(band);
    closeBy(band, [this](const NearBlock& block) { return block.spheres & ~shownOf(block); });
  }
}

BlockBits TileFiller::shownOf(const NearBlock& block) const
{
  return block.spheres & participants_.shown[block.place];
}

/// Closes what the spheres choose(block) cover, of all blocks.
template <typename Choose>
void TileFiller::closeBy(const SweepScene::Band& band, const Choose& choose)
{
  for (const NearBlock& block : blocks_)
  {
    project(block, choose(block), band);
    cells_.close(projected_);
  }
  cells_.finish();
}

/// Drops those not shown before that are hidden from both sides.
void TileFiller::dropHidden(const SweepScene::Band& band)
{
  for (NearBlock& block : blocks_)
  {
    if (block.receives)
    {
      project(block, block.spheres & ~shownOf(block), band);
      const HiddenSpheres hidden = findHidden();
      const BlockBits dropped = hidden.upward & hidden.downward;
      count({ dropped, dropped });
      const unsigned first = scene_.blocks()[block.place].first;
      forEachBit(dropped,
        [&](std::size_t i) { block.spheres &= ~(BlockBits(1) << (projected_.index[i] - first)); });
    }
  }
}

void TileFiller::add(
  const NearBlock& block, const SweepScene::Band& band, const SeenMarks& seen, DepthTiles& tiles)
{
  project(block, block.spheres, band);
  HiddenSpheres hidden;
  if (participants_.useClosedCells && block.receives)
  {
    hidden = findHidden();
    count(hidden);
  }
  const auto bitAt = [](BlockBits bits, std::size_t i, DirectionBit bit)
  { return (bits >> i & 1) != 0 ? bit : 0; };
  for (std::size_t i = 0; i < projected_.count; ++i)
  {
    const unsigned index = projected_.index[i];
    const bool isUnseen = !participants_.bounded && block.isBefore && seen[index] == 0;
    const int hiddenIn = bitAt(hidden.upward, i, Upward) | bitAt(hidden.downward, i, Downward);
    if (!isUnseen && (participants_.directions & ~hiddenIn) != 0)
    {
      tiles.add({ projected_.x[i], projected_.y[i], projected_.z[i], projected_.radius[i], index },
        block.receives, static_cast<std::uint8_t>(hiddenIn));
    }
  }
}

void TileFiller::project(const NearBlock& block, BlockBits spheres, const SweepScene::Band& band)
{
  projection_.project(scene_.blocks()[block.place], spheres, band.origin, projected_);
}

/// Of the block at hand. In a direction that is not swept nothing shows.
HiddenSpheres TileFiller::findHidden() const
{
  HiddenSpheres hidden = cells_.hidden(projected_);
  const BlockBits all = ~BlockBits(0);
  hidden.upward |= (participants_.directions & Upward) != 0 ? 0 : all;
  hidden.downward |= (participants_.directions & Downward) != 0 ? 0 : all;
  return hidden;
}

void TileFiller::count(const HiddenSpheres& hidden)
{
  closed_ += (participants_.directions & Upward) != 0 ? hwy::PopCount(hidden.upward) : 0;
  closed_ += (participants_.directions & Downward) != 0 ? hwy::PopCount(hidden.downward) : 0;
}
}
