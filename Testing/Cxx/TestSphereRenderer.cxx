// SPDX-License-Identifier: BSD-3-Clause
// Cropping, layers behind translucent spheres, and what is kept between frames.
#include "Cropping.h"
#include "SceneCache.h"
#include "SphereRenderer.h"
#include "TestViews.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

namespace
{
using namespace po;

SphereCloud randomCloud(std::size_t count)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> position(-6, 6), radius(0.3, 1.0);
  std::vector<Vec3d> centers(count);
  std::vector<double> radii(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    centers[i] = { position(random), position(random), position(random) };
    radii[i] = radius(random);
  }
  return makeSphereCloud(
    count, [&](std::size_t i) { return centers[i]; }, [&](std::size_t i) { return radii[i]; });
}

Camera view(int width = 120, int height = 90)
{
  return lookAtOrigin(true, 30, 8, width, height, 1, 100);
}

/// The fronts of all shown spheres along a ray, nearest first: in double precision, by trying all.
std::vector<double> frontsAlong(
  const SphereCloud& cloud, const std::vector<std::uint8_t>& hidden, const PrimaryRay& ray)
{
  std::vector<double> fronts;
  for (std::size_t i = 0; i < cloud.spheres.size(); ++i)
  {
    const Sphere& s = cloud.spheres[i];
    const Vec3d oc = ray.origin - s.center().as<double>();
    const double b = dot(oc, ray.direction);
    const Vec3d foot = oc - b * ray.direction;
    const double squared = double(s.radius) * s.radius - dot(foot, foot);
    if (squared >= 0 && (hidden.empty() || hidden[i] == 0))
    {
      fronts.push_back((-b - std::sqrt(squared)) * ray.worldPerLocal);
    }
  }
  std::sort(fronts.begin(), fronts.end());
  return fronts;
}

Style directLight()
{
  Style style;
  style.material.mode = ShadingMode::DirectLight;
  style.lights.resize(1);
  style.lights[0].direction = normalized(Vec3d{ -1, -2, -1 });
  return style;
}

TEST(Cropping, HidesByRangesAndHalfSpacesTogether)
{
  const SphereCloud cloud = randomCloud(500);
  const double nan = std::nan("");
  Cropping cropping;
  EXPECT_TRUE(hideSpheres(cloud, cropping).empty());
  cropping.halfSpaces.push_back({ { 1, 0, 0 }, 2 });
  cropping.ranges.push_back({ [=](std::int64_t i) { return i == 7 ? nan : double(i); }, 3, 400 });
  const std::vector<std::uint8_t> hidden = hideSpheres(cloud, cropping);
  ASSERT_EQ(hidden.size(), 500u);
  std::size_t shown = 0;
  for (std::size_t i = 0; i < 500; ++i)
  {
    const double x = cloud.toWorld(cloud.spheres[i].center().as<double>()).x;
    ASSERT_EQ(hidden[i] == 0, x >= -2 && i >= 3 && i <= 400 && i != 7) << i;
    shown += hidden[i] == 0;
  }
  EXPECT_GT(shown, 100u);
}

TEST(SphereRenderer, HiddenSpheresAreNeitherSeenNorCastShadowsAndNothingIsBuiltAnew)
{
  SphereRenderer renderer;
  renderer.setCloud(randomCloud(2000));
  Style style = directLight();
  style.shadows = true;
  ASSERT_TRUE(renderer.trace(view(), Identity));
  renderer.shade(style);
  const double build = renderer.statistics().buildSeconds;

  Cropping cropping;
  cropping.halfSpaces.push_back({ { 0.6, 0, -0.8 }, 0.5 });
  const std::vector<std::uint8_t> hidden = hideSpheres(renderer.cloud(), cropping);
  renderer.setHidden(hidden);
  EXPECT_FALSE(renderer.isShaded());
  ASSERT_TRUE(renderer.trace(view(), Identity));
  renderer.shade(style);
  EXPECT_EQ(renderer.statistics().buildSeconds, build) << "the scene is kept";

  // The same cloud, in the same coordinates, of the shown spheres alone.
  SphereCloud rest = renderer.cloud();
  rest.spheres.clear();
  rest.sourceIds.clear();
  for (std::size_t i = 0; i < hidden.size(); ++i)
  {
    if (hidden[i] == 0)
    {
      rest.spheres.push_back(renderer.cloud().spheres[i]);
      rest.sourceIds.push_back(renderer.cloud().sourceIds[i]);
    }
  }
  ASSERT_GT(rest.spheres.size(), 500u);
  ASSERT_LT(rest.spheres.size(), 1500u);
  SphereRenderer alone;
  alone.setCloud(rest);
  ASSERT_TRUE(alone.trace(view(), Identity));
  alone.shade(style);
  EXPECT_GT(alone.statistics().trace.hits, 3000u);
  EXPECT_EQ(renderer.rgba(), alone.rgba());
  EXPECT_EQ(renderer.frame().t, alone.frame().t);

  renderer.setHidden(hidden);
  EXPECT_TRUE(renderer.isShaded()) << "the same spheres are hidden";
}

