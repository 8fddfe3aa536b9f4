// SPDX-License-Identifier: BSD-3-Clause
#include "PackedFormat.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace po
{
std::size_t PackedFormat::wordsOf(std::uint8_t header) const
{
  const int kind = header & HeaderMask;
  if (kind >= SizeKinds)
  {
    const auto c = static_cast<std::size_t>(kind - SizeKinds);
    return c < classBits.size() ? ClassWords[c] : 0;
  }
  const int sizeBefore = kind == 0 ? 0 : 1 << (kind - 1);
  return sizeBefore < resolution ? sizeWords(std::min(1 << kind, resolution)) : 0;
}

void PackedFormat::check() const
{
  if (resolution < 1 || resolution > 1 << (SizeKinds - 1))
  {
    throw std::invalid_argument("textures of variable length have 1 to 128 texels on a side");
  }
  if (!(maximum >= 0) || !std::isfinite(maximum))
  {
    throw std::invalid_argument("the maximum is negative or not finite");
  }
  if (classBits.size() > ClassWords.size())
  {
    throw std::invalid_argument("there are more lengths of coefficients than are known");
  }
  if (classBits.empty())
  {
    return;
  }
  if (basis.resolution != resolution || basis.numbers.size() < basis.texels() ||
    basis.numbers.size() % basis.texels() != 0)
  {
    throw std::invalid_argument("the basis is not of the textures' resolution");
  }
  if (!(basis.scale > 0) || !std::isfinite(basis.scale))
  {
    throw std::invalid_argument("the scale of the basis is not positive");
  }
  for (std::size_t c = 0; c < classBits.size(); ++c)
  {
    const auto& bits = classBits[c];
    const bool each = std::all_of(
      bits.begin(), bits.end(), [](std::uint8_t b) { return b <= Quantizer::MaximumBits; });
    if (!each || bits.size() > basis.components() ||
      std::accumulate(bits.begin(), bits.end(), 0) > classBitCount(ClassWords[c]))
    {
      throw std::invalid_argument("the bits of the coefficients do not fit");
    }
  }
}

bool PackedFormat::operator==(const PackedFormat& other) const
{
  return resolution == other.resolution && maximum == other.maximum &&
    basis.scale == other.basis.scale && basis.numbers == other.basis.numbers &&
    classBits == other.classBits;
}

std::string textOfClassBits(const std::vector<std::vector<std::uint8_t>>& classes)
{
  std::string text;
  for (const auto& bits : classes)
  {
    text += text.empty() ? "" : ",";
    std::transform(bits.begin(), bits.end(), std::back_inserter(text),
      [](std::uint8_t b) { return static_cast<char>('0' + b); });
  }
  return text;
}

std::vector<std::vector<std::uint8_t>> classBitsOf(const std::string& text)
{
  std::vector<std::vector<std::uint8_t>> classes;
  for (const char c : text.empty() ? text : "," + text)
  {
    if (c == ',')
    {
      classes.emplace_back();
    }
    else if (c >= '0' && c <= '0' + Quantizer::MaximumBits)
    {
      classes.back().push_back(static_cast<std::uint8_t>(c - '0'));
    }
    else
    {
      throw std::invalid_argument("the bits of the coefficients are not digits from 0 to 8");
    }
  }
  return classes;
}
}
