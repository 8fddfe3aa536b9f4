// SPDX-License-Identifier: BSD-3-Clause
#ifndef PagedTexturesTestSupport_h
#define PagedTexturesTestSupport_h

// A source of textures whose reads a test counts, holds up and breaks.

#include "PagedTextures.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

namespace paged_textures
{
using namespace po;

constexpr int Resolution = 4;
constexpr std::size_t TextureBytes = Resolution * Resolution;
constexpr std::size_t SlotBytes = TextureBytes + 16;

/// A table in memory that counts what is read. It can be closed, so that reads wait, and broken.
class TableSource : public TextureSource
{
public:
  explicit TableSource(std::size_t textures)
    : bytes_(textures * TextureBytes)
  {
    std::mt19937 random(5);
    std::generate(
      bytes_.begin(), bytes_.end(), [&] { return static_cast<std::uint8_t>(random() % 256); });
  }

  void read(std::int32_t row, void* texels) const override
  {
    std::unique_lock lock(mutex_);
    reads_.push_back(row);
    changed_.notify_all();
    changed_.wait(lock, [this] { return !isClosed_; });
    if (isBroken_)
    {
      throw std::runtime_error("the source is broken");
    }
    std::memcpy(texels, texture(row), TextureBytes);
  }

  void setClosed(bool closed)
  {
    const std::lock_guard lock(mutex_);
    isClosed_ = closed;
    changed_.notify_all();
  }
  void setBroken()
  {
    const std::lock_guard lock(mutex_);
    isBroken_ = true;
  }

  /// Until so many reads have begun.
  bool waitForReads(std::size_t count) const
  {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(
      lock, std::chrono::seconds(60), [&] { return reads_.size() >= count; });
  }
  std::vector<std::int32_t> reads() const
  {
    const std::lock_guard lock(mutex_);
    return reads_;
  }
  const std::uint8_t* texture(std::int32_t row) const
  {
    return bytes_.data() + static_cast<std::size_t>(row) * TextureBytes;
  }

private:
  std::vector<std::uint8_t> bytes_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  mutable std::vector<std::int32_t> reads_;
  bool isClosed_ = false, isBroken_ = false;
};

inline std::vector<std::int32_t> range(std::int32_t first, std::int32_t end)
{
  std::vector<std::int32_t> rows(static_cast<std::size_t>(end - first));
  std::iota(rows.begin(), rows.end(), first);
  return rows;
}
}

#endif
