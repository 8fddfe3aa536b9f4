// SPDX-License-Identifier: BSD-3-Clause
#include "TextureSample.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace po
{
namespace
{
/// A texture as words that processes exchange: hash, floats, weights.
struct Record
{
  explicit Record(std::size_t texels)
    : floats((texels + 1) / 2)
    , length(1 + floats + (texels + 7) / 8)
  {
  }

  std::size_t floats; ///< words of them
  std::size_t length; ///< words in all
};

/// The textures of this process with the smallest hashes.
ProcessGroup::Words drawOwn(const TextureTable& table, std::size_t most)
{
  const std::size_t texels = table.texelsPerRow();
  std::vector<std::pair<std::uint64_t, std::int32_t>> drawn;
  for (std::int32_t row = 0; row < table.rows(); ++row)
  {
    const WeighedTexture texture = table.texture(row);
    if (!hasOneValue(texture.values, texels))
    {
      drawn.emplace_back(hashOf(texture, texels), row);
    }
  }
  const std::size_t count = std::min(most, drawn.size());
  std::partial_sort(drawn.begin(), drawn.begin() + static_cast<std::ptrdiff_t>(count), drawn.end());
  const Record record(texels);
  ProcessGroup::Words words(count * record.length, 0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const WeighedTexture texture = table.texture(drawn[i].second);
    std::uint64_t* target = words.data() + i * record.length;
    *target = drawn[i].first;
    std::memcpy(target + 1, texture.values, texels * sizeof(float));
    auto* weights = reinterpret_cast<std::uint8_t*>(target + 1 + record.floats);
    texture.weights ? std::copy_n(texture.weights, texels, weights)
                    : std::fill_n(weights, texels, TexelWeights::Whole);
  }
  return words;
}

bool areWhole(const std::uint8_t* first, const std::uint8_t* last)
{
  return std::all_of(
    first, last, [](std::uint8_t weight) { return weight == TexelWeights::Whole; });
}

using Draws = std::vector<const std::uint64_t*>; ///< records

/// By hash, each once.
Draws distinctDraws(const ProcessGroup::Words& words, std::size_t length)
{
  Draws all;
  for (std::size_t i = 0; i < words.size(); i += length)
  {
    all.push_back(words.data() + i);
  }
  const auto byHash = [](const std::uint64_t* a, const std::uint64_t* b) { return *a < *b; };
  const auto sameHash = [](const std::uint64_t* a, const std::uint64_t* b) { return *a == *b; };
  std::stable_sort(all.begin(), all.end(), byHash);
  all.erase(std::unique(all.begin(), all.end(), sameHash), all.end());
  return all;
}
}

TextureSample sampleTextures(const TextureTable& table, std::size_t most, const ProcessGroup& group)
{
  const std::size_t texels = table.texelsPerRow();
  const Record record(texels);
  const ProcessGroup::Words words = group.gather(drawOwn(table, most));
  Draws all = distinctDraws(words, record.length);
  TextureSample sample;
  sample.population = static_cast<double>(all.size());
  if (all.size() >= most && most > 1)
  {
    all.resize(most);
    // Bar-Yossef et al. 2002: k - 1 over the k-th smallest hash as a share of all hashes.
    sample.population =
      static_cast<double>(most - 1) / std::ldexp(static_cast<double>(*all.back()) + 1, -64);
  }
  sample.values.resize(all.size() * texels);
  sample.weights.resize(all.size() * texels);
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const std::uint64_t* floats = all[i] + 1;
    std::memcpy(sample.values.data() + i * texels, floats, texels * sizeof(float));
    std::memcpy(sample.weights.data() + i * texels, floats + record.floats, texels);
  }
  return sample;
}

WeighedTexture TextureSample::texture(std::size_t i, std::size_t texels) const
{
  const std::uint8_t* its = weights.data() + i * texels;
  return { values.data() + i * texels, areWhole(its, its + texels) ? nullptr : its };
}

bool TextureSample::isWhole() const
{
  return areWhole(weights.data(), weights.data() + weights.size());
}
}
