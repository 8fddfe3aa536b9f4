// SPDX-License-Identifier: BSD-3-Clause
#include "Shading.h"
#include "TestViews.h"
#include "TexelMap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>
#include <vector>

namespace
{
using namespace po;

/// A big sphere as ground, a small one above it, light from straight above.
TEST(Shadows, SphereAboveSphereIsADiscOfItsRadius)
{
  const SphereScene scene({ { 0, -1000, 0, 1000 }, { 0, 3, 0, 1 } });
  // The eye looks down along -y from between ground and occluder.
  const Matrix4 down{ 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, -1.5, 0, 0, 0, 1 };
  const Camera camera{ down, parallel(-2, 2, -2, 2, 0, 10), 101, 101 };
  const PrimaryRays rays = *PrimaryRays::make(camera, Identity);
  TracedFrame frame;
  (void)traceFrame(scene, rays, {}, frame);
  Light light;
  light.direction = { 0, -1, 0 };
  std::vector<std::uint8_t> lit;
  const ShadowCounters counters = traceShadows(scene, nullptr, rays, frame, light, lit);
  EXPECT_EQ(counters.rays, 101u * 101u);
  EXPECT_EQ(counters.skipped, 0u);
  for (int y = 0; y < 101; ++y)
  {
    for (int x = 0; x < 101; ++x)
    {
      const Vec3d p = rays.worldPoint(x + 0.5, y + 0.5, frame.t[pixelAt(frame, x, y)]);
      const double fromAxis = std::hypot(p.x, p.z);
      if (std::abs(fromAxis - 1) > 1e-3)
      {
        ASSERT_EQ(lit[pixelAt(frame, x, y)] != 0, fromAxis > 1) << x << ' ' << y;
      }
    }
  }
}

TEST(Shadows, TheLitHalfOfALoneSphereHasNoSpeckle)
{
  // Far from the origin and lit from the side: nothing but the surface's own facing may decide.
  const SphereScene scene({ { 300, 200, -100, 1 } });
  const Camera camera{ translation(-300, -200, 90), parallel(-1.1, 1.1, -1.1, 1.1, 0, 20), 301,
    301 };
  const PrimaryRays rays = *PrimaryRays::make(camera, Identity);
  TracedFrame frame;
  (void)traceFrame(scene, rays, {}, frame);
  Light light;
  light.direction = normalized(Vec3d{ -1, -0.3, -0.1 });
  std::vector<std::uint8_t> lit;
  const ShadowCounters counters = traceShadows(scene, nullptr, rays, frame, light, lit);
  EXPECT_GT(counters.skipped, 10000u);
  for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel)
  {
    if (frame.sphere[pixel] != SphereScene::None)
    {
      const double facing = -dot(frame.normal[pixel].as<double>(), light.direction);
      ASSERT_EQ(lit[pixel] != 0, facing > 0);
    }
  }
}

TEST(Shadows, OccludersBehindAPositionalLightCastNone)
{
  const SphereScene scene({ { 0, 0, 0, 1 }, { 0, 0, 6, 1 } });
  const Camera camera = lookAtOrigin(true, 4.5, 0.5, 5, 5, 0.1, 20);
  const PrimaryRays rays = *PrimaryRays::make(camera, Identity);
  TracedFrame frame;
  (void)traceFrame(scene, rays, {}, frame);
  Light light;
  light.positional = true;
  std::vector<std::uint8_t> lit;
  light.position = { 0, 0, 4 };
  (void)traceShadows(scene, nullptr, rays, frame, light, lit);
  EXPECT_EQ(lit[12], 1);
  light.position = { 0, 0, 8 };
  (void)traceShadows(scene, nullptr, rays, frame, light, lit);
  EXPECT_EQ(lit[12], 0);
}

TEST(Lights, ConeAndAttenuationFollowOpenGL)
{
  Light light;
  light.positional = true;
  light.position = { 0, 0, 2 };
  light.coneAngle = 30;
  light.exponent = 2;
  light.attenuation = { 1, 0.5, 0.25 };
  const double inAxis = illuminate(light, { 0, 0, 0 }).strength;
  EXPECT_NEAR(inAxis, 1 / (1 + 0.5 * 2 + 0.25 * 4), 1e-12);
  const double d = std::sqrt(5.0); // at 26.6 degrees
  EXPECT_NEAR(
    illuminate(light, { 1, 0, 0 }).strength, std::pow(2 / d, 2) / (1 + 0.5 * d + 0.25 * 5), 1e-12);
  EXPECT_EQ(illuminate(light, { 1.2, 0, 0 }).strength, 0);
}

