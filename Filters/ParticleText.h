// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ParticleText_h
#define po_ParticleText_h

// Particles in text files: what LAMMPS dumps and XYZ files have in common.

#include "TextLines.h"
#include "Vec3.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace po
{
/// Where a frame begins.
struct FramePlace
{
  double time = 0;
  std::int64_t offset = 0;
};

/// Values of a column, a particle each: numbers, or words where the first one is no number.
struct TextColumn
{
  std::string name;
  std::vector<double> numbers;
  std::vector<std::string> words;

  [[nodiscard]] bool isText() const { return !words.empty(); }
};

/// The particles of a frame.
struct ParticleFrame
{
  std::vector<Vec3d> positions;
  std::vector<TextColumn> columns; ///< all others
};

/// Called now and then with the share that is read; false stops, and the frame is worthless.
using ReadProgress = std::function<bool(double)>;

/// A format of text files. Messages of std::runtime_error go on after the name of the file.
struct ParticleTextFormat
{
  /// Appends the place of every whole frame from here on; throws std::runtime_error where one is
  /// broken, after those before it.
  void (*findFrames)(TextLines& lines, std::vector<FramePlace>& frames);

  /// Reads the frame that begins here.
  ParticleFrame (*readFrame)(TextLines& lines, const ReadProgress& progress);
};

/// "ITEM: ..." frames of LAMMPS' dump styles atom and custom, with orthogonal and triclinic boxes
/// and scaled coordinates; the particles come in the order of their ids. Time is the time step.
[[nodiscard]] const ParticleTextFormat& lammpsDumpFormat();

/// Frames of a number of atoms, a comment, and a line an atom: element, x, y, z and more, or what
/// Properties=... of an extended XYZ comment says. Time is the number of the frame, from 0.
[[nodiscard]] const ParticleTextFormat& xyzFormat();

/// The format of a file, by its first line that is not empty; null if it is neither.
[[nodiscard]] const ParticleTextFormat* formatOf(TextLines& lines);

/// Reads `count` lines of one word for each name.
[[nodiscard]] std::vector<TextColumn> readColumns(TextLines& lines, std::size_t count,
  const std::vector<std::string>& names, const ReadProgress& progress);

/// Passes over that many lines; throws std::runtime_error if there are fewer.
void skipLines(TextLines& lines, std::size_t count);

/// The column of that name, taken out of them; throws std::runtime_error if it holds words.
[[nodiscard]] std::vector<double> takeNumbers(
  std::vector<TextColumn>& columns, const std::string& name);

[[nodiscard]] bool hasColumn(const std::vector<TextColumn>& columns, const std::string& name);
}

#endif
