// SPDX-License-Identifier: BSD-3-Clause
#include "ParticleText.h"

#include <algorithm>
#include <stdexcept>

namespace po
{
namespace
{
[[noreturn]] void endsEarly(std::size_t found, std::size_t count)
{
  throw std::runtime_error("ends after " + std::to_string(found) + " of the " +
    std::to_string(count) + " particles of a frame");
}

void addWord(TextColumn& column, std::string_view word, std::size_t particle)
{
  const auto number = numberIn(word);
  if (particle == 0 ? !number.has_value() : column.isText())
  {
    column.words.emplace_back(word);
    return;
  }
  if (!number)
  {
    throw std::runtime_error("has '" + std::string(word.substr(0, 40)) + "' for " + column.name +
      " of particle " + std::to_string(particle + 1) + ", which is no number");
  }
  column.numbers.push_back(*number);
}

auto find(std::vector<TextColumn>& columns, const std::string& name)
{
  return std::find_if(
    columns.begin(), columns.end(), [&](const TextColumn& column) { return column.name == name; });
}
}

const ParticleTextFormat* formatOf(TextLines& lines)
{
  std::vector<std::string_view> words;
  while (const auto line = lines.next())
  {
    splitWords(*line, words);
    if (words.empty())
    {
      continue;
    }
    if (words[0] == "ITEM:")
    {
      return &lammpsDumpFormat();
    }
    const bool isCount =
      words.size() == 1 && words[0].find_first_not_of("0123456789") == std::string_view::npos;
    return isCount ? &xyzFormat() : nullptr;
  }
  return nullptr;
}

std::vector<TextColumn> readColumns(TextLines& lines, std::size_t count,
  const std::vector<std::string>& names, const ReadProgress& progress)
{
  constexpr std::size_t RowsAReport = 1 << 16;
  std::vector<TextColumn> columns;
  for (const std::string& name : names)
  {
    columns.push_back({ name, {}, {} });
  }
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto line = lines.next();
    if (!line)
    {
      endsEarly(i, count);
    }
    splitWords(*line, words);
    if (words.size() != names.size())
    {
      throw std::runtime_error("has " + std::to_string(words.size()) + " values for particle " +
        std::to_string(i + 1) + " of a frame, not " + std::to_string(names.size()));
    }
    for (std::size_t k = 0; k < names.size(); ++k)
    {
      addWord(columns[k], words[k], i);
    }
    if (i % RowsAReport == 0 && !progress(static_cast<double>(i) / static_cast<double>(count)))
    {
      return columns;
    }
  }
  return columns;
}

void skipLines(TextLines& lines, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!lines.next())
    {
      endsEarly(i, count);
    }
  }
}

std::vector<double> takeNumbers(std::vector<TextColumn>& columns, const std::string& name)
{
  const auto found = find(columns, name);
  if (found->isText())
  {
    throw std::runtime_error("has words in the column " + name + ", not numbers");
  }
  std::vector<double> numbers = std::move(found->numbers);
  columns.erase(found);
  return numbers;
}

bool hasColumn(const std::vector<TextColumn>& columns, const std::string& name)
{
  return std::any_of(
    columns.begin(), columns.end(), [&](const TextColumn& column) { return column.name == name; });
}
}
