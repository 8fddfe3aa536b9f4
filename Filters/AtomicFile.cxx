// SPDX-License-Identifier: BSD-3-Clause
#include "AtomicFile.h"

#include <cerrno>
#include <random>
#include <stdexcept>
#include <system_error>

namespace fs = std::filesystem;

namespace po
{
namespace
{
fs::path followLink(const fs::path& path)
{
  std::error_code ignored;
  if (!fs::is_symlink(path, ignored))
  {
    return path;
  }
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error);
  return error ? path : real;
}

/// What a rename would silently replace although the user could not have written to it.
std::string reasonNotToReplace(const fs::path& target)
{
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (!fs::exists(status))
  {
    return {};
  }
  if (fs::is_directory(status))
  {
    return "it is a folder; choose a file name inside it";
  }
  if (!fs::is_regular_file(status))
  {
    return "it is a device or a pipe; choose an ordinary file name";
  }
  if ((status.permissions() & fs::perms::owner_write) == fs::perms::none)
  {
    return "it is write-protected; choose another name or make it writable";
  }
  return {};
}

fs::path partialName(const fs::path& target)
{
  std::random_device entropy;
  fs::path partial = target;
  partial += ".partial-" + std::to_string(entropy());
  return partial;
}

std::string systemReason(int code)
{
  return code ? std::generic_category().message(code) : std::string("unknown reason");
}
}

AtomicFile::AtomicFile(const std::string& target)
  : target_(followLink(target))
  , partial_(partialName(target_))
{
  const std::string reason = reasonNotToReplace(target_);
  if (!reason.empty())
  {
    throw std::runtime_error("Cannot write \"" + target_.string() + "\": " + reason + ".");
  }
  errno = 0;
  stream_.open(partial_, std::ios::binary | std::ios::trunc);
  if (!stream_)
  {
    throw std::runtime_error("Cannot write \"" + target_.string() + "\": " + systemReason(errno) +
      "; check that the folder exists and is writable.");
  }
}

AtomicFile::~AtomicFile()
{
  stream_.close();
  std::error_code ignored;
  fs::remove(partial_, ignored);
}

void AtomicFile::fail(const char* action)
{
  if (failure_.empty())
  {
    failure_ = "Cannot write \"" + target_.string() + "\": " + action +
      " failed: " + systemReason(errno) +
      "; free space or choose another folder. Nothing was changed on disk.";
  }
  throw std::runtime_error(failure_);
}

void AtomicFile::write(const char* bytes, std::streamsize count)
{
  errno = 0;
  if (!stream_.write(bytes, count))
  {
    fail("writing");
  }
}

void AtomicFile::seek(std::streamoff position)
{
  errno = 0;
  if (!stream_.seekp(position))
  {
    fail("writing");
  }
}

std::streamoff AtomicFile::position() noexcept
{
  const std::streamoff position = stream_.tellp();
  return position < 0 ? 0 : position;
}

void AtomicFile::commit()
{
  errno = 0;
  if (failure_.empty())
  {
    stream_.close();
  }
  if (!failure_.empty() || !stream_)
  {
    fail("writing");
  }
  std::error_code error;
  fs::rename(partial_, target_, error);
  if (error)
  {
    errno = error.value();
    fail("renaming the finished file");
  }
}
}
