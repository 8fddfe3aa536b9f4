// SPDX-License-Identifier: BSD-3-Clause
// Textures that are loaded while they are seen: the store alone.
#include "PagedTexturesTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <set>

namespace
{
using namespace paged_textures;

std::vector<std::int32_t> residentOf(const PagedTextures& paged)
{
  std::vector<std::int32_t> rows;
  for (std::int32_t row = 0; row < static_cast<std::int32_t>(paged.size()); ++row)
  {
    if (paged.find(row) != nullptr)
    {
      rows.push_back(row);
    }
  }
  return rows;
}

/// A view of some textures, with all that comes of it.
void show(PagedTextures& paged, const std::vector<std::int32_t>& rows)
{
  paged.beginView();
  (void)paged.demand(rows);
  paged.wait();
}

TEST(PagedTextures, HoldWhatIsAskedForWithTheSourcesTexels)
{
  const auto source = std::make_shared<TableSource>(100);
  PagedTextures paged(source, 100, TextureBytes, 10 * SlotBytes + SlotBytes - 1);
  EXPECT_EQ(paged.capacity(), 10u);
  EXPECT_TRUE(source->reads().empty());
  paged.beginView();
  EXPECT_EQ(paged.demand({ 7, 3, 99 }), 3u);
  EXPECT_TRUE(paged.isLoading());
  EXPECT_EQ(residentOf(paged), std::vector<std::int32_t>{}) << "not before it is collected";
  paged.wait();
  EXPECT_FALSE(paged.isLoading());
  EXPECT_EQ(residentOf(paged), (std::vector<std::int32_t>{ 3, 7, 99 }));
  EXPECT_EQ(source->reads(), (std::vector<std::int32_t>{ 7, 3, 99 })) << "in the order asked for";
  for (const std::int32_t row : { 3, 7, 99 })
  {
    EXPECT_EQ(std::memcmp(paged.find(row), source->texture(row), TextureBytes), 0) << row;
  }
  EXPECT_EQ(paged.demand({ 3, 7 }), 0u);
  EXPECT_EQ(paged.resident(), 3u);
  EXPECT_EQ(paged.bytes(), 3 * SlotBytes);
  EXPECT_EQ(source->reads().size(), 3u) << "nothing is read twice";
}

TEST(PagedTextures, TheLeastRecentlyUsedMakeRoom)
{
  const auto source = std::make_shared<TableSource>(100);
  PagedTextures paged(source, 100, TextureBytes, 10 * SlotBytes);
  show(paged, range(0, 5));
  show(paged, range(5, 10));
  show(paged, range(0, 2)); // used again
  show(paged, range(20, 24));
  EXPECT_EQ(residentOf(paged), (std::vector<std::int32_t>{ 0, 1, 6, 7, 8, 9, 20, 21, 22, 23 }))
    << "2, 3 and 4 had been used longest ago, then 5";
  EXPECT_EQ(paged.bytes(), 10 * SlotBytes);
}

TEST(PagedTextures, WhatAViewShowsInTheEndDependsOnTheViewAndTheBudgetAlone)
{
  const auto source = std::make_shared<TableSource>(1000);
  PagedTextures paged(source, 1000, TextureBytes, 50 * SlotBytes);
  std::mt19937 random(9);
  for (int view = 0; view < 200; ++view)
  {
    std::set<std::int32_t> distinct;
    for (std::size_t count = random() % 100; distinct.size() < count;)
    {
      distinct.insert(static_cast<std::int32_t>(random() % 1000));
    }
    std::vector<std::int32_t> rows(distinct.begin(), distinct.end());
    std::shuffle(rows.begin(), rows.end(), random);
    paged.beginView();
    (void)paged.demand(rows);
    EXPECT_LE(paged.bytes(), 50 * SlotBytes);
    if (view % 3 == 0)
    {
      continue; // a view that is left while its textures come
    }
    paged.wait();
    const std::size_t shown = std::min<std::size_t>(rows.size(), 50);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      ASSERT_EQ(paged.find(rows[i]) != nullptr, i < shown) << view << ' ' << i;
    }
    EXPECT_EQ(paged.demand(rows), rows.size() - shown);
    EXPECT_FALSE(paged.isLoading()) << "what there is no room for is not asked for again";
    EXPECT_LE(paged.bytes(), 50 * SlotBytes);
  }
}

