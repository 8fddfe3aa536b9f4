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
}

std::int32_t RowIndex::findOrAdd(const char* row, const char* rows, std::int32_t count)
{
  if (4 * static_cast<std::size_t>(count) >= 3 * slots_.size())
  {
    grow();
  }
  const auto hash =
    static_cast<std::uint32_t>(mixBits(std::hash<std::string_view>{}({ row, bytesPerRow_ })));
  Slot& slot = find(hash,
    [&](std::int32_t known)
    {
      const char* there = rows + static_cast<std::size_t>(known) * bytesPerRow_;
      return std::memcmp(there, row, bytesPerRow_) == 0;
    });
  if (slot.row < 0)
  {
    slot = { hash, count };
  }
  return slot.row;
}

template <typename IsEqual>
RowIndex::Slot& RowIndex::find(std::uint32_t hash, IsEqual isEqual)
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
  , index_(texels_ * sizeof(float))
{
  values_.reserve(expected * texels_);
}

std::int32_t TextureTable::insert(const float* texture)
{
  if (rows_ == std::numeric_limits<std::int32_t>::max())
  {
    refuseMoreRows();
  }
  const std::int32_t row = index_.findOrAdd(
    reinterpret_cast<const char*>(texture), reinterpret_cast<const char*>(values_.data()), rows_);
  if (row == rows_)
  {
    values_.insert(values_.end(), texture, texture + texels_);
    ++rows_;
  }
  return row;
}

ByteTable::ByteTable(int resolution, double maximum, std::size_t expected)
  : row_(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution))
  , index_(row_.size())
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
  const std::int32_t row = index_.findOrAdd(reinterpret_cast<const char*>(row_.data()),
    reinterpret_cast<const char*>(encoded_.bytes.data()), encoded_.rows);
  if (row == encoded_.rows)
  {
    encoded_.bytes.insert(encoded_.bytes.end(), row_.begin(), row_.end());
    ++encoded_.rows;
  }
  return row;
}

void ByteTable::insertAll(const TextureTable& table, std::vector<std::int32_t>& rowOf)
{
  std::vector<std::int32_t> newRow(static_cast<std::size_t>(table.rows()));
  const float* values = table.values().data();
  for (std::int32_t& target : newRow)
  {
    target = insert(values);
    values += table.texelsPerRow();
  }
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
