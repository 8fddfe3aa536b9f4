// SPDX-License-Identifier: BSD-3-Clause
// Textures that are loaded while they are seen: the store alone, and as a renderer uses it.
#include "OcclusionTextures.h"
#include "PagedTextures.h"
#include "SphereRenderer.h"
#include "TestViews.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace
{
using namespace po;

constexpr int Resolution = 4;
constexpr std::size_t TextureBytes = Resolution * Resolution;
constexpr std::size_t SlotBytes = TextureBytes + 16;

/// A table in memory that counts what is read. It can be closed, so that reads wait, and broken.
class TableSource : public TextureSource
{
public:
  explicit TableSource(std::size_t textures)
    : bytes_(textures * TextureBytes)
  {
    std::mt19937 random(5);
    std::generate(
      bytes_.begin(), bytes_.end(), [&] { return static_cast<std::uint8_t>(random() % 256); });
  }

  void read(std::int32_t row, void* texels) const override
  {
    std::unique_lock lock(mutex_);
    reads_.push_back(row);
    changed_.notify_all();
    changed_.wait(lock, [this] { return !isClosed_; });
    if (isBroken_)
    {
      throw std::runtime_error("the source is broken");
    }
    std::memcpy(texels, texture(row), TextureBytes);
  }

  void setClosed(bool closed)
  {
    const std::lock_guard lock(mutex_);
    isClosed_ = closed;
    changed_.notify_all();
  }
  void setBroken()
  {
    const std::lock_guard lock(mutex_);
    isBroken_ = true;
  }

  /// Until so many reads have begun.
  bool waitForReads(std::size_t count) const
  {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(
      lock, std::chrono::seconds(60), [&] { return reads_.size() >= count; });
  }
  std::vector<std::int32_t> reads() const
  {
    const std::lock_guard lock(mutex_);
    return reads_;
  }
  const std::uint8_t* texture(std::int32_t row) const
  {
    return bytes_.data() + static_cast<std::size_t>(row) * TextureBytes;
  }

private:
  std::vector<std::uint8_t> bytes_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  mutable std::vector<std::int32_t> reads_;
  bool isClosed_ = false, isBroken_ = false;
};

std::vector<std::int32_t> range(std::int32_t first, std::int32_t end)
{
  std::vector<std::int32_t> rows(static_cast<std::size_t>(end - first));
  std::iota(rows.begin(), rows.end(), first);
  return rows;
}

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

// The renderer.

constexpr std::size_t Particles = 3000;

SphereCloud cloudOfParticles()
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> position(-8, 8);
  std::vector<Vec3d> centers(Particles);
  for (Vec3d& center : centers)
  {
    center = { position(random), position(random), position(random) };
  }
  return makeSphereCloud(
    Particles, [&](std::size_t i) { return centers[i]; }, [](std::size_t) { return 0.4; });
}

/// Particles with a texture each, but for every tenth, which has none.
struct PagedScene
{
  std::shared_ptr<TableSource> source = std::make_shared<TableSource>(Particles);
  std::vector<std::int32_t> rows = range(0, Particles);
  std::vector<float> means = std::vector<float>(Particles, 0.25f);
  SphereRenderer renderer;
  std::shared_ptr<PagedTextures> paged;
  Style style;

  explicit PagedScene(std::size_t budget)
    : paged(std::make_shared<PagedTextures>(source, Particles, TextureBytes, budget))
  {
    for (std::size_t i = 0; i < Particles; i += 10)
    {
      rows[i] = -1;
    }
    renderer.setCloud(cloudOfParticles());
    style.material.mode = ShadingMode::AmbientOcclusion;
    style.textures = OcclusionTextures(paged, { Resolution }, rows.data(), means.data());
  }

  /// The same particles with all textures in memory, or with none.
  [[nodiscard]] Style inMemory(bool textures) const
  {
    Style other = style;
    other.textures = textures
      ? OcclusionTextures(Resolution, source->texture(0), 1.0, rows.data(), means.data())
      : OcclusionTextures(means.data());
    other.texturesVersion = textures ? 1 : 2;
    return other;
  }

  /// From the outside to the inside, and round.
  [[nodiscard]] static Camera view(int step)
  {
    return lookAtOrigin(true, 30 - 0.7 * step, 10, 96, 72, 0.1, 100);
  }

  [[nodiscard]] const std::vector<std::uint8_t>& draw(const Camera& camera)
  {
    EXPECT_TRUE(renderer.trace(camera, Identity));
    renderer.shade(style);
    return renderer.rgba();
  }

  [[nodiscard]] std::vector<std::uint8_t> expected(const Camera& camera, bool textures) const
  {
    SphereRenderer other;
    other.setCloud(cloudOfParticles());
    EXPECT_TRUE(other.trace(camera, Identity));
    other.shade(inMemory(textures));
    return other.rgba();
  }
};

/// What an event loop does, within a minute.
template <typename Condition>
bool waitUntil(const Condition& condition)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!condition() && std::chrono::steady_clock::now() < end)
  {
    std::this_thread::yield();
  }
  return condition();
}

