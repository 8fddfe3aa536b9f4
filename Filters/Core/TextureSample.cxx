// SPDX-License-Identifier: BSD-3-Clause
#include "TextureSample.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string_view>
#include <utility>

namespace po
{
namespace
{
using Draw = std::pair<std::uint64_t, const std::uint64_t*>; ///< hash and texels

bool hasOneValue(const float* texture, std::size_t texels)
{
  return std::all_of(texture, texture + texels, [&](float value) { return value == texture[0]; });
}

/// The textures of this process with the smallest hashes: hash and floats, two to a word.
ProcessGroup::Words drawOwn(const TextureTable& table, std::size_t most)
{
  const std::size_t texels = table.texelsPerRow();
  std::vector<std::pair<std::uint64_t, const float*>> drawn;
  for (std::int32_t row = 0; row < table.rows(); ++row)
  {
    const float* texture = table.values().data() + static_cast<std::size_t>(row) * texels;
    if (!hasOneValue(texture, texels))
    {
      const std::string_view bytes(reinterpret_cast<const char*>(texture), texels * sizeof(float));
      drawn.emplace_back(std::hash<std::string_view>{}(bytes), texture);
    }
  }
  const std::size_t count = std::min(most, drawn.size());
  std::partial_sort(drawn.begin(), drawn.begin() + static_cast<std::ptrdiff_t>(count), drawn.end());
  ProcessGroup::Words words;
  for (std::size_t i = 0; i < count; ++i)
  {
    words.push_back(drawn[i].first);
    words.resize(words.size() + (texels + 1) / 2, 0);
    std::memcpy(
      words.data() + words.size() - (texels + 1) / 2, drawn[i].second, texels * sizeof(float));
  }
  return words;
}
}

TextureSample sampleTextures(const TextureTable& table, std::size_t most, const ProcessGroup& group)
{
  const std::size_t texels = table.texelsPerRow();
  const std::size_t length = 1 + (texels + 1) / 2;
  const ProcessGroup::Words words = group.gather(drawOwn(table, most));
  std::vector<Draw> all;
  for (std::size_t i = 0; i < words.size(); i += length)
  {
    all.emplace_back(words[i], words.data() + i + 1);
  }
  const auto byHash = [](const Draw& a, const Draw& b) { return a.first < b.first; };
  const auto sameHash = [](const Draw& a, const Draw& b) { return a.first == b.first; };
  std::stable_sort(all.begin(), all.end(), byHash);
  all.erase(std::unique(all.begin(), all.end(), sameHash), all.end());

  TextureSample sample;
  sample.population = static_cast<double>(all.size());
  if (all.size() >= most && most > 1)
  {
    all.resize(most);
    // Bar-Yossef et al. 2002: k - 1 over the k-th smallest hash as a share of all hashes.
    sample.population =
      static_cast<double>(most - 1) / std::ldexp(static_cast<double>(all.back().first) + 1, -64);
  }
  sample.values.resize(all.size() * texels);
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    std::memcpy(sample.values.data() + i * texels, all[i].second, texels * sizeof(float));
  }
  return sample;
}
}
