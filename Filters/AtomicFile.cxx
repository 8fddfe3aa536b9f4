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

fs::path FollowLink(const fs::path& path)
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

// What a rename would silently replace although the user could not have written to it.
std::string ReasonNotToReplace(const fs::path& target)
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

fs::path PartialName(const fs::path& target)
{
  std::random_device entropy;
  fs::path partial = target;
  partial += ".partial-" + std::to_string(entropy());
  return partial;
}

std::string SystemReason(int code)
{
  return code ? std::generic_category().message(code) : std::string("unknown reason");
}

}

AtomicFile::AtomicFile(const std::string& target)
  : Target(FollowLink(target))
  , Partial(PartialName(Target))
{
  const std::string reason = ReasonNotToReplace(this->Target);
  if (!reason.empty())
  {
    throw std::runtime_error("Cannot write \"" + this->Target.string() + "\": " + reason + ".");
  }
  errno = 0;
  this->Stream.open(this->Partial, std::ios::binary | std::ios::trunc);
  if (!this->Stream)
  {
    throw std::runtime_error("Cannot write \"" + this->Target.string() +
      "\": " + SystemReason(errno) + "; check that the folder exists and is writable.");
  }
}

AtomicFile::~AtomicFile()
{
  this->Stream.close();
  std::error_code ignored;
  fs::remove(this->Partial, ignored);
}

void AtomicFile::Fail(const char* action)
{
  if (this->Failure.empty())
  {
    this->Failure = "Cannot write \"" + this->Target.string() + "\": " + action +
      " failed: " + SystemReason(errno) +
      "; free space or choose another folder. Nothing was changed on disk.";
  }
  throw std::runtime_error(this->Failure);
}

void AtomicFile::Write(const char* bytes, std::streamsize count)
{
  errno = 0;
  if (!this->Stream.write(bytes, count))
  {
    this->Fail("writing");
  }
}

void AtomicFile::Seek(std::streamoff position)
{
  errno = 0;
  if (!this->Stream.seekp(position))
  {
    this->Fail("writing");
  }
}

std::streamoff AtomicFile::Position() noexcept
{
  const std::streamoff position = this->Stream.tellp();
  return position < 0 ? 0 : position;
}

void AtomicFile::Commit()
{
  errno = 0;
  if (this->Failure.empty())
  {
    this->Stream.close();
  }
  if (!this->Failure.empty() || !this->Stream)
  {
    this->Fail("writing");
  }
  std::error_code error;
  fs::rename(this->Partial, this->Target, error);
  if (error)
  {
    errno = error.value();
    this->Fail("renaming the finished file");
  }
}

}