TEST(PagedTextures, APictureShowsMeansUntilItsTexturesAreThereAndThenTheSameBitsAsFromMemory)
{
  PagedScene scene(Particles * SlotBytes);
  scene.source->setClosed(true);
  const Camera view = PagedScene::view(0);
  EXPECT_EQ(scene.draw(view), scene.expected(view, false));
  EXPECT_TRUE(scene.renderer.isWaiting());
  const std::size_t missing = scene.renderer.statistics().missingTextures;
  EXPECT_GT(missing, 300u);
  const std::size_t shaded = scene.renderer.statistics().framesShaded;
  EXPECT_EQ(scene.draw(view), scene.expected(view, false));
  EXPECT_EQ(scene.renderer.statistics().framesShaded, shaded) << "nothing has arrived";

  scene.source->setClosed(false);
  scene.style.waitForTextures = true;
  EXPECT_EQ(scene.draw(view), scene.expected(view, true));
  EXPECT_FALSE(scene.renderer.isWaiting());
  EXPECT_EQ(scene.renderer.statistics().framesTraced, 1u);
  EXPECT_EQ(scene.renderer.statistics().missingTextures, 0u);
  EXPECT_EQ(scene.source->reads().size(), missing) << "only what is seen is read";
}

TEST(PagedTextures, AFlightThroughTenTimesTheBudgetStaysWithinItAndEndsInTheSameBits)
{
  const std::size_t budget = Particles * SlotBytes / 10;
  PagedScene scene(budget);
  for (int step = 0; step < 60; ++step)
  {
    const Camera view = PagedScene::view(step);
    scene.style.waitForTextures = step % 20 == 19; // stops now and then
    const std::vector<std::uint8_t> picture = scene.draw(view);
    EXPECT_LE(scene.paged->bytes(), budget);
    if (scene.style.waitForTextures && scene.renderer.statistics().missingTextures == 0)
    {
      EXPECT_EQ(picture, scene.expected(view, true)) << step;
    }
  }
  EXPECT_GT(scene.source->reads().size(), scene.paged->capacity()) << "some made room";
  const Camera inside = lookAtOrigin(true, 5, 2, 96, 72, 0.1, 100);
  EXPECT_EQ(scene.draw(inside), scene.expected(inside, true));
  EXPECT_EQ(scene.renderer.statistics().missingTextures, 0u) << "a view that fits";
}

TEST(PagedTextures, OfAViewAboveTheBudgetTheFewestPixelsShowMeansWhateverWasSeenBefore)
{
  PagedScene scene(100 * SlotBytes);
  scene.style.waitForTextures = true;
  const Camera view = PagedScene::view(0);
  const std::vector<std::uint8_t> fresh = scene.draw(view);
  EXPECT_GT(scene.renderer.statistics().missingTextures, 100u);
  EXPECT_NE(fresh, scene.expected(view, true));
  std::vector<std::size_t> pixels(Particles, 0);
  for (const std::uint32_t sphere : scene.renderer.frame().sphere)
  {
    const std::int64_t particle =
      sphere == SphereScene::None ? 0 : scene.renderer.cloud().sourceIds[sphere];
    ++pixels[static_cast<std::size_t>(particle)]; // particle 0 has no texture
  }
  std::size_t leastShown = Particles, mostMissing = 0;
  for (std::int32_t row = 1; row < static_cast<std::int32_t>(Particles); ++row)
  {
    const auto i = static_cast<std::size_t>(row);
    if (scene.rows[i] >= 0)
    {
      std::size_t& extreme = scene.paged->find(row) ? leastShown : mostMissing;
      extreme =
        scene.paged->find(row) ? std::min(leastShown, pixels[i]) : std::max(mostMissing, pixels[i]);
    }
  }
  EXPECT_GE(leastShown, mostMissing);

  (void)scene.draw(PagedScene::view(25));
  scene.style.waitForTextures = false;
  (void)scene.draw(PagedScene::view(12)); // left at once
  scene.style.waitForTextures = true;
  EXPECT_EQ(scene.draw(view), fresh);
}

TEST(PagedTextures, SamplesForSmoothEdgesAreAddedWhenTheirTexturesAreThere)
{
  PagedScene scene(Particles * SlotBytes);
  SphereRenderer inMemory;
  inMemory.setCloud(cloudOfParticles());
  const Camera view = PagedScene::view(0);
  ASSERT_TRUE(inMemory.trace(view, Identity));
  inMemory.shade(scene.inMemory(true));
  inMemory.refine(5);

  scene.source->setClosed(true);
  (void)scene.draw(view);
  scene.renderer.refine(5);
  EXPECT_EQ(scene.renderer.samples(), 1);
  EXPECT_FALSE(scene.renderer.canGoOn());
  scene.source->setClosed(false);
  int pictures = 0;
  for (; scene.renderer.samples() < 5 && pictures < 1000; ++pictures)
  {
    (void)scene.draw(view);
    scene.renderer.refine(5);
    ASSERT_TRUE(waitUntil([&] { return scene.renderer.canGoOn(); }));
  }
  EXPECT_EQ(scene.renderer.samples(), 5);
  EXPECT_EQ(scene.renderer.rgba(), inMemory.rgba());
}

TEST(PagedTextures, ABrokenSourceLeavesAPictureOfMeansAndSmoothEdges)
{
  PagedScene scene(Particles * SlotBytes);
  scene.source->setBroken();
  scene.style.waitForTextures = true;
  const Camera view = PagedScene::view(0);
  EXPECT_EQ(scene.draw(view), scene.expected(view, false));
  EXPECT_EQ(scene.paged->error(), "the source is broken");
  EXPECT_FALSE(scene.renderer.isWaiting());
  scene.renderer.refine(3);
  EXPECT_EQ(scene.renderer.samples(), 3);
}
}