/// One random float texture of 8 x 8.
struct OneTexture
{
  std::vector<float> values = std::vector<float>(64);
  std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(64);
  std::vector<std::int32_t> rows{ 0 };

  OneTexture()
  {
    std::mt19937 random(3);
    for (std::size_t i = 0; i < 64; ++i)
    {
      bytes[i] = static_cast<std::uint8_t>(random() % 256);
      values[i] = 0.8f * (bytes[i] / 255.0f) * (bytes[i] / 255.0f);
    }
  }
};

TEST(OcclusionTextures, ValueIsTheBilinearOneOfTheCore)
{
  const OneTexture one;
  const OcclusionTextures floats(8, one.values.data(), one.rows.data(), nullptr);
  const OcclusionTextures bytes(8, one.bytes.data(), 0.8, one.rows.data(), nullptr);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 1000; ++i)
  {
    const TextureCoordinate c{ uniform(random), uniform(random) };
    const BilinearTexels texels = bilinearTexels(8, c);
    float expected = 0;
    for (std::size_t k = 0; k < 4; ++k)
    {
      expected += texels.weight[k] * one.values[texels.index[k]];
    }
    EXPECT_NEAR(floats.at(0, textureDirection(c).as<float>()), expected, 1e-5);
    EXPECT_NEAR(bytes.at(0, textureDirection(c).as<float>()), expected, 1e-5);
  }
}

TEST(OcclusionTextures, NoJumpAcrossTheSeam)
{
  const OneTexture one;
  const OcclusionTextures textures(8, one.values.data(), one.rows.data(), nullptr);
  const double step = 1e-6;
  for (double v = 0.01; v < 1; v += 0.01)
  {
    const float before = textures.at(0, textureDirection({ 1 - step, v }).as<float>());
    const float after = textures.at(0, textureDirection({ step, v }).as<float>());
    // Values differ by at most 0.8 over a texel, which is 1/8 of u.
    EXPECT_NEAR(before, after, 2 * step * 8 * 0.8 + 1e-6) << v;
  }
}

TEST(OcclusionTextures, ParticlesWithoutATextureHaveTheirMean)
{
  const OneTexture one;
  const std::vector<std::int32_t> rows{ -1, 0 };
  const std::vector<float> means{ 0.25f, 0.5f };
  const OcclusionTextures with(8, one.values.data(), rows.data(), means.data());
  const OcclusionTextures without(8, one.values.data(), rows.data(), nullptr);
  EXPECT_EQ(with.at(0, { 1, 0, 0 }), 0.25f);
  EXPECT_EQ(without.at(0, { 1, 0, 0 }), 1.0f);
  EXPECT_EQ(OcclusionTextures().at(0, { 1, 0, 0 }), 1.0f);
}

/// A sphere that fills a 3 x 3 window, seen along -z; colours are those of the middle pixel.
class ShadedSphere : public testing::Test
{
protected:
  ShadedSphere()
    : rays(*PrimaryRays::make(lookAtOrigin(false, 10, 0.5, 3, 3, 1, 20), Identity))
  {
    (void)traceFrame(SphereScene({ { 0, 0, 0, 1 } }), rays, {}, frame);
    lights.front().direction = { 0, 0, -1 };
    half = OcclusionTextures(1, halfOpen.data(), rows.data(), nullptr);
  }

  std::array<int, 3> middle(const OcclusionTextures& textures, const Material& material)
  {
    std::vector<std::uint8_t> rgba;
    shadeFrame({ rays, frame, particles.data(), textures, lights, shadows, material }, rgba);
    EXPECT_EQ(rgba[4 * 4 + 3], 255);
    return { rgba[16], rgba[17], rgba[18] };
  }

