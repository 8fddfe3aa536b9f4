// SPDX-License-Identifier: BSD-3-Clause
#include "TextureTable.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <stdexcept>

namespace po
{
std::int32_t RowIndex::findOrAdd(const char* row, const char* rows, std::int32_t count)
{
  const std::size_t hash = std::hash<std::string_view>{}({ row, bytesPerRow_ });
  const auto [first, last] = rowsByHash_.equal_range(hash);
  for (auto candidate = first; candidate != last; ++candidate)
  {
    const char* known = rows + static_cast<std::size_t>(candidate->second) * bytesPerRow_;
    if (std::memcmp(known, row, bytesPerRow_) == 0)
    {
      return candidate->second;
    }
  }
  rowsByHash_.emplace(hash, count);
  return count;
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
    throw std::length_error("More than 2^31 - 1 distinct textures do not fit the texture index.");
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

namespace
{
/// Bytes of all rows, in place of equal ones only the first; `rowOf` follows.
void encodeBytes(const TextureTable& table, EncodedTable& encoded, std::vector<std::int32_t>& rowOf)
{
  const std::size_t texels = table.texelsPerRow();
  encoded.bytes.reserve(texels * static_cast<std::size_t>(table.rows()));
  std::vector<std::int32_t> newRow(static_cast<std::size_t>(table.rows()));
  std::vector<std::uint8_t> row(texels);
  RowIndex index(texels);
  const float* values = table.values().data();
  for (std::int32_t& target : newRow)
  {
    std::transform(values, values + texels, row.begin(),
      [&](float value) { return encodeGamma2(value, encoded.maximum); });
    values += texels;
    target = index.findOrAdd(reinterpret_cast<const char*>(row.data()),
      reinterpret_cast<const char*>(encoded.bytes.data()), encoded.rows);
    if (target == encoded.rows)
    {
      encoded.bytes.insert(encoded.bytes.end(), row.begin(), row.end());
      ++encoded.rows;
    }
  }
  for (std::int32_t& particleRow : rowOf)
  {
    particleRow = particleRow < 0 ? particleRow : newRow[static_cast<std::size_t>(particleRow)];
  }
}
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
  EncodedTable encoded;
  encoded.encoding = encoding;
  encoded.resolution = table.resolution();
  encoded.maximum = maximum;
  if (encoding == Encoding::Float32Linear)
  {
    encoded.rows = table.rows();
    encoded.floats = table.takeValues();
  }
  else
  {
    encodeBytes(table, encoded, rowOf);
  }
  encoded.textures = static_cast<std::size_t>(encoded.rows);
  return encoded;
}
}
