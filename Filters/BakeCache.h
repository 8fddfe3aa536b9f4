// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakeCache_h
#define po_BakeCache_h

#include "BakeMethods.h"

#include <string>

namespace po
{
/// What the user says of the cache.
struct CacheSettings
{
  bool use = false;
  std::string directory; ///< empty: that of the user
  int sizeLimit = 4096;  ///< MiB; 0 = none
};

/// Where entries go: the directory of the settings, else `ParticleOcclusion` in $XDG_CACHE_HOME,
/// ~/.cache, or on Windows %LOCALAPPDATA%. Throws a std::runtime_error where there is none of
/// these.
[[nodiscard]] std::string cacheDirectory(const CacheSettings& settings);

/// Results of bakes in a directory, one file each, named by its key.
///
/// Several processes may use a directory at the same time: entries appear when they are complete,
/// and one that vanishes is one that is not there. What was used least recently, by the time of
/// its file, is removed when the directory grows beyond the limit.
class BakeCache
{
public:
  BakeCache(std::string directory, int sizeLimit);

  /// Fills the result and the report if there is an entry, and marks it as used; false if there is
  /// none. Throws what readEntry throws.
  [[nodiscard]] bool load(
    const std::string& key, std::size_t particles, BakeResult& result, BakeReport& report) const;

  /// Makes the directory if need be, writes the entry, and removes older ones beyond the limit.
  /// Throws a std::runtime_error if the entry cannot be written or is itself beyond the limit.
  void store(const std::string& key, const BakeResult& result, const BakeReport& report) const;

private:
  [[nodiscard]] std::string fileOf(const std::string& key) const;

  std::string directory_;
  double limit_; ///< bytes; infinite if there is none
};

/// Loads the result of bakeByMethod, with the same arguments, if every process of the group has it
/// in its cache; else bakes, and keeps the result. BakeReport::loaded says which it was. What goes
/// wrong with the cache does not stop the bake.
/// @param warning what went wrong, on the first process where something did; empty on the others
[[nodiscard]] BakeResult bakeOrLoad(const CacheSettings& settings, int method, BakeTask& task,
  const ProcessGroup& group, Progress& progress, BakeReport& report, BakeReuse& reuse,
  std::string& warning);
}

#endif