  PrimaryRays rays;
  TracedFrame frame;
  std::vector<std::int64_t> particles{ 0 };
  std::vector<float> halfOpen{ 0.5f };
  std::vector<std::int32_t> rows{ 0 };
  OcclusionTextures none, half;
  std::vector<Light> lights{ Light{} };
  ShadowMasks shadows;
};

TEST_F(ShadedSphere, TermsAddUpAsInVTK)
{
  Material m;
  m.mode = ShadingMode::DirectLight;
  m.ambient = 0.1;
  m.diffuse = 0.5;
  m.specular = 0.2;
  m.diffuseColor = { 1, 0.5f, 0 };
  m.ambientColor = { 0, 0, 1 };
  EXPECT_EQ(middle(half, m), (std::array<int, 3>{ 179, 115, 77 })); // .5+.2, .25+.2, .1+.2
  shadows.lit = { std::vector<std::uint8_t>(9, 0) };
  EXPECT_EQ(middle(half, m), (std::array<int, 3>{ 0, 0, 26 }));
}

TEST_F(ShadedSphere, OcclusionScalesWhatItShould)
{
  Material m;
  m.ambient = 0.4;
  m.diffuse = 0.4;
  EXPECT_EQ(middle(none, m)[0], 204);
  EXPECT_EQ(middle(half, m)[0], 102);
  m.occlusionOnDiffuse = false;
  EXPECT_EQ(middle(half, m)[0], 153); // 0.2 + 0.4
  m.mode = ShadingMode::AmbientOcclusion;
  m.diffuseColor = { 1, 0.5f, 0 };
  EXPECT_EQ(middle(half, m), (std::array<int, 3>{ 128, 64, 0 }));
  m.mode = ShadingMode::DirectLight;
  m.diffuseColor = { 1, 1, 1 };
  EXPECT_EQ(middle(half, m)[0], 204);
}

TEST_F(ShadedSphere, ParticleColoursReplaceBothColours)
{
  const std::uint8_t green[] = { 0, 200, 0, 255 };
  Material m;
  m.ambient = 0.5;
  m.diffuse = 0.5;
  m.particleColors = green;
  EXPECT_EQ(middle(none, m), (std::array<int, 3>{ 0, 200, 0 }));
}

TEST_F(ShadedSphere, IsTheSameAtAnyScaleOfTheWorld)
{
  Material m;
  m.mode = ShadingMode::DirectLight;
  m.diffuse = 0.5;
  m.specular = 0.3;
  m.specularPower = 5;
  lights.front().direction = normalized(Vec3d{ 1, -2, -2 });
  const std::array<int, 3> expected = middle(none, m);
  EXPECT_GT(expected[0], 85) << "0.5 x 2/3 of 255 is diffuse, the rest a highlight";
  for (const double s : { 1e-30, 1e-12, 1e12, 1e30 })
  {
    const Matrix4 scaled{ s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, 0, 0, 0, 1 };
    rays = *PrimaryRays::make(lookAtOrigin(false, 10 * s, 0.5 * s, 3, 3, s, 20 * s), scaled);
    (void)traceFrame(SphereScene({ { 0, 0, 0, 1 } }), rays, {}, frame);
    EXPECT_EQ(middle(none, m), expected) << s;
  }
}

/// A frame of many spheres with gaps, of a size that is no multiple of a tile, with textures of
/// some particles and means of the others, colours of particles, two lights and shadows of one.
class ShadedFrame : public testing::Test
{
protected:
  ShadedFrame()
  {
    std::mt19937 random(11);
    const auto byte = [&random] { return static_cast<std::uint8_t>(random() % 256); };
    std::uniform_real_distribution<float> place(-4, 4);
    for (std::int64_t i = 0; i < Spheres; ++i)
    {
      spheres.push_back({ place(random), place(random), place(random), 0.5f });
      particles.push_back(Spheres - 1 - i); // not the order of the spheres
      rows.push_back(i % 3 == 0 ? -1 : static_cast<std::int32_t>(i % 5));
      means.push_back(float(byte()) / 255);
      colors.insert(colors.end(), { byte(), byte(), byte(), byte() });
    }
    std::generate_n(std::back_inserter(bytes), 5 * 64, byte);
    textures = OcclusionTextures(8, bytes.data(), 0.9, rows.data(), means.data());
    (void)traceFrame(SphereScene(spheres), rays, {}, frame);
    lights[0].direction = normalized(Vec3d{ 1, -1, -1 });
    lights[0].color = { 1, 0.5f, 0.25f };
    lights[1].direction = normalized(Vec3d{ -1, 0.2, -0.5 });
    lights[1].color = { 0.1f, 0.5f, 0.5f };
    std::generate_n(std::back_inserter(shadows.lit.emplace_back()), frame.pixels(),
      [&random] { return static_cast<std::uint8_t>(random() % 2); });
  }

