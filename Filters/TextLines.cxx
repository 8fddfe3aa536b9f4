// SPDX-License-Identifier: BSD-3-Clause
#include "TextLines.h"

#include "vtk_zlib.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>
#include <stdexcept>

namespace po
{
namespace
{
bool isBlank(char c)
{
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}
}

struct TextLines::File
{
  explicit File(const std::string& path)
    : handle(gzopen(path.c_str(), "rb"))
  {
    if (!handle)
    {
      throw std::runtime_error("cannot be opened");
    }
    gzbuffer(handle, 1 << 18);
  }
  ~File() { gzclose(handle); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  [[noreturn]] void fail() const
  {
    int code = 0;
    throw std::runtime_error(std::string("is damaged: ") + gzerror(handle, &code));
  }

  gzFile handle; ///< of zlib, which reads plain files as they are
};

TextLines::TextLines(const std::string& path)
  : file_(std::make_unique<File>(path))
  , buffer_(1 << 20)
{
}

TextLines::~TextLines() = default;

/// Reads on behind what is left; false at the end of the file.
bool TextLines::fill()
{
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (end_ == buffer_.size())
  {
    buffer_.resize(2 * buffer_.size()); // a longer line than that
  }
  const int count =
    gzread(file_->handle, buffer_.data() + end_, static_cast<unsigned>(buffer_.size() - end_));
  int code = Z_OK;
  gzerror(file_->handle, &code);
  if (count < 0 || code == Z_BUF_ERROR)
  {
    file_->fail(); // the latter: a packed file that breaks off
  }
  end_ += static_cast<std::size_t>(count);
  return count > 0;
}

std::optional<std::string_view> TextLines::next()
{
  std::size_t searched = 0;
  for (;;)
  {
    const char* first = buffer_.data() + begin_;
    const auto* found =
      static_cast<const char*>(std::memchr(first + searched, '\n', end_ - begin_ - searched));
    const std::size_t left = end_ - begin_;
    if (!found)
    {
      searched = left;
      if (fill())
      {
        continue;
      }
      if (left == 0)
      {
        return std::nullopt;
      }
    }
    first = buffer_.data() + begin_;
    const std::size_t length = found ? static_cast<std::size_t>(found - first) : left;
    const std::size_t taken = found ? length + 1 : length;
    begin_ += taken;
    last_ = taken;
    offset_ += static_cast<std::int64_t>(taken);
    std::string_view line(first, length);
    if (!line.empty() && line.back() == '\r')
    {
      line.remove_suffix(1);
    }
    return line;
  }
}

void TextLines::putBack()
{
  begin_ -= last_;
  offset_ -= static_cast<std::int64_t>(last_);
  last_ = 0;
}

void TextLines::seek(std::int64_t offset)
{
  if (gzseek(file_->handle, static_cast<z_off_t>(offset), SEEK_SET) < 0)
  {
    file_->fail();
  }
  begin_ = end_ = 0;
  offset_ = offset;
}

void splitWords(std::string_view line, std::vector<std::string_view>& words)
{
  words.clear();
  const char* const end = line.data() + line.size();
  const char* first = line.data();
  while (first != end)
  {
    const char* const start = std::find_if_not(first, end, isBlank);
    first = std::find_if(start, end, isBlank);
    if (start != first)
    {
      words.emplace_back(start, static_cast<std::size_t>(first - start));
    }
  }
}

std::optional<double> numberIn(std::string_view word)
{
  const char* first = word.data();
  const char* const last = first + word.size();
  first += first != last && *first == '+';
  double value = 0;
  const auto [end, error] = std::from_chars(first, last, value);
  // What is too small or too large for a double is 0 or infinite in C, and an error here.
  const bool isNumber = end == last && first != last &&
    (error == std::errc() || error == std::errc::result_out_of_range);
  return isNumber ? std::optional<double>(value) : std::nullopt;
}

std::int64_t wholeNumberIn(std::string_view line, const char* what)
{
  std::vector<std::string_view> words;
  splitWords(line, words);
  std::int64_t value = 0;
  if (words.size() == 1)
  {
    const char* const last = words[0].data() + words[0].size();
    const auto [end, error] = std::from_chars(words[0].data(), last, value);
    if (end == last && error == std::errc())
    {
      return value;
    }
  }
  throw std::runtime_error(
    "has '" + std::string(line.substr(0, 40)) + "' where " + what + " should be");
}
}
