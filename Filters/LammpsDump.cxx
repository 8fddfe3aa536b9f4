// SPDX-License-Identifier: BSD-3-Clause

// LAMMPS text dumps: https://docs.lammps.org/dump.html and, for triclinic boxes,
// https://docs.lammps.org/Howto_triclinic.html

#include "ParticleText.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace po
{
namespace
{
/// Low and high along each axis, and the tilts xy, xz, yz, as the dump has them.
struct Box
{
  std::array<double, 3> low{}, high{}, tilt{};
};

struct Header
{
  std::int64_t step = 0;
  std::size_t count = 0;
  std::optional<Box> box;
  std::vector<std::string> names;
};

std::string_view nextLine(TextLines& lines)
{
  const auto line = lines.next();
  if (!line)
  {
    throw std::runtime_error("ends within the header of a frame");
  }
  return *line;
}

Box readBox(TextLines& lines)
{
  Box box;
  std::vector<std::string_view> words;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    splitWords(nextLine(lines), words);
    const auto number = [&](std::size_t i) { return i < words.size() ? numberIn(words[i]) : 0.0; };
    if (words.size() < 2 || !number(0) || !number(1) || !number(2))
    {
      throw std::runtime_error("has no numbers for BOX BOUNDS");
    }
    box.low[axis] = *number(0);
    box.high[axis] = *number(1);
    box.tilt[axis] = *number(2);
  }
  return box;
}

std::size_t readCount(TextLines& lines)
{
  const std::int64_t count = wholeNumberIn(nextLine(lines), "the number of atoms");
  if (count < 0)
  {
    throw std::runtime_error("has a negative number of atoms");
  }
  return static_cast<std::size_t>(count);
}

/// Up to the first particle; nothing at the end of the file.
std::optional<Header> readHeader(TextLines& lines)
{
  Header header;
  bool hasStep = false, hasCount = false;
  std::vector<std::string_view> words;
  while (const auto line = lines.next())
  {
    splitWords(*line, words);
    if (words.empty())
    {
      continue;
    }
    if (words[0] != "ITEM:" || words.size() < 2)
    {
      throw std::runtime_error("has '" + std::string(line->substr(0, 40)) +
        "' where a line of a LAMMPS dump that begins with 'ITEM:' should be");
    }
    if (words[1] == "TIMESTEP")
    {
      header.step = wholeNumberIn(nextLine(lines), "the time step");
      hasStep = true;
    }
    else if (words[1] == "NUMBER" && words.back() == "ATOMS")
    {
      header.count = readCount(lines);
      hasCount = true;
    }
    else if (words[1] == "BOX")
    {
      header.box = readBox(lines);
    }
    else if (words[1] == "ATOMS")
    {
      if (!hasStep || !hasCount)
      {
        throw std::runtime_error(
          "has no ITEM: TIMESTEP or no ITEM: NUMBER OF ATOMS before its atoms");
      }
      header.names.assign(words.begin() + 2, words.end());
      return header;
    }
    else if (words[1] == "UNITS" || words[1] == "TIME")
    {
      nextLine(lines);
    }
    else
    {
      throw std::runtime_error("is no dump of atoms: it has '" + std::string(*line) + "'");
    }
  }
  if (hasStep)
  {
    throw std::runtime_error("ends within the header of a frame");
  }
  return std::nullopt;
}

void findDumpFrames(TextLines& lines, std::vector<FramePlace>& frames)
{
  for (std::int64_t offset = lines.offset();; offset = lines.offset())
  {
    const auto header = readHeader(lines);
    if (!header)
    {
      return;
    }
    skipLines(lines, header->count);
    frames.push_back({ static_cast<double>(header->step), offset });
  }
}

/// The bounds in the dump are those of the parallelepiped; the edges begin at its corner.
Vec3d unscaled(Vec3d s, const Box& box)
{
  const auto [xy, xz, yz] = box.tilt;
  const double xLow = box.low[0] - std::min({ 0.0, xy, xz, xy + xz });
  const double xHigh = box.high[0] - std::max({ 0.0, xy, xz, xy + xz });
  const double yLow = box.low[1] - std::min(0.0, yz);
  const double yHigh = box.high[1] - std::max(0.0, yz);
  return { xLow + s.x * (xHigh - xLow) + s.y * xy + s.z * xz,
    yLow + s.y * (yHigh - yLow) + s.z * yz, box.low[2] + s.z * (box.high[2] - box.low[2]) };
}

std::vector<Vec3d> takePositions(std::vector<TextColumn>& columns, const Header& header)
{
  for (const std::string suffix : { "", "u", "s", "su" })
  {
    if (!hasColumn(columns, "x" + suffix) || !hasColumn(columns, "y" + suffix) ||
      !hasColumn(columns, "z" + suffix))
    {
      continue;
    }
    const bool isScaled = suffix[0] == 's';
    if (isScaled && !header.box)
    {
      throw std::runtime_error("has scaled coordinates, but no ITEM: BOX BOUNDS");
    }
    const auto x = takeNumbers(columns, "x" + suffix), y = takeNumbers(columns, "y" + suffix),
               z = takeNumbers(columns, "z" + suffix);
    std::vector<Vec3d> positions(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
    {
      const Vec3d p{ x[i], y[i], z[i] };
      positions[i] = isScaled ? unscaled(p, *header.box) : p;
    }
    return positions;
  }
  std::string names;
  for (const std::string& name : header.names)
  {
    names += " " + name;
  }
  throw std::runtime_error("has no coordinates among its columns" + names +
    ": x y z, xu yu zu, xs ys zs or xsu ysu zsu are needed");
}

template <typename Value>
void permute(std::vector<Value>& values, const std::vector<std::size_t>& order)
{
  if (values.empty())
  {
    return;
  }
  std::vector<Value> sorted;
  sorted.reserve(values.size());
  for (const std::size_t i : order)
  {
    sorted.push_back(std::move(values[i]));
  }
  values = std::move(sorted);
}

/// LAMMPS writes particles in an order that changes from step to step.
void sortById(ParticleFrame& frame)
{
  const auto ids = std::find_if(frame.columns.begin(), frame.columns.end(),
    [](const TextColumn& column) { return column.name == "id"; });
  if (ids == frame.columns.end() || ids->isText())
  {
    return;
  }
  std::vector<std::size_t> order(frame.positions.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return ids->numbers[a] < ids->numbers[b]; });
  permute(frame.positions, order);
  for (TextColumn& column : frame.columns)
  {
    permute(column.numbers, order);
    permute(column.words, order);
  }
}

ParticleFrame readDumpFrame(TextLines& lines, const ReadProgress& progress)
{
  const auto header = readHeader(lines);
  ParticleFrame frame;
  frame.columns = readColumns(lines, header->count, header->names, progress);
  frame.positions = takePositions(frame.columns, *header);
  sortById(frame);
  return frame;
}
}

const ParticleTextFormat& lammpsDumpFormat()
{
  static const ParticleTextFormat format{ findDumpFrames, readDumpFrame };
  return format;
}
}
