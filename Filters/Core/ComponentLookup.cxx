// SPDX-License-Identifier: BSD-3-Clause
#include "ComponentLookup.h"

#include <algorithm>
#include <cstring>

// Highway compiles this file once for each instruction set and chooses when it runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ComponentLookup.cxx"
#include <hwy/foreach_target.h> // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace po::HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

/// Coefficients of one texture; room for the most that a code can hold, and the mean's.
struct Coefficients
{
  static constexpr std::size_t Most = 8 * PackedFormat::WordBytes * PackedFormat::MostWords;
  alignas(64) float values[Most + ComponentBlock::Pad];
};

/// Four coefficients that lie in a window of 16 bytes.
inline void unpackFour(
  const std::uint8_t* window, const CoefficientLayout::Four& four, float* target)
{
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t i = 0; i < 4; ++i)
  {
    const std::uint32_t word =
      window[four.bytes[4 * i]] | std::uint32_t(window[four.bytes[4 * i + 1]]) << 8;
    const auto number = static_cast<float>(word >> four.shift[i] & four.mask[i]);
    target[i] = number * four.scale[i] + four.offset[i];
  }
#else
  const hn::FixedTag<std::uint8_t, 16> bytes;
  const hn::FixedTag<std::uint32_t, 4> integers;
  const hn::FixedTag<std::int32_t, 4> signedIntegers;
  const hn::FixedTag<float, 4> floats;
  const auto shuffled =
    hn::TableLookupBytes(hn::LoadU(bytes, window), hn::Load(bytes, four.bytes.data()));
  const auto number =
    hn::And(hn::Shr(hn::BitCast(integers, shuffled), hn::Load(integers, four.shift.data())),
      hn::Load(integers, four.mask.data()));
  const auto value = hn::ConvertTo(floats, hn::BitCast(signedIntegers, number));
  hn::Store(
    hn::MulAdd(value, hn::Load(floats, four.scale.data()), hn::Load(floats, four.offset.data())),
    floats, target);
#endif
}

inline void unpack(const std::uint8_t* code, std::size_t words, const CoefficientLayout& layout,
  Coefficients& coefficients)
{
  // A copy, since windows reach beyond the end of the code.
  std::uint8_t local[PackedFormat::WordBytes * PackedFormat::MostWords + 16];
  std::memcpy(local, code, PackedFormat::WordBytes * words);
  std::memset(local + PackedFormat::WordBytes * words, 0, 16);
  float* target = coefficients.values;
  for (const CoefficientLayout::Four& four : layout.fours)
  {
    unpackFour(local + four.window, four, target);
    target += 4;
  }
}

inline float blend(const Coefficients& coefficients, std::size_t padded,
  const std::array<const float*, 4>& texels, const std::array<float, 4>& weights)
{
  const hn::CappedTag<float, ComponentBlock::Pad> d;
  auto sum = hn::Zero(d);
  const auto w0 = hn::Set(d, weights[0]), w1 = hn::Set(d, weights[1]), w2 = hn::Set(d, weights[2]),
             w3 = hn::Set(d, weights[3]);
  for (std::size_t k = 0; k < padded; k += hn::Lanes(d))
  {
    auto row = hn::Mul(w0, hn::LoadU(d, texels[0] + k));
    row = hn::MulAdd(w1, hn::LoadU(d, texels[1] + k), row);
    row = hn::MulAdd(w2, hn::LoadU(d, texels[2] + k), row);
    row = hn::MulAdd(w3, hn::LoadU(d, texels[3] + k), row);
    sum = hn::MulAdd(row, hn::Load(d, coefficients.values + k), sum);
  }
  return hn::GetLane(hn::SumOfLanes(d, sum));
}

void lookUpComponents(ComponentBlock& block)
{
  Coefficients coefficients;
  const std::uint8_t* known = nullptr;
  for (std::size_t i = 0; i < block.count; ++i)
  {
    if (block.code[i] != known)
    {
      known = block.code[i];
      unpack(known, block.words[i], *block.layout[i], coefficients);
    }
    block.values[i] =
      blend(coefficients, block.layout[i]->padded, block.texels[i], block.weights[i]);
  }
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace po
{
HWY_EXPORT(lookUpComponents);

CoefficientLayout::CoefficientLayout(const std::vector<std::uint8_t>& bits)
  : padded((1 + bits.size() + ComponentBlock::Pad - 1) / ComponentBlock::Pad * ComponentBlock::Pad)
{
  std::size_t position = PackedFormat::HeaderBits;
  for (std::size_t first = 0; first < padded; first += 4)
  {
    Four four{};
    four.window = position / 8;
    for (std::size_t i = 0; i < 4; ++i)
    {
      const std::size_t entry = first + i; // 0 is the mean
      const int b = entry >= 1 && entry <= bits.size() ? bits[entry - 1] : 0;
      for (std::size_t byte = 0; byte < 2; ++byte) // 7 bits of shift and 8 of the number
      {
        four.bytes[4 * i + byte] = static_cast<std::uint8_t>(position / 8 - four.window + byte);
      }
      four.bytes[4 * i + 2] = four.bytes[4 * i + 3] = four.bytes[4 * i];
      four.shift[i] = static_cast<std::uint32_t>(position % 8);
      four.mask[i] = (1u << b) - 1;
      four.scale[i] = static_cast<float>(Quantizer::Steps[static_cast<std::size_t>(b)]);
      four.offset[i] = entry == 0 ? 1.0f : Quantizer::decode(0, b);
      position += static_cast<std::size_t>(b);
    }
    fours.push_back(four);
  }
}

void lookUpComponents(ComponentBlock& block)
{
  HWY_DYNAMIC_DISPATCH(lookUpComponents)(block);
}
}
#endif
