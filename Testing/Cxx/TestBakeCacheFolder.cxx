// SPDX-License-Identifier: BSD-3-Clause
/// The folder of bakes that are kept on disk: its faults, its limit, and several that use it.

#include "BakeCacheTestSupport.h"

#include <chrono>
#include <cstdlib>
#include <thread>

namespace fs = std::filesystem;
using namespace bake_cache;

namespace
{
std::string onlyFileIn(const std::string& folder)
{
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder))
  {
    files.push_back(entry.path().string());
  }
  EXPECT_EQ(files.size(), 1u);
  return files.empty() ? "" : files.front();
}

std::size_t filesIn(const std::string& folder)
{
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}
}

TEST(BakeCache, DamagedEntriesAreNoticedAndReplaced)
{
  TemporaryFolder folder;
  const std::string cache = folder.file("cache");
  const auto data = cloud();
  const CachedBake first(cache, data);
  const std::string entry = onlyFileIn(cache);
  const Bytes whole = readBytes(entry);
  forEachDamage(whole, 40,
    [&](const Bytes& damaged)
    {
      writeBytes(entry, damaged);
      const CachedBake bake(cache, data);
      EXPECT_EQ(bake.loaded(), damaged == whole);
      if (damaged != whole)
      {
        EXPECT_TRUE(oneMessage(bake.warnings, "will be replaced"));
      }
      EXPECT_EQ(onlyFileIn(cache), entry);
      EXPECT_TRUE(CachedBake(cache, data).loaded());
      expectSameOutput(first.data(), bake.data());
    });
}

TEST(BakeCache, AnEntryOfOtherDataIsNotUsed)
{
  TemporaryFolder folder;
  const CachedBake first(folder.file("a"), cloud(1));
  const CachedBake other(folder.file("b"), cloud(2));
  writeBytes(onlyFileIn(folder.file("a")), readBytes(onlyFileIn(folder.file("b"))));
  const CachedBake again(folder.file("a"), cloud(1));
  EXPECT_FALSE(again.loaded());
  EXPECT_TRUE(oneMessage(again.warnings, "other particles"));
  expectSameOutput(first.data(), again.data());
}

TEST(BakeCache, AFolderThatCannotBeMadeIsOneWarning)
{
  TemporaryFolder folder;
  writeBytes(folder.file("file"), { 'x' });
  const CachedBake bake(folder.file("file") + "/cache", cloud());
  EXPECT_TRUE(oneMessage(bake.warnings, "CacheDirectory"));
  EXPECT_EQ(bake.filter->GetNumberOfParticles(), Particles);
  EXPECT_FALSE(bake.loaded());
  EXPECT_EQ(folder.count(), 1u);
}

#ifndef _WIN32
TEST(BakeCache, AFullDiskIsOneWarningAndLeavesNoFile)
{
  TemporaryFolder folder;
  const CachedBake full = [&]
  {
    const FileSizeLimit limit(2000);
    return CachedBake(folder.file("cache"), cloud());
  }();
  EXPECT_TRUE(oneMessage(full.warnings, "not kept"));
  EXPECT_EQ(filesIn(folder.file("cache")), 0u);
  EXPECT_EQ(full.filter->GetNumberOfParticles(), Particles);
}

TEST(BakeCache, WithoutAFolderItIsInTheUsersCacheDirectory)
{
  TemporaryFolder folder;
  const char* before = std::getenv("XDG_CACHE_HOME");
  const std::string kept = before ? before : "";
  setenv("XDG_CACHE_HOME", folder.file("xdg").c_str(), 1);
  const CachedBake bake("", cloud());
  before ? setenv("XDG_CACHE_HOME", kept.c_str(), 1) : unsetenv("XDG_CACHE_HOME");
  EXPECT_TRUE(bake.warnings.empty());
  EXPECT_EQ(filesIn(folder.file("xdg/ParticleOcclusion")), 1u);
}
#endif

namespace
{
/// About 0.4 MiB each.
CachedBake largeBake(const std::string& folder, int seed, int limit)
{
  return CachedBake(folder, cloud(seed),
    [=](Filter* f)
    {
      f->SetTextureResolution(32);
      f->SetSamplesPerTexel(1);
      f->SetCacheSizeLimit(limit);
    });
}
}

TEST(BakeCache, WhatWasUsedLeastRecentlyIsRemovedBeyondTheLimit)
{
  TemporaryFolder folder;
  const std::string cache = folder.file("cache");
  const auto bake = [&](int seed, int limit) { return largeBake(cache, seed, limit).loaded(); };
  EXPECT_FALSE(bake(1, 1));
  EXPECT_FALSE(bake(2, 1));
  for (const auto& entry : fs::directory_iterator(cache))
  {
    fs::last_write_time(entry, fs::file_time_type::clock::now() - std::chrono::hours(1));
  }
  EXPECT_TRUE(bake(1, 1));  // used: 2 is now the oldest
  EXPECT_FALSE(bake(3, 1)); // too much
  EXPECT_EQ(filesIn(cache), 2u);
  EXPECT_TRUE(bake(1, 1));
  EXPECT_TRUE(bake(3, 1));
  EXPECT_FALSE(bake(2, 0)); // no limit
  EXPECT_FALSE(bake(4, 0));
  EXPECT_EQ(filesIn(cache), 4u);
}

TEST(BakeCache, AnEntryBeyondTheLimitIsAWarning)
{
  TemporaryFolder folder;
  const CachedBake bake(folder.file("cache"), cloud(),
    [](Filter* f)
    {
      f->SetTextureResolution(64);
      f->SetSamplesPerTexel(1);
      f->SetCacheSizeLimit(1);
    });
  EXPECT_TRUE(oneMessage(bake.warnings, "2 MiB are more than CacheSizeLimit"));
  EXPECT_EQ(folder.count(), 0u);
}

TEST(BakeCache, WhatACrashLeftBehindIsRemovedInTheEnd)
{
  TemporaryFolder folder;
  const std::string cache = folder.file("cache");
  fs::create_directory(cache);
  const std::string young = cache + "/0.pobake.partial-1", old = cache + "/0.pobake.partial-2";
  const std::string foreign = cache + "/notes.txt";
  for (const std::string& file : { young, old, foreign })
  {
    writeBytes(file, { 'x' });
    fs::last_write_time(
      file, fs::file_time_type::clock::now() - std::chrono::hours(file == young ? 1 : 48));
  }
  ASSERT_FALSE(CachedBake(cache, cloud()).loaded());
  EXPECT_TRUE(fs::exists(young));
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(foreign));
}

TEST(BakeCache, ManyMayUseAFolderAtTheSameTime)
{
  TemporaryFolder folder;
  const std::string cache = folder.file("cache");
  std::vector<vtkSmartPointer<vtkPolyData>> expected;
  for (int seed = 0; seed < 4; ++seed)
  {
    expected.push_back(largeBake(folder.file("other"), seed, 0).data());
  }
  std::vector<std::thread> users;
  for (int user = 0; user < 3; ++user)
  {
    users.emplace_back(
      [&, user]
      {
        for (int i = 0; i < 8; ++i)
        {
          const int seed = (user + i) % 4;
          const CachedBake bake = largeBake(cache, seed, 1); // so that entries come and go
          EXPECT_TRUE(bake.warnings.empty()) << bake.warnings.front();
          expectSameOutput(expected[static_cast<std::size_t>(seed)], bake.data());
        }
      });
  }
  for (std::thread& user : users)
  {
    user.join();
  }
}
