// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SharedWords_h
#define po_SharedWords_h

#include "ProcessGroup.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace po
{
inline constexpr std::size_t WordBytes = sizeof(std::uint64_t);

/// Words that so many bytes take.
[[nodiscard]] constexpr std::size_t wordsFor(std::size_t bytes)
{
  return (bytes + WordBytes - 1) / WordBytes;
}

/// Appends values of a trivial type to what processes exchange, and zeros up to the next whole
/// word.
template <typename Value>
void appendValues(const std::vector<Value>& values, ProcessGroup::Words& words)
{
  const std::size_t end = words.size(), bytes = values.size() * sizeof(Value);
  words.resize(end + wordsFor(bytes));
  if (bytes > 0)
  {
    std::memcpy(words.data() + end, values.data(), bytes);
  }
}

/// `count` values that appendValues() has written.
template <typename Value>
[[nodiscard]] std::vector<Value> valuesAt(const std::uint64_t* words, std::size_t count)
{
  std::vector<Value> values(count);
  if (count > 0)
  {
    std::memcpy(values.data(), words, count * sizeof(Value));
  }
  return values;
}
}

#endif
