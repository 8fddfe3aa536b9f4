// SPDX-License-Identifier: BSD-3-Clause
#include "ProcessGroup.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <numeric>

namespace po
{
std::uint64_t wordOf(double value)
{
  std::uint64_t word = 0;
  std::memcpy(&word, &value, sizeof(word));
  return word;
}

double doubleOf(std::uint64_t word)
{
  double value = 0;
  std::memcpy(&value, &word, sizeof(value));
  return value;
}

const ProcessGroup& ProcessGroup::alone()
{
  static const ProcessGroup group;
  return group;
}

std::vector<std::int64_t> ProcessGroup::exchange(std::int64_t own) const
{
  return { own };
}

void ProcessGroup::transfer(
  int, const Words& own, const std::vector<std::int64_t>&, Words& all) const
{
  all = own;
}

std::vector<std::int64_t> ProcessGroup::lengthsOfAll(std::int64_t own) const
{
  std::vector<std::int64_t> lengths = exchange(own);
  const std::int64_t worst = *std::min_element(lengths.begin(), lengths.end());
  if (worst < 0)
  {
    throw WorkStopped(static_cast<WorkState>(worst), "");
  }
  return lengths;
}

ProcessGroup::Words ProcessGroup::gatherWords(int destination, const Words& own) const
{
  const std::vector<std::int64_t> lengths = lengthsOfAll(static_cast<std::int64_t>(own.size()));
  Words all;
  try
  {
    if (destination < 0 || destination == rank())
    {
      all.resize(
        static_cast<std::size_t>(std::accumulate(lengths.begin(), lengths.end(), std::int64_t(0))));
    }
  }
  catch (const std::bad_alloc&)
  {
    stop(WorkState::Failed);
    throw WorkStopped(WorkState::Failed, "Memory ran out while particles of other processes came.");
  }
  agree(); // all have the memory
  transfer(destination, own, lengths, all);
  return all;
}

ProcessGroup::Words ProcessGroup::gather(const Words& own) const
{
  return size() == 1 ? own : gatherWords(-1, own);
}

ProcessGroup::Words ProcessGroup::gatherAt(int destination, const Words& own) const
{
  return size() == 1 ? own : gatherWords(destination, own);
}

void ProcessGroup::agree() const
{
  static_cast<void>(lengthsOfAll(0));
}

void ProcessGroup::stop(WorkState state) const
{
  static_cast<void>(exchange(static_cast<std::int64_t>(state)));
}

std::uint64_t ProcessGroup::sum(std::uint64_t own) const
{
  const Words all = gather({ own });
  return std::accumulate(all.begin(), all.end(), std::uint64_t(0));
}

double ProcessGroup::sum(double own) const
{
  double total = 0;
  for (const std::uint64_t word : gather({ wordOf(own) }))
  {
    total += doubleOf(word);
  }
  return total;
}

double ProcessGroup::largest(double own) const
{
  double largest = own;
  for (const std::uint64_t word : gather({ wordOf(own) }))
  {
    largest = std::max(largest, doubleOf(word));
  }
  return largest;
}

bool ProcessGroup::any(bool own) const
{
  return sum(std::uint64_t(own ? 1 : 0)) > 0;
}
}
