// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TemporaryFolder_h
#define po_TemporaryFolder_h

#include <cstddef>
#include <filesystem>
#include <iterator>
#include <random>
#include <string>

/// A folder of its own for a test; removed afterwards.
class TemporaryFolder
{
public:
  TemporaryFolder()
    : path_(std::filesystem::temp_directory_path() /
        ("ParticleOcclusion-" + std::to_string(std::random_device()())))
  {
    std::filesystem::create_directory(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::size_t count() const
  {
    return std::distance(std::filesystem::directory_iterator(path_), {});
  }

private:
  std::filesystem::path path_;
};

#endif
