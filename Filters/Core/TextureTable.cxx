// SPDX-License-Identifier: BSD-3-Clause
#include "TextureTable.h"

#include "Random.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <stdexcept>

namespace po
{
namespace
{
[[noreturn]] void refuseMoreRows()
{
  throw std::length_error("More than 2^31 - 1 distinct textures do not fit the texture index.");
}

bool isEqual(const WeighedTexture& a, const WeighedTexture& b, std::size_t texels)
{
  const bool equalWeights = a.weights && b.weights ? std::memcmp(a.weights, b.weights, texels) == 0
                                                   : a.weights == b.weights;
  return equalWeights && std::memcmp(a.values, b.values, texels * sizeof(float)) == 0;
}
}

std::int32_t RowIndex::findOrAdd(std::size_t hash, const IsEqual& isEqual, std::int32_t count)
{
  if (4 * static_cast<std::size_t>(count) >= 3 * slots_.size())
  {
    grow();
  }
  const auto mixed = static_cast<std::uint32_t>(mixBits(hash));
  Slot& slot = find(mixed, isEqual);
  if (slot.row < 0)
  {
    slot = { mixed, count };
  }
  return slot.row;
}

RowIndex::Slot& RowIndex::find(std::uint32_t hash, const IsEqual& isEqual)
{
  std::size_t place = hash & (slots_.size() - 1);
  while (slots_[place].row >= 0 && (slots_[place].hash != hash || !isEqual(slots_[place].row)))
  {
    place = (place + 1) & (slots_.size() - 1);
  }
  return slots_[place];
}

void RowIndex::grow()
{
  std::vector<Slot> known(std::max<std::size_t>(64, 2 * slots_.size()));
  known.swap(slots_);
  for (const Slot& slot : known)
  {
    if (slot.row >= 0)
    {
      find(slot.hash, [](std::int32_t) { return false; }) = slot;
    }
  }
}

TextureTable::TextureTable(int resolution, std::size_t expected)
  : resolution_(resolution)
  , texels_(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution))
{
  values_.reserve(expected * texels_);
}

std::int32_t TextureTable::insert(const WeighedTexture& added)
{
  if (rows_ == std::numeric_limits<std::int32_t>::max())
  {
    refuseMoreRows();
  }
  const std::int32_t row = index_.findOrAdd(
    hashOf(added, texels_),
    [&](std::int32_t known) { return isEqual(texture(known), added, texels_); }, rows_);
  if (row == rows_)
  {
    append(added);
  }
  return row;
}

void TextureTable::append(const WeighedTexture& added)
{
  values_.insert(values_.end(), added.values, added.values + texels_);
  if (added.weights)
  {
    weightsOf_.resize(static_cast<std::size_t>(rows_), -1);
    weightsOf_.push_back(static_cast<std::int32_t>(weights_.size() / texels_));
    weights_.insert(weights_.end(), added.weights, added.weights + texels_);
  }
  ++rows_;
}

WeighedTexture TextureTable::texture(std::int32_t row) const
{
  const auto i = static_cast<std::size_t>(row);
  const std::int32_t weights = i < weightsOf_.size() ? weightsOf_[i] : -1;
  return { values_.data() + i * texels_,
    weights < 0 ? nullptr : weights_.data() + static_cast<std::size_t>(weights) * texels_ };
}

ByteTable::ByteTable(int resolution, double maximum, std::size_t expected)
  : row_(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution))
{
  encoded_.encoding = Encoding::UInt8Gamma2;
  encoded_.resolution = resolution;
  encoded_.maximum = maximum;
  encoded_.bytes.reserve(expected * row_.size());
}

std::int32_t ByteTable::insert(const float* texture)
{
  if (encoded_.rows == std::numeric_limits<std::int32_t>::max())
  {
    refuseMoreRows();
  }
  std::transform(texture, texture + row_.size(), row_.begin(),
    [this](float value) { return encodeGamma2(value, encoded_.maximum); });
  const std::int32_t row = index_.findOrAdd(
    hashOfBytes(row_.data(), row_.size()),
    [this](std::int32_t known)
    {
      const auto offset = static_cast<std::size_t>(known) * row_.size();
      return std::memcmp(encoded_.bytes.data() + offset, row_.data(), row_.size()) == 0;
    },
    encoded_.rows);
  if (row == encoded_.rows)
  {
    encoded_.bytes.insert(encoded_.bytes.end(), row_.begin(), row_.end());
    ++encoded_.rows;
  }
  return row;
}

void ByteTable::insertAll(const TextureTable& table, std::vector<std::int32_t>& rowOf)
{
  insertAll(
    [&table](const auto& visit)
    {
      for (std::int32_t row = 0; row < table.rows(); ++row)
      {
        visit(table.texture(row).values);
      }
    },
    rowOf);
}

void ByteTable::insertAll(
  const std::function<void(const std::function<void(const float*)>&)>& forEach,
  std::vector<std::int32_t>& rowOf)
{
  std::vector<std::int32_t> newRow;
  forEach([&](const float* texture) { newRow.push_back(insert(texture)); });
  for (std::int32_t& row : rowOf)
  {
    row = row < 0 ? row : newRow[static_cast<std::size_t>(row)];
  }
}

EncodedTable ByteTable::take()
{
  encoded_.textures = static_cast<std::size_t>(encoded_.rows);
  return std::move(encoded_);
}

double TextureTable::largestValue() const
{
  return values_.empty() ? 0.0 : *std::max_element(values_.begin(), values_.end());
}

EncodedTable encode(TextureTable&& table, Encoding encoding, std::vector<std::int32_t>& rowOf)
{
  const double maximum = table.largestValue();
  return encode(std::move(table), encoding, rowOf, maximum);
}

EncodedTable encode(
  TextureTable&& table, Encoding encoding, std::vector<std::int32_t>& rowOf, double maximum)
{
  if (encoding == Encoding::UInt8Gamma2)
  {
    ByteTable bytes(table.resolution(), maximum, static_cast<std::size_t>(table.rows()));
    bytes.insertAll(table, rowOf);
    return bytes.take();
  }
  EncodedTable encoded;
  encoded.encoding = encoding;
  encoded.resolution = table.resolution();
  encoded.maximum = maximum;
  encoded.rows = table.rows();
  encoded.textures = static_cast<std::size_t>(encoded.rows);
  encoded.floats = table.takeValues();
  return encoded;
}
}
