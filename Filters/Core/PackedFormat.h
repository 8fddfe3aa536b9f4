// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_PackedFormat_h
#define po_PackedFormat_h

#include "TextureBasis.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace po
{
/// How textures of different lengths lie in one table of bytes.
///
/// A texture takes some words of 4 bytes and is known by the first one. The low half of its first
/// byte says what follows:
///
/// - k below 8: n x n texels, where n is textureSizes(resolution)[k], one byte each from the second
///   byte on, as UInt8Gamma2;
/// - 8 + c: coefficients in the basis, in classWords(c) words. They are unsigned numbers of
///   classBits[c][k] bits for component k, one after the other from the fifth bit on, low bits
///   first; see Quantizer. The texture is the mean plus the components times their coefficients,
///   limited to 0 and the maximum.
///
/// Unused bits are 0.
struct PackedFormat
{
  static constexpr std::size_t WordBytes = 4;
  static constexpr int SizeKinds = 8;
  static constexpr std::array<std::size_t, 8> ClassWords = { 2, 3, 4, 5, 6, 8, 12, 16 };
  static constexpr std::size_t MostWords = ClassWords.back();
  static constexpr int HeaderBits = 4;
  static constexpr std::uint8_t HeaderMask = (1 << HeaderBits) - 1;

  int resolution = 0;                               ///< T
  double maximum = 0;                               ///< the scale of UInt8Gamma2
  TextureBasis basis;                               ///< empty: sizes only
  std::vector<std::vector<std::uint8_t>> classBits; ///< of each class; as many as there are

  /// Words of n x n texels and their header.
  [[nodiscard]] static constexpr std::size_t sizeWords(int size)
  {
    const auto side = static_cast<std::size_t>(size);
    return (1 + side * side + WordBytes - 1) / WordBytes;
  }

  /// Bits of a class' coefficients.
  [[nodiscard]] static constexpr int classBitCount(std::size_t words)
  {
    return static_cast<int>(8 * WordBytes * words) - HeaderBits;
  }

  /// Words of a texture with such a first byte, 0 if there is none.
  [[nodiscard]] std::size_t wordsOf(std::uint8_t header) const;

  /// Throws std::invalid_argument that tells what cannot be; after that nothing read by this format
  /// leaves its bounds.
  void check() const;

  [[nodiscard]] bool operator==(const PackedFormat& other) const;
};

/// "7665,77665": the bits of all classes as text, and back; the latter throws
/// std::invalid_argument.
[[nodiscard]] std::string textOfClassBits(const std::vector<std::vector<std::uint8_t>>& bits);
[[nodiscard]] std::vector<std::vector<std::uint8_t>> classBitsOf(const std::string& text);
}

#endif
