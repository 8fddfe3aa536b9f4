// SPDX-License-Identifier: BSD-3-Clause
#include "PagedTextures.h"

#include <algorithm>
#include <new>
#include <utility>

namespace po
{
PagedTextures::PagedTextures(std::shared_ptr<const TextureSource> source, std::size_t textures,
  std::size_t textureBytes, std::size_t budget)
  : textureBytes_(textureBytes)
  , capacity_(std::min(budget / (textureBytes + sizeof(Slot)), textures))
  , slotOf_(textures, None)
  , loader_(std::move(source), textureBytes)
{
}

void PagedTextures::beginView()
{
  releaseLoading(loader_.cancel());
  collect(); // nothing of the last view arrives after it
  ++view_;
}

std::size_t PagedTextures::demand(const std::vector<std::int32_t>& rows)
{
  std::size_t missing = 0;
  std::vector<TextureLoad> loads;
  const bool canLoad = loader_.error().empty();
  for (const std::int32_t row : rows)
  {
    std::int32_t& place = slotOf_[static_cast<std::size_t>(row)];
    if (place >= 0)
    {
      unlink(place);
      link(place);
      continue;
    }
    ++missing;
    const std::int32_t slot = place == None && canLoad ? takeSlot() : None;
    if (slot != None)
    {
      slots_[static_cast<std::size_t>(slot)].row = row;
      place = asLoading(slot);
      loads.push_back({ row, texelsOf(slot) });
    }
  }
  loading_ += loads.size();
  loader_.add(loads);
  return missing;
}

std::size_t PagedTextures::collect()
{
  const bool failed = !loader_.error().empty(); // asked first: after it nothing arrives
  const std::vector<TextureLoad> loaded = loader_.takeLoaded();
  for (const TextureLoad& load : loaded)
  {
    std::int32_t& place = slotOf_[static_cast<std::size_t>(load.row)];
    place = asLoading(place);
    link(place);
  }
  loading_ -= loaded.size();
  if (failed)
  {
    giveUp();
  }
  return loaded.size();
}

void PagedTextures::wait()
{
  if (isLoading())
  {
    loader_.wait();
    collect();
  }
}

/// A slot for another texture: a free one, a new one, or that of a texture of an earlier view; None
/// if there is no room.
std::int32_t PagedTextures::takeSlot()
{
  if (free_.empty())
  {
    addSlot();
  }
  if (free_.empty())
  {
    evict();
  }
  if (free_.empty())
  {
    return None;
  }
  const std::int32_t slot = free_.back();
  free_.pop_back();
  ++used_;
  return slot;
}

/// As long as there is memory; without it the budget is as good as used up.
void PagedTextures::addSlot()
{
  if (slots_.size() == capacity_)
  {
    return;
  }
  if (slots_.size() == ChunkSlots * chunks_.size())
  {
    const std::size_t count = std::min(ChunkSlots, capacity_ - slots_.size());
    std::unique_ptr<std::byte[]> chunk(new (std::nothrow) std::byte[count * textureBytes_]);
    if (!chunk)
    {
      return;
    }
    chunks_.push_back(std::move(chunk));
  }
  free_.push_back(static_cast<std::int32_t>(slots_.size()));
  slots_.emplace_back();
}

/// The texture that was used least recently, unless the view needs it.
void PagedTextures::evict()
{
  const std::int32_t oldest = oldest_;
  if (oldest != None && slots_[static_cast<std::size_t>(oldest)].view != view_)
  {
    unlink(oldest);
    release(oldest);
  }
}

void PagedTextures::release(std::int32_t slot)
{
  std::int32_t& row = slots_[static_cast<std::size_t>(slot)].row;
  slotOf_[static_cast<std::size_t>(row)] = None;
  row = None;
  free_.push_back(slot);
  --used_;
}

void PagedTextures::releaseLoading(const std::vector<TextureLoad>& loads)
{
  for (const TextureLoad& load : loads)
  {
    release(asLoading(slotOf_[static_cast<std::size_t>(load.row)]));
  }
  loading_ -= loads.size();
}

/// What is still expected will not come.
void PagedTextures::giveUp()
{
  for (std::size_t i = 0; i < slots_.size() && loading_ > 0; ++i)
  {
    const std::int32_t row = slots_[i].row;
    if (row != None && slotOf_[static_cast<std::size_t>(row)] < None)
    {
      release(static_cast<std::int32_t>(i));
      --loading_;
    }
  }
}

/// The texture of the slot is the one that was used last, in this view.
void PagedTextures::link(std::int32_t slot)
{
  Slot& entry = slots_[static_cast<std::size_t>(slot)];
  entry.view = view_;
  entry.newer = None;
  entry.older = newest_;
  (newest_ == None ? oldest_ : slots_[static_cast<std::size_t>(newest_)].newer) = slot;
  newest_ = slot;
}

void PagedTextures::unlink(std::int32_t slot)
{
  const Slot& entry = slots_[static_cast<std::size_t>(slot)];
  (entry.newer == None ? newest_ : slots_[static_cast<std::size_t>(entry.newer)].older) =
    entry.older;
  (entry.older == None ? oldest_ : slots_[static_cast<std::size_t>(entry.older)].newer) =
    entry.newer;
}
}
