// SPDX-License-Identifier: BSD-3-Clause
#include "BakeCache.h"

#include "BakeEntry.h"
#include "BakeKey.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace fs = std::filesystem;

namespace po
{
namespace
{
constexpr const char* EntryExtension = ".pobake";
constexpr double BytesPerMebibyte = 1024.0 * 1024.0;

/// A file that is being written has this in its name (see AtomicFile); one that has not changed
/// for a day was left behind by a crash.
constexpr const char* PartialMark = ".pobake.partial-";
constexpr std::chrono::hours PartialLife(24);

/// A directory from the environment; empty if it is not set or relative.
fs::path environmentPath(const char* variable)
{
  const char* value = std::getenv(variable);
  const fs::path path = value ? value : "";
  return path.is_absolute() ? path : fs::path();
}

struct CacheFile
{
  fs::path path;
  fs::file_time_type used;
  std::uintmax_t bytes = 0;
};

/// What others remove meanwhile is left out.
std::vector<CacheFile> filesOf(const std::string& directory)
{
  std::vector<CacheFile> files;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error))
  {
    std::error_code gone;
    CacheFile file{ entry->path(), entry->last_write_time(gone), 0 };
    file.bytes = gone ? 0 : entry->file_size(gone);
    if (!gone)
    {
      files.push_back(std::move(file));
    }
  }
  return files;
}

bool isPartial(const CacheFile& file)
{
  return file.path.filename().string().find(PartialMark) != std::string::npos;
}

void remove(const CacheFile& file)
{
  std::error_code ignored; // another process may have been faster
  fs::remove(file.path, ignored);
}

void removeLeftPartials(const std::vector<CacheFile>& files)
{
  const auto now = fs::file_time_type::clock::now();
  for (const CacheFile& file : files)
  {
    if (isPartial(file) && now - file.used > PartialLife)
    {
      remove(file);
    }
  }
}

/// Removes entries from the one least recently used on, but for the one that is kept.
void removeBeyond(double limit, std::vector<CacheFile> files, const fs::path& kept)
{
  files.erase(std::remove_if(files.begin(), files.end(),
                [](const CacheFile& file) { return file.path.extension() != EntryExtension; }),
    files.end());
  std::sort(files.begin(), files.end(),
    [](const CacheFile& a, const CacheFile& b) { return a.used < b.used; });
  double bytes = 0;
  for (const CacheFile& file : files)
  {
    bytes += static_cast<double>(file.bytes);
  }
  for (const CacheFile& file : files)
  {
    if (bytes > limit && file.path.filename() != kept.filename())
    {
      remove(file);
      bytes -= static_cast<double>(file.bytes);
    }
  }
}

/// The text on the first process that has one; empty on the others.
std::string ofFirstProcess(std::string text, const ProcessGroup& group)
{
  const ProcessGroup::Words have = group.gather({ text.empty() ? 0u : 1u });
  const auto first = std::find(have.begin(), have.end(), 1u) - have.begin();
  return first == group.rank() ? std::move(text) : std::string();
}

/// The cache of one bake. Notes what goes wrong instead of throwing it; memory that is missing is
/// an error of the bake itself.
class CacheOfBake
{
public:
  CacheOfBake(const CacheSettings& settings, std::string key)
    : key_(std::move(key))
  {
    note(NotKept, [&] { cache_ = BakeCache(cacheDirectory(settings), settings.sizeLimit); });
  }

  bool load(std::size_t particles, BakeResult& result, BakeReport& report)
  {
    bool loaded = false;
    note("", [&] { loaded = cache_ && cache_->load(key_, particles, result, report); });
    return loaded;
  }

  void store(const BakeResult& result, const BakeReport& report)
  {
    if (cache_)
    {
      note(NotKept, [&] { cache_->store(key_, result, report); });
    }
  }

  [[nodiscard]] const std::string& problem() const { return problem_; }

private:
  static constexpr const char* NotKept = "The bake is done, but not kept in a cache: ";

  template <typename Act>
  void note(const char* consequence, const Act& act)
  {
    try
    {
      act();
    }
    catch (const std::bad_alloc&)
    {
      throw;
    }
    catch (const std::exception& error)
    {
      problem_ += (problem_.empty() ? "" : " ") + std::string(consequence) + error.what();
    }
  }

  std::string key_;
  std::optional<BakeCache> cache_;
  std::string problem_;
};
}

std::string cacheDirectory(const CacheSettings& settings)
{
  if (!settings.directory.empty())
  {
    return settings.directory;
  }
  const fs::path home = environmentPath("HOME");
  const fs::path inHome = home.empty() ? home : home / ".cache";
  for (const fs::path& base :
    { environmentPath("XDG_CACHE_HOME"), inHome, environmentPath("LOCALAPPDATA") })
  {
    if (!base.empty())
    {
      return (base / "ParticleOcclusion").string();
    }
  }
  throw std::runtime_error("The environment names no directory for caches (XDG_CACHE_HOME, "
                           "HOME); set CacheDirectory.");
}

BakeCache::BakeCache(std::string directory, int sizeLimit)
  : directory_(std::move(directory))
  , limit_(sizeLimit > 0 ? sizeLimit * BytesPerMebibyte : std::numeric_limits<double>::infinity())
{
}

std::string BakeCache::fileOf(const std::string& key) const
{
  return (fs::path(directory_) / (key + EntryExtension)).string();
}

bool BakeCache::load(
  const std::string& key, std::size_t particles, BakeResult& result, BakeReport& report) const
{
  const std::string file = fileOf(key);
  std::error_code error;
  if (!fs::exists(file, error))
  {
    return false;
  }
  readEntry(file, key, particles, result, report);
  fs::last_write_time(file, fs::file_time_type::clock::now(), error); // fails where read-only
  return true;
}

void BakeCache::store(
  const std::string& key, const BakeResult& result, const BakeReport& report) const
{
  const double bytes = bytesOfEntry(result);
  if (bytes > limit_)
  {
    throw std::runtime_error("Its " +
      std::to_string(static_cast<long long>(std::ceil(bytes / BytesPerMebibyte))) +
      " MiB are more than CacheSizeLimit allows.");
  }
  std::error_code error;
  fs::create_directories(directory_, error);
  if (error)
  {
    throw std::runtime_error("Cannot make the folder \"" + directory_ + "\": " + error.message() +
      ". Set CacheDirectory to a folder that you may write to, or turn UseCache off.");
  }
  const std::string file = fileOf(key);
  writeEntry(file, key, result, report);
  const std::vector<CacheFile> files = filesOf(directory_);
  removeLeftPartials(files);
  removeBeyond(limit_, files, file);
}

BakeResult bakeOrLoad(const CacheSettings& settings, int method, BakeTask& task,
  const ProcessGroup& group, Progress& progress, BakeReport& report, BakeReuse& reuse,
  std::string& warning)
{
  if (!settings.use)
  {
    return bakeByMethod(method, task, group, progress, report, reuse);
  }
  CacheOfBake cache(settings, bakeKey(method, task, group));
  BakeResult result;
  BakeReport found = report;
  const bool loaded = cache.load(task.receivers.size(), result, found);
  if (!group.any(!loaded))
  {
    report = found;
    report.loaded = true;
    return result;
  }
  result = bakeByMethod(method, task, group, progress, report, reuse);
  if (!result.aborted)
  {
    cache.store(result, report);
    warning = ofFirstProcess(cache.problem(), group);
  }
  return result;
}
}
