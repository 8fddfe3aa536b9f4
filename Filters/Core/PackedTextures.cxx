// SPDX-License-Identifier: BSD-3-Clause
#include "PackedTextures.h"

#include "Gamma2.h"
#include "TexelMap.h"
#include "TextureSizes.h"

#include <algorithm>
#include <cmath>

namespace po
{
PackedTextures::PackedTextures(
  const PackedFormat& format, const std::uint8_t* words, std::size_t count)
  : resolution_(format.resolution)
  , maximum_(static_cast<float>(format.maximum))
  , words_(words)
  , count_(count)
{
  format.check();
  sizes_ = textureSizes(format.resolution);
  for (std::size_t header = 0; header < lengths_.size(); ++header)
  {
    lengths_[header] = format.wordsOf(static_cast<std::uint8_t>(header));
  }
  for (std::size_t byte = 0; byte < decoded_.size(); ++byte)
  {
    decoded_[byte] =
      static_cast<float>(decodeGamma2(static_cast<std::uint8_t>(byte), format.maximum));
  }
  for (const auto& bits : format.classBits)
  {
    layouts_.emplace_back(bits);
    stride_ = std::max(stride_, layouts_.back().padded);
  }
  const std::size_t texels = format.basis.texels();
  const std::size_t rows = std::min(stride_, 1 + format.basis.components());
  basis_.assign(texels * stride_, 0.0f);
  for (std::size_t texel = 0; texel < texels; ++texel)
  {
    for (std::size_t row = 0; row < rows; ++row)
    {
      basis_[texel * stride_ + row] = format.basis.value(row, texel);
    }
  }
}

std::size_t PackedTextures::lengthAt(std::size_t first) const
{
  if (first >= count_)
  {
    return 0;
  }
  const std::size_t length = lengths_[*code(first) & PackedFormat::HeaderMask];
  return length <= count_ - first ? length : 0;
}

float PackedTextures::lookUpSize(const std::uint8_t* code, float u, float v) const
{
  const int size = sizes_[*code & PackedFormat::HeaderMask];
  const std::uint8_t* texels = code + 1;
  if (size == 1)
  {
    return decoded_[texels[0]];
  }
  const BilinearTexels at =
    bilinearTexels(size, { static_cast<double>(u), static_cast<double>(v) });
  float value = 0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    value += at.weight[i] * decoded_[texels[at.index[i]]];
  }
  return value;
}

void PackedTextures::addComponents(const std::uint8_t* code, std::size_t lane,
  const TexelLookup& lookup, ComponentBlock& block) const
{
  const std::size_t i = block.count++;
  const std::size_t c = (*code & PackedFormat::HeaderMask) - PackedFormat::SizeKinds;
  block.code[i] = code;
  block.words[i] = PackedFormat::ClassWords[c];
  block.layout[i] = &layouts_[c];
  block.texels[i] = { basisAt(lookup.texel[0][lane]), basisAt(lookup.texel[1][lane]),
    basisAt(lookup.texel[2][lane]), basisAt(lookup.texel[3][lane]) };
  const float x = lookup.columnWeight[lane], y = lookup.rowWeight[lane];
  block.weights[i] = { (1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y };
}

void PackedTextures::lookUp(const std::uint8_t* const* codes, const std::size_t* lanes,
  std::size_t count, const TexelLookup& lookup, float* values) const
{
  ComponentBlock block;
  std::array<std::size_t, ComponentBlock::Size> places;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint8_t* texture = codes[i];
    if ((*texture & PackedFormat::HeaderMask) < PackedFormat::SizeKinds)
    {
      values[i] = lookUpSize(texture, lookup.u[lanes[i]], lookup.v[lanes[i]]);
      continue;
    }
    places[block.count] = i;
    addComponents(texture, lanes[i], lookup, block);
  }
  lookUpComponents(block);
  for (std::size_t i = 0; i < block.count; ++i)
  {
    values[places[i]] = std::clamp(block.values[i], 0.0f, maximum_);
  }
}

void PackedTextures::decode(std::size_t first, float* texture) const
{
  TexelLookup lookup;
  std::array<const std::uint8_t*, TexelLookup::Size> codes;
  std::array<std::size_t, TexelLookup::Size> lanes;
  codes.fill(code(first));
  for (std::int32_t row = 0; row < resolution_; ++row)
  {
    for (std::int32_t column = 0; column < resolution_;)
    {
      std::size_t count = 0;
      for (; count < TexelLookup::Size && column < resolution_; ++count, ++column)
      {
        lanes[count] = count;
        lookup.u[count] = (static_cast<float>(column) + 0.5f) / static_cast<float>(resolution_);
        lookup.v[count] = (static_cast<float>(row) + 0.5f) / static_cast<float>(resolution_);
        for (std::int32_t(&texel)[TexelLookup::Size] : lookup.texel)
        {
          texel[count] = row * resolution_ + column;
        }
        lookup.rowWeight[count] = lookup.columnWeight[count] = 0;
      }
      lookUp(codes.data(), lanes.data(), count, lookup, texture);
      texture += count;
    }
  }
}
}