  /// Of one pixel, by the formula.
  [[nodiscard]] std::array<double, 4> expected(std::size_t pixel, const Material& m) const
  {
    const auto particle = static_cast<std::size_t>(particles[frame.sphere[pixel]]);
    const Vec3f normal = frame.normal[pixel];
    const double occlusion = m.mode == ShadingMode::DirectLight ? 1 : textures.at(particle, normal);
    std::array<double, 4> rgba{ 0, 0, 0, m.translucent ? double(colors[4 * particle + 3]) : 255 };
    for (std::size_t c = 0; c < 3; ++c)
    {
      double light = 0;
      for (std::size_t i = 0; i < lights.size(); ++i)
      {
        const bool lit = i > 0 || shadows.lit[0][pixel] != 0;
        const float color[] = { lights[i].color.x, lights[i].color.y, lights[i].color.z };
        light += lit * std::max(0.0, -dot(normal.as<double>(), lights[i].direction)) * color[c];
      }
      const double share = m.mode == ShadingMode::AmbientOcclusion
        ? occlusion
        : m.ambient * occlusion + m.diffuse * occlusion * light;
      rgba[c] = std::min(255.0, share * colors[4 * particle + c]);
    }
    return rgba;
  }

  static constexpr std::int64_t Spheres = 200;
  std::vector<Sphere> spheres;
  std::vector<std::int64_t> particles;
  std::vector<std::int32_t> rows;
  std::vector<float> means;
  std::vector<std::uint8_t> colors, bytes;
  OcclusionTextures textures;
  PrimaryRays rays = *PrimaryRays::make(lookAtOrigin(true, 12, 0.4, 77, 53, 1, 30), Identity);
  TracedFrame frame;
  std::vector<Light> lights{ 2 };
  ShadowMasks shadows;
};

TEST_F(ShadedFrame, FollowsTheFormulaInEachPixel)
{
  for (const ShadingMode mode :
    { ShadingMode::DirectLight, ShadingMode::AmbientOcclusion, ShadingMode::Both })
  {
    Material m;
    m.mode = mode;
    m.ambient = 0.3;
    m.diffuse = 0.9;
    m.particleColors = colors.data();
    m.translucent = mode == ShadingMode::Both;
    std::vector<std::uint8_t> rgba(1);
    shadeFrame({ rays, frame, particles.data(), textures, lights, shadows, m }, rgba);
    ASSERT_EQ(rgba.size(), 4 * frame.pixels());
    std::size_t hits = 0;
    for (std::size_t pixel = 0; pixel < frame.pixels(); ++pixel)
    {
      const bool hit = frame.sphere[pixel] != SphereScene::None;
      hits += hit;
      const std::array<double, 4> value = hit ? expected(pixel, m) : std::array<double, 4>{};
      for (std::size_t c = 0; c < 4; ++c)
      {
        ASSERT_NEAR(rgba[4 * pixel + c], value[c], 0.501) << "pixel " << pixel << ", channel " << c;
      }
    }
    EXPECT_GT(hits, 1000u);
    EXPECT_LT(hits, frame.pixels() - 500);
  }
}

TEST_F(ShadedFrame, ParticlesInTheOrderOfSpheresNeedNoNumbers)
{
  std::iota(particles.begin(), particles.end(), 0);
  Material m;
  m.particleColors = colors.data();
  std::vector<std::uint8_t> with, without;
  shadeFrame({ rays, frame, particles.data(), textures, lights, shadows, m }, with);
  shadeFrame({ rays, frame, nullptr, textures, lights, shadows, m }, without);
  EXPECT_EQ(with, without);
}
}