TEST(PagedTextures, AsksOfOneViewAddUp)
{
  const auto source = std::make_shared<TableSource>(100);
  PagedTextures paged(source, 100, TextureBytes, 6 * SlotBytes);
  paged.beginView();
  EXPECT_EQ(paged.demand(range(0, 4)), 4u);
  EXPECT_EQ(paged.demand(range(2, 8)), 6u);
  paged.wait();
  EXPECT_EQ(residentOf(paged), range(0, 6));
  EXPECT_EQ(paged.demand(range(0, 8)), 2u);
}

TEST(PagedTextures, NobodyWaitsForTheSourceAndAnotherViewDropsWhatHasNotCome)
{
  const auto source = std::make_shared<TableSource>(100);
  source->setClosed(true);
  PagedTextures paged(source, 100, TextureBytes, 5 * SlotBytes);
  paged.beginView();
  EXPECT_EQ(paged.demand(range(0, 5)), 5u);
  ASSERT_TRUE(source->waitForReads(1));
  EXPECT_EQ(paged.collect(), 0u);
  EXPECT_FALSE(paged.hasNews());
  paged.beginView(); // while the source still reads the first texture
  EXPECT_FALSE(paged.isLoading());
  EXPECT_EQ(paged.bytes(), 0u);
  EXPECT_EQ(paged.demand(range(10, 15)), 5u) << "the whole budget is there for the new view";
  source->setClosed(false);
  paged.wait();
  EXPECT_EQ(residentOf(paged), range(10, 15));
  EXPECT_EQ(source->reads(), (std::vector<std::int32_t>{ 0, 10, 11, 12, 13, 14 }));
}

TEST(PagedTextures, AFailureEndsLoadingAndKeepsWhatIsThere)
{
  const auto source = std::make_shared<TableSource>(100);
  PagedTextures paged(source, 100, TextureBytes, 50 * SlotBytes);
  show(paged, range(0, 5));
  EXPECT_EQ(paged.error(), "");
  source->setBroken();
  show(paged, range(3, 9));
  EXPECT_EQ(paged.error(), "the source is broken");
  EXPECT_FALSE(paged.isLoading());
  EXPECT_EQ(residentOf(paged), range(0, 5));
  EXPECT_EQ(paged.bytes(), 5 * SlotBytes);
  show(paged, range(50, 60));
  EXPECT_EQ(source->reads().size(), 6u) << "nothing is tried again";
  EXPECT_EQ(paged.demand(range(0, 9)), 4u);
}

TEST(PagedTextures, WithoutABudgetNothingIsRead)
{
  const auto source = std::make_shared<TableSource>(100);
  for (const std::size_t budget : { std::size_t(0), SlotBytes - 1 })
  {
    PagedTextures paged(source, 100, TextureBytes, budget);
    EXPECT_EQ(paged.capacity(), 0u);
    paged.beginView();
    EXPECT_EQ(paged.demand(range(0, 100)), 100u);
    EXPECT_FALSE(paged.isLoading());
    paged.wait();
    EXPECT_EQ(paged.resident(), 0u);
  }
  EXPECT_TRUE(source->reads().empty());
}

TEST(PagedTextures, EndInTheMidstOfReading)
{
  for (int i = 0; i < 20; ++i)
  {
    const auto source = std::make_shared<TableSource>(1000);
    PagedTextures paged(source, 1000, TextureBytes, 1000 * SlotBytes);
    paged.beginView();
    (void)paged.demand(range(0, 1000));
    ASSERT_TRUE(source->waitForReads(static_cast<std::size_t>(i)));
  }
}
}
