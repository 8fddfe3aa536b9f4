// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ScratchFile_h
#define po_ScratchFile_h

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <mutex>

namespace po
{
/// A file for what does not fit into memory, in the folder for temporary files (TMPDIR). Nobody
/// else sees it, and it is gone with this object, even if the process is killed (elsewhere than on
/// POSIX systems it stays then).
///
/// Threads may call all functions at once. Throws std::runtime_error, which names the folder, where
/// the file cannot be made, written or read.
class ScratchFile
{
public:
  ScratchFile();
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  /// Writes behind all there is.
  /// @return the position of what was written
  std::uint64_t append(const void* bytes, std::size_t count);

  void read(std::uint64_t position, void* bytes, std::size_t count);

  [[nodiscard]] std::uint64_t size() const { return size_; }

private:
  void seek(std::uint64_t position);

  std::filesystem::path path_;
  std::FILE* file_;
  std::uint64_t size_ = 0;
  std::uint64_t position_ = 0; ///< of the file, where the next transfer would begin
  std::mutex mutex_;
};
}

#endif
