// SPDX-License-Identifier: BSD-3-Clause
#include "ScratchFile.h"

#include <cerrno>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>

namespace fs = std::filesystem;

namespace po
{
namespace
{
[[noreturn]] void fail(const char* action, const fs::path& file)
{
  throw std::runtime_error(std::string("Cannot ") + action + " the temporary file \"" +
    file.string() + "\" of a bake out of core: " +
    (errno != 0 ? std::generic_category().message(errno) : std::string("unknown reason")) +
    ". Set the environment variable TMPDIR to a folder with room, or turn OutOfCore off.");
}

fs::path newName()
{
  std::error_code error;
  const fs::path folder = fs::temp_directory_path(error);
  if (error)
  {
    errno = error.value();
    fail("find a folder for", "ParticleOcclusion");
  }
  std::random_device entropy;
  return folder /
    ("ParticleOcclusion-" + std::to_string(entropy()) + "-" + std::to_string(entropy()));
}

/// From the beginning of the file.
int seekTo(std::FILE* file, std::uint64_t position)
{
#ifdef _WIN32
  return _fseeki64(file, static_cast<long long>(position), SEEK_SET);
#else
  return fseeko(file, static_cast<off_t>(position), SEEK_SET);
#endif
}
}

ScratchFile::ScratchFile()
  : path_(newName())
{
  errno = 0;
  file_ = std::fopen(path_.string().c_str(), "w+bx");
  if (!file_)
  {
    fail("make", path_);
  }
  std::setvbuf(file_, nullptr, _IONBF, 0); // what is written comes in large pieces
#ifndef _WIN32
  std::error_code ignored;
  fs::remove(path_, ignored); // it lasts as long as it is open
#endif
}

ScratchFile::~ScratchFile()
{
  std::fclose(file_);
#ifdef _WIN32
  std::error_code ignored;
  fs::remove(path_, ignored);
#endif
}

void ScratchFile::seek(std::uint64_t position)
{
  // Between writing and reading there must be a seek, even to the same place.
  if (seekTo(file_, position) != 0)
  {
    fail("search", path_);
  }
  position_ = position;
}

std::uint64_t ScratchFile::append(const void* bytes, std::size_t count)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  errno = 0;
  if (position_ != size_)
  {
    seek(size_);
  }
  if (std::fwrite(bytes, 1, count, file_) != count)
  {
    fail("write", path_);
  }
  const std::uint64_t start = size_;
  size_ += count;
  position_ = size_;
  return start;
}

void ScratchFile::read(std::uint64_t position, void* bytes, std::size_t count)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  errno = 0;
  seek(position);
  if (std::fread(bytes, 1, count, file_) != count)
  {
    fail("read", path_);
  }
  position_ = size_ + 1; // so that writing seeks
}
}
