// SPDX-License-Identifier: BSD-3-Clause
#include "TexturePacker.h"

#include "Gamma2.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

namespace po
{
namespace
{
constexpr std::size_t WordBytes = PackedFormat::WordBytes;

/// Appends codes to a table, equal ones once.
class CodeTable
{
public:
  explicit CodeTable(std::vector<std::uint8_t>& bytes)
    : bytes_(bytes)
  {
  }

  /// The first word of the code.
  std::int32_t insert(const std::vector<std::uint8_t>& code)
  {
    const std::string_view text(reinterpret_cast<const char*>(code.data()), code.size());
    const std::size_t hash = std::hash<std::string_view>{}(text);
    const auto [first, last] = firstByHash_.equal_range(hash);
    for (auto known = first; known != last; ++known)
    {
      const std::size_t offset = WordBytes * static_cast<std::size_t>(known->second);
      if (offset + code.size() <= bytes_.size() &&
        std::memcmp(bytes_.data() + offset, code.data(), code.size()) == 0)
      {
        return known->second;
      }
    }
    const std::size_t word = bytes_.size() / WordBytes;
    if (word > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    {
      throw std::length_error("More than 8 GiB of packed textures do not fit the texture index.");
    }
    bytes_.insert(bytes_.end(), code.begin(), code.end());
    firstByHash_.emplace(hash, static_cast<std::int32_t>(word));
    return static_cast<std::int32_t>(word);
  }

  [[nodiscard]] std::size_t size() const { return firstByHash_.size(); }

private:
  std::vector<std::uint8_t>& bytes_;
  std::unordered_multimap<std::size_t, std::int32_t> firstByHash_;
};

double squareDifference(const float* weights, const std::vector<float>& a, const float* b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    sum += static_cast<double>(weights[i]) * difference * difference;
  }
  return sum;
}

/// Sets `count` bits from `position` on.
void putBits(std::vector<std::uint8_t>& bytes, std::size_t position, std::uint32_t value, int count)
{
  for (int bit = 0; bit < count; ++bit, ++position)
  {
    bytes[position / 8] |= static_cast<std::uint8_t>(((value >> bit) & 1u) << position % 8);
  }
}

/// What became of a row.
struct PackedRow
{
  std::int32_t firstWord = 0;
  double squareError = 0;
  double area = 0; ///< visible, as a share of the sphere
};

/// From rows to their first words; what the difference is over what is visible of all particles.
void renumber(
  std::vector<std::int32_t>& rowOf, const std::vector<PackedRow>& packed, EncodedTable& table)
{
  double sum = 0;
  for (std::int32_t& row : rowOf)
  {
    if (row >= 0)
    {
      const PackedRow& its = packed[static_cast<std::size_t>(row)];
      sum += its.squareError;
      table.comparedArea += its.area;
      row = its.firstWord;
    }
  }
  table.difference = table.comparedArea > 0 ? std::sqrt(sum / table.comparedArea) : 0;
}
}

double allowedDifference(double error, double noise)
{
  return std::sqrt(error * error + 2 * error * noise);
}

TexturePacker::TexturePacker(int resolution, double maximum)
  : shares_(texelShares(resolution))
{
  format_.resolution = resolution;
  format_.maximum = maximum;
  for (const int size : textureSizes(resolution))
  {
    resamplers_.emplace_back(resolution, size);
  }
}

TexturePacker::Area TexturePacker::areaOf(
  const WeighedTexture& texture, std::vector<float>& memory) const
{
  if (texture.weights == nullptr)
  {
    return { shares_.data(), 1 };
  }
  memory.resize(shares_.size());
  std::transform(shares_.begin(), shares_.end(), texture.weights, memory.begin(),
    [](float share, std::uint8_t weight)
    { return share * static_cast<float>(weight) / static_cast<float>(TexelWeights::Whole); });
  return { memory.data(), std::accumulate(memory.begin(), memory.end(), 0.0) };
}

TexturePacker::Code TexturePacker::packSize(
  const float* texture, const Area& area, std::size_t kind) const
{
  const TextureResampler& resampler = resamplers_[kind];
  const auto size = static_cast<std::size_t>(resampler.size());
  std::vector<float> reduced(size * size);
  if (area.weights == shares_.data())
  {
    resampler.reduce(texture, reduced.data());
  }
  else
  {
    resampler.reduce(texture, area.weights, reduced.data());
  }
  Code code;
  code.area = area.sum;
  code.bytes.assign(WordBytes * PackedFormat::sizeWords(resampler.size()), 0);
  code.bytes[0] = static_cast<std::uint8_t>(kind);
  for (std::size_t i = 0; i < reduced.size(); ++i)
  {
    code.bytes[1 + i] = encodeGamma2(static_cast<double>(reduced[i]), format_.maximum);
    reduced[i] = static_cast<float>(decodeGamma2(code.bytes[1 + i], format_.maximum));
  }
  std::vector<float> shown(shares_.size());
  resampler.enlarge(reduced.data(), shown.data());
  code.squareError = squareDifference(area.weights, shown, texture);
  return code;
}

TexturePacker::Code TexturePacker::packClass(
  std::size_t c, const std::vector<float>& coefficients) const
{
  Code code;
  code.bytes.assign(WordBytes * PackedFormat::ClassWords[c], 0);
  code.bytes[0] = static_cast<std::uint8_t>(PackedFormat::SizeKinds + c);
  std::size_t position = PackedFormat::HeaderBits;
  const std::vector<std::uint8_t>& bits = format_.classBits[c];
  for (std::size_t k = 0; k < bits.size(); ++k)
  {
    putBits(code.bytes, position, Quantizer::encode(coefficients[k], bits[k]), bits[k]);
    position += bits[k];
  }
  return code;
}

SizePacker::SizePacker(int resolution, double maximum, double allowed)
  : TexturePacker(resolution, maximum)
  , allowed_(allowed)
{
}

TexturePacker::Code SizePacker::pack(const WeighedTexture& texture) const
{
  std::vector<float> weights;
  const Area area = areaOf(texture, weights);
  Code code;
  for (std::size_t kind = 0; kind < sizes(); ++kind)
  {
    code = packSize(texture.values, area, kind);
    if (code.squareError <= allowed_ * allowed_ * area.sum)
    {
      break;
    }
  }
  return code;
}

EncodedTable packTable(
  TextureTable&& table, const TexturePacker& packer, std::vector<std::int32_t>& rowOf)
{
  constexpr std::size_t Batch = 4096;
  const TextureTable input = std::move(table);
  const auto rows = static_cast<std::size_t>(input.rows());
  EncodedTable packed;
  packed.resolution = input.resolution();
  packed.maximum = packer.format().maximum;
  packed.packed = packer.format();
  std::vector<PackedRow> packedRows(rows);
  std::vector<TexturePacker::Code> codes(std::min(Batch, rows));
  CodeTable distinct(packed.bytes);
  for (std::size_t begin = 0; begin < rows; begin += Batch)
  {
    const std::size_t end = std::min(rows, begin + Batch);
    tbb::parallel_for(begin, end,
      [&](std::size_t row)
      { codes[row - begin] = packer.pack(input.texture(static_cast<std::int32_t>(row))); });
    for (std::size_t row = begin; row < end; ++row)
    {
      const TexturePacker::Code& code = codes[row - begin];
      packedRows[row] = { distinct.insert(code.bytes), code.squareError, code.area };
    }
  }
  packed.textures = distinct.size();
  packed.rows = static_cast<std::int32_t>(packed.bytes.size() / WordBytes);
  renumber(rowOf, packedRows, packed);
  return packed;
}
}