TEST(SphereRenderer, HidingEverythingShowsNothing)
{
  SphereRenderer renderer;
  renderer.setCloud(randomCloud(300));
  renderer.setHidden(std::vector<std::uint8_t>(300, 1));
  ASSERT_TRUE(renderer.trace(view(), Identity));
  EXPECT_EQ(renderer.statistics().trace.hits, 0u);
}

TEST(SphereRenderer, LayersAreTheFrontsOneBehindTheOther)
{
  SphereRenderer renderer;
  renderer.setCloud(randomCloud(400));
  std::vector<std::uint8_t> hidden(400);
  for (std::size_t i = 0; i < 400; i += 5)
  {
    hidden[i] = 1;
  }
  renderer.setHidden(hidden);
  Style style = directLight();
  style.material.translucent = true;
  style.material.opacity = 0.1;
  style.maximumLayers = 6;
  ASSERT_TRUE(renderer.trace(view(60, 45), Identity));
  renderer.shade(style);
  ASSERT_EQ(renderer.layersBehind().size(), 5u);
  std::size_t compared = 0;
  for (std::size_t pixel = 0; pixel < renderer.frame().pixels(); ++pixel)
  {
    const auto x = static_cast<double>(pixel % 60) + 0.5, y = double(pixel / 60) + 0.5;
    const std::vector<double> expected =
      frontsAlong(renderer.cloud(), hidden, renderer.rays().at(x, y));
    for (std::size_t k = 0; k < 6; ++k)
    {
      const TracedFrame& frame = k == 0 ? renderer.frame() : renderer.layersBehind()[k - 1].frame;
      ASSERT_EQ(std::isfinite(frame.t[pixel]), k < expected.size()) << pixel << ' ' << k;
      if (k < expected.size())
      {
        ASSERT_NEAR(frame.t[pixel], expected[k], 1e-6) << pixel << ' ' << k;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 3000u);
}

TEST(SphereRenderer, LayersStopWhereNothingShinesThroughAndAreKept)
{
  SphereRenderer renderer;
  renderer.setCloud(randomCloud(400));
  Style style = directLight();
  style.material.translucent = true;
  style.material.opacity = 0.99; // 1 % comes through one layer, nothing visible through two
  ASSERT_TRUE(renderer.trace(view(), Identity));
  renderer.shade(style);
  EXPECT_EQ(renderer.layersBehind().size(), 1u);
  const std::size_t traced = renderer.statistics().layersTraced;
  style.material.diffuseColor = { 1, 0, 0 };
  renderer.shade(style);
  EXPECT_EQ(renderer.statistics().layersTraced, traced) << "a colour asks for no rays";
  style.material.opacity = 0.5;
  renderer.shade(style);
  EXPECT_GT(renderer.layersBehind().size(), 5u);
  style.material.translucent = false;
  renderer.shade(style);
  EXPECT_TRUE(renderer.layersBehind().empty());
  EXPECT_EQ(renderer.statistics().framesTraced, 1u);
}

TEST(SphereRenderer, NothingIsDoneWhenNothingHasChanged)
{
  SphereRenderer renderer;
  renderer.setCloud(randomCloud(100));
  Style style = directLight();
  for (int i = 0; i < 3; ++i)
  {
    ASSERT_TRUE(renderer.trace(view(), Identity));
    renderer.shade(style);
  }
  EXPECT_EQ(renderer.statistics().framesTraced, 1u);
  EXPECT_EQ(renderer.statistics().framesShaded, 1u);
  style.lights[0].color = { 1, 0, 0 };
  renderer.shade(style);
  EXPECT_EQ(renderer.statistics().framesShaded, 2u);
  EXPECT_EQ(renderer.statistics().framesTraced, 1u);
}

TEST(SphereRenderer, WhatHasChangedIsDoneAgain)
{
  // After each change the picture is another one, and that of a renderer which knew nothing before.
  const SphereCloud cloud = randomCloud(300);
  const std::vector<std::int32_t> rows(300, 0);
  const std::vector<float> halves(1, 0.5f), quarters(1, 0.25f);
  std::vector<std::uint8_t> colors(4 * 300, 200);
  for (std::size_t i = 3; i < colors.size(); i += 8)
  {
    colors[i] = 255;
    colors[i + 4] = 0;
  }
  Camera camera = view();
  Matrix4 placement = Identity;
  Style style = directLight();
  style.material.mode = ShadingMode::Both;
  style.material.translucent = true;
  style.material.opacity = 0.5;
  style.shadows = true;
  style.textures = OcclusionTextures(1, halves.data(), rows.data(), nullptr);
  const std::pair<const char*, std::function<void()>> changes[] = {
    { "place of the eye", [&] { camera.worldToEye = translation(0.5, 0, -30); } },
    { "angle of view", [&] { camera = lookAtOrigin(true, 30, 9, 120, 90, 1, 100); } },
    { "size of the window", [&] { camera = lookAtOrigin(true, 30, 9, 90, 90, 1, 100); } },
    { "placement", [&] { placement = translation(1, 0, 0); } },
    { "direction of the light",
      [&] {
        style.lights[0].direction = { 0, 0, -1 };
      } },
    { "kind of the light", [&] { style.lights[0].positional = true; } },
    { "narrow cone", [&] { style.lights[0].coneAngle = 20; } },
    { "position of the light",
      [&] {
        style.lights[0].position = { 0, 3, 9 };
      } },
    { "attenuation",
      [&] {
        style.lights[0].attenuation = { 5, 0, 0 };
      } },
    { "wider cone", [&] { style.lights[0].coneAngle = 50; } },
    { "colour of the light",
      [&] {
        style.lights[0].color = { 1, 0, 0 };
      } },
    { "another light", [&] { style.lights.emplace_back(); } },
    { "textures",
      [&]
      {
        style.textures = OcclusionTextures(1, quarters.data(), rows.data(), nullptr);
        ++style.texturesVersion;
      } },
    { "colour",
      [&] {
        style.material.diffuseColor = { 0, 1, 0 };
      } },
    { "more opacity", [&] { style.material.opacity = 0.9; } },
    { "less opacity", [&] { style.material.opacity = 0.3; } },
    { "opaque and clear particles",
      [&]
      {
        style.material.particleColors = colors.data();
        ++style.material.colorsVersion;
      } },
    { "clear and opaque particles",
      [&]
      {
        for (std::size_t i = 3; i < colors.size(); i += 4)
        {
          colors[i] = static_cast<std::uint8_t>(255 - colors[i]);
        }
        ++style.material.colorsVersion;
      } },
    { "number of layers", [&] { style.maximumLayers = 2; } },
    { "shadows", [&] { style.shadows = false; } },
  };
  const auto draw = [&](SphereRenderer& renderer)
  {
    ASSERT_TRUE(renderer.trace(camera, placement));
    renderer.shade(style);
  };
  const auto picture = [](const SphereRenderer& renderer)
  {
    std::vector<std::uint8_t> rgba = renderer.rgba();
    for (const FrameLayer& layer : renderer.layersBehind())
    {
      rgba.insert(rgba.end(), layer.rgba.begin(), layer.rgba.end());
    }
    return rgba;
  };
  SphereRenderer renderer;
  renderer.setCloud(cloud);
  draw(renderer);
  for (const auto& [what, change] : changes)
  {
    const std::vector<std::uint8_t> before = picture(renderer);
    change();
    draw(renderer);
    SphereRenderer fresh;
    fresh.setCloud(cloud);
    draw(fresh);
    EXPECT_TRUE(picture(renderer) != before) << what;
    EXPECT_TRUE(picture(renderer) == picture(fresh)) << what;
  }
}

TEST(SceneCache, EqualFloatsAboutOtherCentersAreAnotherScene)
{
  const std::vector<Sphere> spheres{ { 0, 0, 0, 1 }, { 4, 0, 0, 1 } };
  SceneCache cache;
  const auto first = cache.get(spheres, { { 0, 0, 0 }, { 4, 0, 0 } });
  const auto second = cache.get(spheres, { { 0, 0, 0 }, { 4 + 1e-9, 0, 0 } });
  EXPECT_NE(first, second);
  EXPECT_EQ(cache.get(spheres, { { 0, 0, 0 }, { 4, 0, 0 } }), first);
  EXPECT_EQ(cache.size(), 2u);
}
}
