// SPDX-License-Identifier: BSD-3-Clause
#include "SpilledTextures.h"

#include "TexelWeights.h"

#include <algorithm>
#include <cstring>

namespace po
{
namespace
{
/// Values that are written, and read again, at a time: 1 MiB.
constexpr std::size_t PieceValues = std::size_t(1) << 18;
}

std::int32_t SpilledTextures::insert(const float* added)
{
  const std::int32_t row = index_.findOrAdd(
    hashOf({ added, nullptr }, texels_),
    [&](std::int32_t known)
    { return std::memcmp(texture(known), added, texels_ * sizeof(float)) == 0; },
    rows_);
  if (row == rows_)
  {
    if (waiting_.size() >= PieceValues)
    {
      file_.append(waiting_.data(), waiting_.size() * sizeof(float));
      waiting_.clear();
      written_ = rows_;
    }
    waiting_.insert(waiting_.end(), added, added + texels_);
    largest_ = std::max(largest_, static_cast<double>(*std::max_element(added, added + texels_)));
    ++rows_;
  }
  return row;
}

/// Good until the next call.
const float* SpilledTextures::texture(std::int32_t row)
{
  if (row >= written_)
  {
    return waiting_.data() + static_cast<std::size_t>(row - written_) * texels_;
  }
  const std::size_t bytes = texels_ * sizeof(float);
  read_.resize(texels_);
  file_.read(static_cast<std::uint64_t>(row) * bytes, read_.data(), bytes);
  return read_.data();
}

void SpilledTextures::forEach(const std::function<void(const float*)>& visit)
{
  const std::size_t most = std::max<std::size_t>(1, PieceValues / texels_);
  for (std::size_t first = 0; first < static_cast<std::size_t>(written_); first += most)
  {
    const std::size_t count = std::min(most, static_cast<std::size_t>(written_) - first);
    read_.resize(count * texels_);
    file_.read(first * texels_ * sizeof(float), read_.data(), read_.size() * sizeof(float));
    for (std::size_t i = 0; i < count; ++i)
    {
      visit(read_.data() + i * texels_);
    }
  }
  for (const float* texture = waiting_.data(); texture != waiting_.data() + waiting_.size();
       texture += texels_)
  {
    visit(texture);
  }
}
}
