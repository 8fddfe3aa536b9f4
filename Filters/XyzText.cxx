// SPDX-License-Identifier: BSD-3-Clause

// XYZ files, and the extended ones of ASE and OVITO: a comment with
// Properties=species:S:1:pos:R:3:...

#include "ParticleText.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace po
{
namespace
{
struct Header
{
  std::size_t count = 0;
  std::string comment;
};

/// Nothing at the end of the file.
std::optional<Header> readHeader(TextLines& lines)
{
  while (const auto line = lines.next())
  {
    if (line->find_first_not_of(" \t") == std::string_view::npos)
    {
      continue;
    }
    const std::int64_t count = wholeNumberIn(*line, "the number of atoms of a frame");
    if (count < 0)
    {
      throw std::runtime_error("has a negative number of atoms");
    }
    const auto comment = lines.next();
    return Header{ static_cast<std::size_t>(count), std::string(comment.value_or("")) };
  }
  return std::nullopt;
}

void findXyzFrames(TextLines& lines, std::vector<FramePlace>& frames)
{
  for (std::size_t number = 0;; ++number)
  {
    const std::int64_t offset = lines.offset();
    const auto header = readHeader(lines);
    if (!header)
    {
      return;
    }
    skipLines(lines, header->count);
    frames.push_back({ static_cast<double>(number), offset });
  }
}

std::vector<std::string> fieldsOf(const std::string& text)
{
  std::vector<std::string> fields(1);
  for (const char c : text)
  {
    if (c == ':')
    {
      fields.emplace_back();
    }
    else
    {
      fields.back() += c;
    }
  }
  return fields;
}

/// Of three columns that are a vector: name_x, name_y, name_z; of others of several name_0, name_1.
void addNames(const std::string& name, std::int64_t size, std::vector<std::string>& names)
{
  if (size == 1)
  {
    names.push_back(name == "species" ? "element" : name);
    return;
  }
  for (std::int64_t i = 0; i < size; ++i)
  {
    if (name == "pos")
    {
      names.emplace_back(1, "xyz"[std::min<std::int64_t>(i, 2)]);
    }
    else
    {
      names.push_back(name + "_" + (size == 3 ? std::string(1, "xyz"[i]) : std::to_string(i)));
    }
  }
}

/// What an extended comment says; empty if it says nothing.
std::vector<std::string> namesIn(const std::string& comment)
{
  const std::string key = "Properties=";
  const std::size_t found = comment.find(key);
  if (found == std::string::npos)
  {
    return {};
  }
  std::string text = comment.substr(found + key.size());
  text.erase(0, text[0] == '"');
  text = text.substr(0, text.find_first_of(" \t\""));
  const std::vector<std::string> fields = fieldsOf(text);
  std::vector<std::string> names;
  for (std::size_t i = 0; i + 2 < fields.size(); i += 3)
  {
    const std::int64_t size = wholeNumberIn(fields[i + 2], "a number of columns in Properties");
    if (size < 1 || size > 1000)
    {
      throw std::runtime_error("has a wrong number of columns in " + key + text);
    }
    addNames(fields[i], size, names);
  }
  for (const char* axis : { "x", "y", "z" })
  {
    if (std::count(names.begin(), names.end(), axis) != 1)
    {
      throw std::runtime_error("has no pos:R:3 in " + key + text);
    }
  }
  return names;
}

std::vector<std::string> plainNames(TextLines& lines)
{
  std::vector<std::string_view> words;
  splitWords(lines.next().value_or(""), words);
  const std::size_t width = words.size();
  lines.putBack();
  if (width < 4)
  {
    throw std::runtime_error("has a line of " + std::to_string(width) +
      " values: an element and three coordinates are needed");
  }
  std::vector<std::string> names{ "element", "x", "y", "z" };
  for (std::size_t i = names.size(); i < width; ++i)
  {
    names.push_back("column" + std::to_string(i + 1));
  }
  return names;
}

ParticleFrame readXyzFrame(TextLines& lines, const ReadProgress& progress)
{
  const auto header = readHeader(lines);
  ParticleFrame frame;
  if (header->count == 0)
  {
    return frame;
  }
  std::vector<std::string> names = namesIn(header->comment);
  if (names.empty())
  {
    names = plainNames(lines);
  }
  frame.columns = readColumns(lines, header->count, names, progress);
  const auto x = takeNumbers(frame.columns, "x"), y = takeNumbers(frame.columns, "y"),
             z = takeNumbers(frame.columns, "z");
  frame.positions.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    frame.positions[i] = { x[i], y[i], z[i] };
  }
  return frame;
}
}

const ParticleTextFormat& xyzFormat()
{
  static const ParticleTextFormat format{ findXyzFrames, readXyzFrame };
  return format;
}
}
