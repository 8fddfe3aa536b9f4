// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_AtomicFile_h
#define po_AtomicFile_h

#include "ParticleOcclusionFiltersModule.h"

#include <filesystem>
#include <fstream>
#include <string>

namespace po
{
/// A file that appears under its name only when it is complete.
///
/// Bytes go to "<name>.partial-<unique>" beside the target, so that commit() is a rename inside one
/// file system. A target that existed before keeps its content until then. The destructor removes
/// what was not committed.
///
/// All members report failure by a std::runtime_error that names the file and the system's reason.
class PARTICLEOCCLUSIONFILTERS_EXPORT AtomicFile
{
public:
  /// Opens the partial file. A symbolic link is followed, so that the link itself survives.
  explicit AtomicFile(const std::string& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends or overwrites at the current position.
  void write(const char* bytes, std::streamsize count);
  void seek(std::streamoff position);
  /// The current position; 0 after a failure. Never throws: OpenEXR asks in destructors.
  std::streamoff position() noexcept;

  /// Closes the file and gives it its name. Fails if any write or seek before failed, even when the
  /// exception of that time was swallowed.
  void commit();

private:
  [[noreturn]] void fail(const char* action);

  std::filesystem::path target_;
  std::filesystem::path partial_;
  std::ofstream stream_;
  std::string failure_;
};
}

#endif
