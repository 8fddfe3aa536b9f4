// SPDX-License-Identifier: BSD-3-Clause
#ifndef AtomicFile_h
#define AtomicFile_h

#include "ParticleOcclusionFiltersModule.h"

#include <filesystem>
#include <fstream>
#include <string>

namespace po
{

/**
 * A file that appears under its name only when it is complete.
 *
 * Bytes go to "<name>.partial-<unique>" beside the target, so that Commit() is a rename inside one
 * file system. A target that existed before keeps its content until then. The destructor removes
 * what was not committed.
 *
 * All members report failure by a std::runtime_error that names the file and the system's reason.
 */
class PARTICLEOCCLUSIONFILTERS_EXPORT AtomicFile
{
public:
  /// Opens the partial file. A symbolic link is followed, so that the link itself survives.
  explicit AtomicFile(const std::string& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends or overwrites at the current position.
  void Write(const char* bytes, std::streamsize count);
  void Seek(std::streamoff position);
  /// The current position; 0 after a failure. Never throws: OpenEXR asks in destructors.
  std::streamoff Position() noexcept;

  /// Closes the file and gives it its name. Fails if any write or seek before failed, even when the
  /// exception of that time was swallowed.
  void Commit();

private:
  [[noreturn]] void Fail(const char* action);

  std::filesystem::path Target;
  std::filesystem::path Partial;
  std::ofstream Stream;
  std::string Failure;
};

}

#endif
