// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextLines_h
#define po_TextLines_h

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace po
{
/// The lines of a text file, plain or gzipped.
class TextLines
{
public:
  /// Throws std::runtime_error if the file cannot be opened.
  explicit TextLines(const std::string& path);
  ~TextLines();

  TextLines(const TextLines&) = delete;
  TextLines& operator=(const TextLines&) = delete;

  /// Without its end; valid until the next call. Nothing at the end of the file. Throws
  /// std::runtime_error where the file is damaged.
  std::optional<std::string_view> next();

  /// The line that next() gave comes again; once after each.
  void putBack();

  /// Of the line that comes next, in bytes of the unpacked text.
  [[nodiscard]] std::int64_t offset() const { return offset_; }

  /// Going back in a gzipped file costs reading it from the start.
  void seek(std::int64_t offset);

private:
  bool fill();

  struct File;
  std::unique_ptr<File> file_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0; ///< of what was not given out yet
  std::size_t end_ = 0;
  std::size_t last_ = 0; ///< bytes of the line that was given out last
  std::int64_t offset_ = 0;
};

/// The words of a line, between blanks.
void splitWords(std::string_view line, std::vector<std::string_view>& words);

/// A number as C writes them; nothing if the word is none.
[[nodiscard]] std::optional<double> numberIn(std::string_view word);

/// A whole number; throws std::runtime_error that says what it should be.
[[nodiscard]] std::int64_t wholeNumberIn(std::string_view line, const char* what);
}

#endif
