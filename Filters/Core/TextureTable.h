// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextureTable_h
#define po_TextureTable_h

#include "BakeSettings.h"
#include "Gamma2.h"
#include "PackedFormat.h"
#include "TexelWeights.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace po
{
/// Tells rows that are known apart from new ones; rows are numbered in the order they first appear.
class RowIndex
{
public:
  using IsEqual = std::function<bool(std::int32_t row)>;

  /// The number of an equal row among those that have such a hash, or `count` if there is none:
  /// then the caller appends it.
  std::int32_t findOrAdd(std::size_t hash, const IsEqual& isEqual, std::int32_t count);

private:
  /// Of a hash table without lists: 11 to 21 bytes a row, where those of the library take 48.
  struct Slot
  {
    std::uint32_t hash = 0;
    std::int32_t row = -1; ///< none
  };

  /// The slot of an equal row, or the empty one where it belongs.
  [[nodiscard]] Slot& find(std::uint32_t hash, const IsEqual& isEqual);
  void grow();

  std::vector<Slot> slots_; ///< as many as a power of two
};

/// The distinct linear textures of a bake, one row of T * T values each, and what their texels
/// count for when they are stored.
class TextureTable
{
public:
  /// `expected` textures are reserved; pages of memory that stay unused cost nothing.
  TextureTable(int resolution, std::size_t expected);

  /// The row that holds a texture, added if none with equal values and weights is there.
  std::int32_t insert(const WeighedTexture& texture);
  std::int32_t insert(const float* values) { return insert({ values, nullptr }); }

  [[nodiscard]] int resolution() const { return resolution_; }
  [[nodiscard]] std::size_t texelsPerRow() const { return texels_; }
  [[nodiscard]] std::int32_t rows() const { return rows_; }
  [[nodiscard]] const std::vector<float>& values() const { return values_; }
  [[nodiscard]] WeighedTexture texture(std::int32_t row) const;
  [[nodiscard]] std::vector<float> takeValues() { return std::move(values_); }
  /// 0 of an empty table.
  [[nodiscard]] double largestValue() const;

private:
  void append(const WeighedTexture& added);

  int resolution_;
  std::size_t texels_;
  std::int32_t rows_ = 0;
  std::vector<float> values_;
  std::vector<std::int32_t> weightsOf_; ///< of the rows up to the last one that has any; or -1
  std::vector<std::uint8_t> weights_;   ///< T * T each
  RowIndex index_;
};

/// A table in the form it is stored in: exactly one of the vectors is filled.
struct EncodedTable
{
  Storage storage = Storage::Full;
  Encoding encoding = Encoding::UInt8Gamma2;
  int resolution = 0;
  std::int32_t rows = 0; ///< tuples: textures, or words of packed ones
  std::size_t textures = 0;
  double maximum = 0; ///< the scale of UInt8Gamma2
  std::vector<std::uint8_t> bytes;
  std::vector<float> floats;
  PackedFormat packed;     ///< of VariableSize and Compressed
  double difference = 0;   ///< RMS over what is visible of all, between what was baked and stored
  double comparedArea = 0; ///< that this is the RMS over, in spheres

  /// Are the textures of different lengths, see PackedFormat?
  [[nodiscard]] bool isPacked() const
  {
    return storage == Storage::VariableSize || storage == Storage::Compressed;
  }

  /// Tuples of the texture that begins at a row.
  [[nodiscard]] std::size_t tuplesAt(std::int32_t row) const
  {
    return isPacked()
      ? packed.wordsOf(bytes[PackedFormat::WordBytes * static_cast<std::size_t>(row)])
      : 1;
  }

  /// Values of a tuple: bytes of a word, or texels.
  [[nodiscard]] std::size_t valuesPerTuple() const
  {
    return isPacked() ? PackedFormat::WordBytes
                      : static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution);
  }

  /// Bytes of the table and its basis.
  [[nodiscard]] std::size_t size() const
  {
    return bytes.size() + sizeof(float) * floats.size() +
      sizeof(std::int16_t) * packed.basis.numbers.size();
  }
};

/// The distinct textures of a bake as bytes of UInt8Gamma2.
class ByteTable
{
public:
  /// @param maximum the scale, at least as large as any value
  /// @param expected textures are reserved
  ByteTable(int resolution, double maximum, std::size_t expected);

  /// The row that holds the bytes of a texture, added if no equal ones are there.
  std::int32_t insert(const float* texture);

  /// Inserts all textures of a table.
  /// @param rowOf the row of each particle, changed to the rows of this; negative entries stay
  void insertAll(const TextureTable& table, std::vector<std::int32_t>& rowOf);
  /// The same, of textures that are visited in the order of their rows.
  /// @param forEach calls its argument for each
  void insertAll(const std::function<void(const std::function<void(const float*)>&)>& forEach,
    std::vector<std::int32_t>& rowOf);

  /// Gives up what it holds.
  [[nodiscard]] EncodedTable take();

private:
  EncodedTable encoded_;
  std::vector<std::uint8_t> row_; ///< of the texture at hand
  RowIndex index_;
};

/// Encodes a table and gives up its values. Textures that become equal by rounding are merged.
///
/// @param rowOf the row of each particle, changed to the rows of the encoded table; negative
/// entries (no texture) stay
/// @param maximum the scale; at least the table's largest value
[[nodiscard]] EncodedTable encode(
  TextureTable&& table, Encoding encoding, std::vector<std::int32_t>& rowOf, double maximum);

/// The same with the table's largest value as scale.
[[nodiscard]] EncodedTable encode(
  TextureTable&& table, Encoding encoding, std::vector<std::int32_t>& rowOf);
}

#endif
