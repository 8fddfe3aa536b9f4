// SPDX-License-Identifier: BSD-3-Clause
#include "ByteCandidates.h"

#include "Gamma2.h"
#include "LeaderSearch.h"
#include "TextureSizes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace po
{
namespace
{
/// A table as bytes of UInt8Gamma2, and which row each particle has.
struct BytesOfBake
{
  EncodedTable table;
  std::vector<std::int32_t> rowOf;
};

Candidate fromBytes(const Baked& baked, const std::string& name, BytesOfBake&& bytes, double size)
{
  auto kept = std::make_shared<BytesOfBake>(std::move(bytes));
  Candidate candidate;
  candidate.name = name;
  candidate.bytes = size + IndexBytes * static_cast<double>(kept->rowOf.size());
  candidate.decode = [kept, texels = texelsOf(baked)](std::size_t particle, float* texture)
  {
    const auto row = static_cast<std::size_t>(kept->rowOf[particle]);
    std::transform(kept->table.bytes.begin() + static_cast<std::ptrdiff_t>(row * texels),
      kept->table.bytes.begin() + static_cast<std::ptrdiff_t>((row + 1) * texels), texture,
      [&](std::uint8_t byte)
      { return static_cast<float>(decodeGamma2(byte, kept->table.maximum)); });
  };
  candidate.textures = std::make_shared<OcclusionTextures>(
    baked.resolution, kept->table.bytes.data(), kept->table.maximum, kept->rowOf.data(), nullptr);
  // The textures refer to the table: both live as long as the candidate.
  candidate.decode = [kept, textures = candidate.textures, decode = candidate.decode](
                       std::size_t particle, float* texture) { decode(particle, texture); };
  return candidate;
}

/// The rows of a table that stand for others, and which stands for each.
struct Leaders
{
  std::vector<std::size_t> rows;
  std::vector<std::int32_t> of;
};

BytesOfBake byLeaders(const Baked& baked, const Leaders& leaders)
{
  TextureTable table(baked.resolution, leaders.rows.size());
  std::vector<std::int32_t> target;
  for (const std::size_t row : leaders.rows)
  {
    target.push_back(table.insert(textureOf(baked, row)));
  }
  BytesOfBake bytes;
  for (const std::int32_t row : baked.rowOf)
  {
    bytes.rowOf.push_back(
      target[static_cast<std::size_t>(leaders.of[static_cast<std::size_t>(row)])]);
  }
  bytes.table = encode(std::move(table), Encoding::UInt8Gamma2, bytes.rowOf, baked.maximum);
  return bytes;
}

/// Words that stand for textures.
class Codebook
{
public:
  /// @param sample textures, the first of which are the words to begin with
  Codebook(const Baked& baked, const std::vector<float>& sample, std::size_t words)
    : texels_(texelsOf(baked))
    , shares_(texelShares(baked.resolution))
    , words_(std::min(words, sample.size() / texels_))
    , values_(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(words_ * texels_))
  {
    constexpr int Rounds = 6;
    for (int round = 0; round < Rounds; ++round)
    {
      improve(sample);
    }
  }

  [[nodiscard]] std::size_t words() const { return words_; }
  [[nodiscard]] const std::vector<float>& values() const { return values_; }

  [[nodiscard]] std::size_t nearest(const float* texture) const
  {
    std::size_t best = 0;
    double least = 1e300;
    for (std::size_t word = 0; word < words_; ++word)
    {
      const double d = squareDifference(shares_, texture, values_.data() + word * texels_, least);
      if (d < least)
      {
        best = word;
        least = d;
      }
    }
    return best;
  }

private:
  /// Each word becomes the mean of what is nearest to it.
  void improve(const std::vector<float>& sample)
  {
    const std::size_t samples = sample.size() / texels_;
    std::vector<std::size_t> wordOf(samples);
    tbb::parallel_for(std::size_t(0), samples,
      [&](std::size_t i) { wordOf[i] = nearest(sample.data() + i * texels_); });
    std::vector<float> sums(values_.size(), 0.0f);
    std::vector<float> counts(words_, 0.0f);
    for (std::size_t i = 0; i < samples; ++i)
    {
      ++counts[wordOf[i]];
      for (std::size_t t = 0; t < texels_; ++t)
      {
        sums[wordOf[i] * texels_ + t] += sample[i * texels_ + t];
      }
    }
    for (std::size_t i = 0; i < values_.size(); ++i)
    {
      const float count = counts[i / texels_];
      values_[i] = count > 0 ? sums[i] / count : values_[i];
    }
  }

  std::size_t texels_;
  std::vector<float> shares_; ///< of each texel
  std::size_t words_;
  std::vector<float> values_; ///< of the words
};

/// The words as bytes, and one more for dark textures.
EncodedTable bytesOf(const Codebook& book, const Baked& baked)
{
  EncodedTable table;
  table.maximum = baked.maximum;
  std::transform(book.values().begin(), book.values().end(), std::back_inserter(table.bytes),
    [&](float v) { return encodeGamma2(static_cast<double>(v), baked.maximum); });
  table.bytes.resize(table.bytes.size() + texelsOf(baked), 0);
  return table;
}

/// Which word each row of the table has.
std::vector<std::int32_t> wordsOf(const Codebook& book, const Baked& baked)
{
  std::vector<std::int32_t> wordOfRow(static_cast<std::size_t>(baked.table.rows()));
  tbb::parallel_for(std::size_t(0), wordOfRow.size(),
    [&](std::size_t row)
    {
      const float* texture = textureOf(baked, row);
      const bool dark =
        std::all_of(texture, texture + texelsOf(baked), [](float v) { return v == 0; });
      wordOfRow[row] = static_cast<std::int32_t>(dark ? book.words() : book.nearest(texture));
    });
  return wordOfRow;
}
}

Candidate plainBytes(const Baked& baked)
{
  BytesOfBake bytes;
  bytes.rowOf = baked.rowOf;
  bytes.table = encode(copyOf(baked), Encoding::UInt8Gamma2, bytes.rowOf, baked.maximum);
  const auto size = static_cast<double>(bytes.table.bytes.size());
  return fromBytes(baked, "8 bit, equal ones once", std::move(bytes), size);
}

Candidate nearEqual(const Baked& baked, double allowed)
{
  constexpr std::size_t MostTried = 2000; // sharing was no more common with all
  LeaderSearch search(texelShares(baked.resolution), allowed, MostTried);
  Leaders leaders;
  for (std::int32_t row = 0; row < baked.table.rows(); ++row)
  {
    const float* texture = textureOf(baked, static_cast<std::size_t>(row));
    std::int32_t leader = search.find(texture);
    if (leader < 0)
    {
      leader = static_cast<std::int32_t>(leaders.rows.size());
      leaders.rows.push_back(static_cast<std::size_t>(row));
      search.add(leader, std::vector<float>(texture, texture + texelsOf(baked)));
    }
    leaders.of.push_back(leader);
  }
  BytesOfBake bytes = byLeaders(baked, leaders);
  const auto size = static_cast<double>(bytes.table.bytes.size());
  return fromBytes(baked, "8 bit, near-equal ones once", std::move(bytes), size);
}

Candidate vectorQuantization(
  const Baked& baked, const std::vector<float>& sample, std::size_t words)
{
  const Codebook book(baked, sample, words);
  const std::vector<std::int32_t> wordOfRow = wordsOf(book, baked);
  BytesOfBake bytes;
  bytes.table = bytesOf(book, baked);
  for (const std::int32_t row : baked.rowOf)
  {
    bytes.rowOf.push_back(wordOfRow[static_cast<std::size_t>(row)]);
  }
  const auto size = static_cast<double>(bytes.table.bytes.size());
  return fromBytes(baked, "vector quantization, " + std::to_string(book.words()) + " words",
    std::move(bytes), size);
}

Candidate fourBits(const Baked& baked)
{
  const std::size_t texels = texelsOf(baked);
  const auto side = static_cast<std::size_t>(baked.resolution);
  Candidate candidate;
  candidate.name = "4 bit, blocks of 4 x 4";
  candidate.bytes =
    static_cast<double>(baked.table.rows()) * static_cast<double>(texels / 16 * 10) +
    IndexBytes * static_cast<double>(baked.rowOf.size());
  candidate.decode = [&baked, side](std::size_t particle, float* texture)
  {
    const float* source = textureOf(baked, static_cast<std::size_t>(baked.rowOf[particle]));
    for (std::size_t block = 0; block < side * side / 16; ++block)
    {
      const std::size_t first = block / (side / 4) * 4 * side + block % (side / 4) * 4;
      int low = 255, high = 0;
      std::array<int, 16> bytes;
      for (std::size_t i = 0; i < 16; ++i)
      {
        const float value = source[first + i / 4 * side + i % 4];
        bytes[i] = encodeGamma2(static_cast<double>(value), baked.maximum);
        low = std::min(low, bytes[i]);
        high = std::max(high, bytes[i]);
      }
      for (std::size_t i = 0; i < 16; ++i)
      {
        const double step = (high - low) / 15.0;
        const double level = step > 0 ? std::round((bytes[i] - low) / step) : 0;
        const double shown = (low + level * step) / 255;
        texture[first + i / 4 * side + i % 4] = static_cast<float>(baked.maximum * shown * shown);
      }
    }
  };
  return candidate;
}
}
