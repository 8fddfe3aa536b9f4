// SPDX-License-Identifier: BSD-3-Clause
// Textures that are loaded while they are seen: as a renderer uses them.
#include "OcclusionTextures.h"
#include "PagedTexturesTestSupport.h"
#include "SphereRenderer.h"
#include "TestViews.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <random>
#include <thread>

namespace
{
using namespace paged_textures;

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
