// SPDX-License-Identifier: BSD-3-Clause
#include "TextureStorageTestSupport.h"

#include "ComponentPacker.h"
#include "OcclusionTextures.h"
#include "TextureIntake.h"

#include <gtest/gtest.h>

namespace
{
using namespace storage_test;

TEST(TextureIntake, ParticlesThatNoLightReachesShareOneRow)
{
  // Before and after the first open texel, from which on textures are made bytes at once.
  for (const Storage storage : { Storage::Full, Storage::VariableSize, Storage::OneValue })
  {
    BakeSettings settings;
    settings.textureResolution = 4;
    settings.storage = storage;
    TextureIntake intake(settings, 6);
    const std::vector<float> gray(16, 0.25f), open(16, 1.0f), dark(16, 0.0f), whole(16, 1.0f);
    intake.add(gray.data(), whole.data());
    intake.addDark();
    intake.add(open.data(), whole.data());
    intake.addDark();
    intake.add(dark.data(), whole.data());
    intake.addDark();
    std::vector<std::int32_t> rowOf;
    const EncodedTable table = intake.finish(0, ProcessGroup::alone(), rowOf);
    ASSERT_EQ(rowOf.size(), 6u);
    EXPECT_EQ(table.textures, 3u);
    EXPECT_NE(rowOf[0], rowOf[1]);
    EXPECT_NE(rowOf[1], rowOf[2]);
    for (const std::size_t place : { 3u, 4u, 5u })
    {
      EXPECT_EQ(rowOf[place], rowOf[1]) << place;
    }
  }
}

TEST(VariableSize, NoTextureIsOffByMoreThanIsAllowed)
{
  for (const int resolution : { 1, 2, 12, 16, 64 })
  {
    for (const double error : { 0.01, 0.03 })
    {
      const Stored stored(resolution, Storage::VariableSize, error);
      for (const double d : stored.differences())
      {
        // At full size bytes round by up to half a step, which is below these errors.
        ASSERT_LE(d, error + 1e-6) << resolution;
      }
    }
  }
}

TEST(VariableSize, TakesLessThanFullTexturesAndFlatOnesOnce)
{
  const Stored stored(16, Storage::VariableSize, 0.03);
  EXPECT_LT(stored.table.bytes.size(), 0.7 * 256 * static_cast<double>(stored.full.rows()));
  EXPECT_EQ(stored.packedRows[0], stored.packedRows[10]);
  EXPECT_EQ(stored.packedRows.back(), -1);
}

TEST(Compressed, KeepsToTheErrorOverAllAndThriceForEach)
{
  for (const int resolution : { 4, 16, 32 })
  {
    for (const double error : { 0.01, 0.03 })
    {
      const Stored stored(resolution, Storage::Compressed, error);
      const std::vector<double> all = stored.differences();
      // All textures but those of one value are in the sample here.
      EXPECT_LE(rmsOf(all), error) << resolution;
      EXPECT_LE(*std::max_element(all.begin(), all.end()),
        ComponentPacker::LargestDifference * error + 1e-4);
      // What is reported does not know that values are limited to 0 and the maximum.
      EXPECT_LE(rmsOf(all), stored.table.difference + 1e-6);
      EXPECT_NEAR(stored.table.difference, rmsOf(all), 0.06 * error);
    }
  }
}

TEST(Compressed, TakesLessWhereMoreIsAllowed)
{
  const Stored fine(16, Storage::Compressed, 0.01), coarse(16, Storage::Compressed, 0.03),
    noisy(16, Storage::Compressed, 0.01, 0.04);
  EXPECT_LT(fine.table.size(), 0.8 * 256 * fine.full.rows());
  EXPECT_LT(coarse.table.size(), 0.6 * static_cast<double>(fine.table.size()));
  EXPECT_LT(noisy.table.size(), fine.table.size());
  EXPECT_LE(rmsOf(noisy.differences()), allowedDifference(0.01, 0.04));
}

TEST(Compressed, DarkAndOpenStayExact)
{
  const Stored stored(16, Storage::Compressed, 0.03);
  const OcclusionTextures textures(stored.packed, 16, stored.packedRows.data(), nullptr);
  EXPECT_EQ(textures.at(0, { 0.3f, 0.4f, 0.5f }), 0.0f);
  EXPECT_NEAR(textures.at(1, { 0.3f, 0.4f, 0.5f }), 1.0f, 0.004f);
}

TEST(Compressed, IsTheSameForAnyOrderOfTheTextures)
{
  const Stored stored(16, Storage::Compressed, 0.02);
  TextureTable reversed(16, 0);
  std::vector<std::int32_t> rows;
  for (std::size_t i = stored.rowOf.size() - 1; i-- > 0;)
  {
    rows.push_back(reversed.insert(stored.textureAt(i)));
  }
  BakeSettings settings;
  settings.storage = Storage::Compressed;
  settings.storageError = 0.02;
  const EncodedTable other =
    storeTextures(std::move(reversed), settings, Maximum, 0, ProcessGroup::alone(), rows);
  EXPECT_TRUE(other.packed == stored.table.packed);
  const PackedTextures packed(
    other.packed, other.bytes.data(), static_cast<std::size_t>(other.rows));
  std::vector<float> a(256), b(256);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    packed.decode(static_cast<std::size_t>(rows[i]), a.data());
    stored.packed->decode(
      static_cast<std::size_t>(stored.packedRows[rows.size() - 1 - i]), b.data());
    ASSERT_EQ(a, b) << i;
  }
}
}
