// SPDX-License-Identifier: BSD-3-Clause
#include "PixelShader.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
constexpr std::size_t Size = PixelBlock::Size;
using Colors = float[3][Size];

void fill(Colors& colors, Vec3f color)
{
  std::fill_n(colors[0], Size, color.x);
  std::fill_n(colors[1], Size, color.y);
  std::fill_n(colors[2], Size, color.z);
}

void add(Colors& colors, std::size_t lane, float strength, Vec3f color)
{
  colors[0][lane] += strength * color.x;
  colors[1][lane] += strength * color.y;
  colors[2][lane] += strength * color.z;
}

template <typename Value>
void prefetchBlock(const Value* values)
{
  constexpr std::size_t CacheLine = 64;
  for (std::size_t i = 0; i < Size; i += CacheLine / sizeof(Value))
  {
    hwy::Prefetch(values + i);
  }
}

std::int32_t toByte(float value)
{
  return static_cast<std::int32_t>(255.0f * std::clamp(value, 0.0f, 1.0f) + 0.5f);
}

ColorTerms termsOf(const Material& m)
{
  return { m.mode == ShadingMode::AmbientOcclusion, m.lighting, m.occlusionOnDiffuse,
    static_cast<float>(m.ambient), static_cast<float>(m.diffuse), static_cast<float>(m.specular),
    m.specularColor };
}

/// The linear part, by rows. Normals follow its transpose; a common factor does not matter to them,
/// and keeps any scale of the data within the range of a float.
std::array<float, 9> scaledLinearPart(const Matrix4& matrix)
{
  double largest = 0;
  for (std::size_t i = 0; i < 9; ++i)
  {
    largest = std::max(largest, std::abs(matrix[4 * (i / 3) + i % 3]));
  }
  std::array<float, 9> linear{};
  for (std::size_t i = 0; i < 9; ++i)
  {
    linear[i] = static_cast<float>(matrix[4 * (i / 3) + i % 3] / largest);
  }
  return linear;
}
}

PixelShader::PixelShader(const ShadingInput& input)
  : in_(input)
  , terms_(termsOf(input.material))
  , toLocal_(scaledLinearPart(input.rays.worldToLocal()))
  , usesOcclusion_(input.material.mode != ShadingMode::DirectLight && !input.textures.empty())
  , needsParticles_(usesOcclusion_ || input.material.particleColors)
  , needsView_(input.material.specular > 0)
{
  for (std::size_t i = 0; i < input.lights.size(); ++i)
  {
    prepare(i);
    needsPoint_ = needsPoint_ || input.lights[i].positional;
  }
  const bool isEven = input.rays.functions().worldPerLocal > 0;
  isParallel_ = isEven && !needsView_ && !needsPoint_;
}

void PixelShader::prepare(std::size_t i)
{
  const bool masked = i < in_.shadows.lit.size() && !in_.shadows.lit[i].empty();
  const Vec3f toLight = (-in_.lights[i].direction).as<float>();
  const auto& m = toLocal_;
  // The transpose of what normals are multiplied by; its rows have one length where lengths scale
  // evenly, and only there this is used.
  const Vec3f local{ dot(Vec3f{ m[0], m[1], m[2] }, toLight),
    dot(Vec3f{ m[3], m[4], m[5] }, toLight), dot(Vec3f{ m[6], m[7], m[8] }, toLight) };
  lights_.push_back({ &in_.lights[i], masked ? in_.shadows.lit[i].data() : nullptr,
    (1 / length(Vec3f{ m[0], m[1], m[2] })) * local });
}

void PixelShader::shade(const PixelRange& tile, std::uint8_t* rgba) const
{
  // Step by step for the whole tile: memory is asked for what the next step reads.
  std::array<Row, DepthTileSize> rows;
  const auto forEachRow = [&](const auto& step)
  { std::for_each(rows.begin(), rows.begin() + (tile.y1 - tile.y0), step); };
  for (int y = tile.y0; y < tile.y1; ++y)
  {
    load(tile, y, rows[static_cast<std::size_t>(y - tile.y0)]);
  }
  if (usesOcclusion_)
  {
    forEachRow([&](Row& row) { row.any ? in_.textures.request(row.lookup) : void(); });
    forEachRow([&](Row& row) { row.any ? in_.textures.locate(row.lookup) : void(); });
  }
  forEachRow([&](const Row& row) { shade(row, rgba + 4 * row.pixel); });
}

inline std::int64_t PixelShader::particleOf(std::uint32_t sphere) const
{
  return in_.particles ? in_.particles[sphere] : static_cast<std::int64_t>(sphere);
}

void PixelShader::load(const PixelRange& tile, int y, Row& row) const
{
  row.x = tile.x0;
  row.y = y;
  row.pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(in_.frame.width) +
    static_cast<std::size_t>(tile.x0);
  row.count = static_cast<std::size_t>(tile.x1 - tile.x0);
  const std::uint32_t* spheres = in_.frame.sphere.data() + row.pixel;
  const Vec3f* normals = in_.frame.normal.data() + row.pixel;
  prefetchBlock(spheres + Size); // of the tile to the right
  prefetchBlock(normals + Size);
  row.any =
    std::count(spheres, spheres + row.count, SphereScene::None) != std::ptrdiff_t(row.count);
  if (!row.any)
  {
    return;
  }
  for (std::size_t lane = 0; lane < Size; ++lane)
  {
    const bool shown = lane < row.count && spheres[lane] != SphereScene::None;
    row.shown[lane] = shown;
    row.lookup.particles[lane] = shown && needsParticles_ ? particleOf(spheres[lane]) : -1;
    const Vec3f normal = lane < row.count ? normals[lane] : Vec3f{};
    row.lookup.texels.x[lane] = normal.x;
    row.lookup.texels.y[lane] = normal.y;
    row.lookup.texels.z[lane] = normal.z;
  }
}

void PixelShader::shade(const Row& row, std::uint8_t* rgba) const
{
  if (!row.any)
  {
    std::fill_n(rgba, 4 * row.count, std::uint8_t(0));
    return;
  }
  PixelBlock block;
  std::fill_n(block.occlusion, Size, 1.0f);
  if (usesOcclusion_)
  {
    in_.textures.finish(row.lookup, block.occlusion);
  }
  loadColors(row, block);
  if (!terms_.occlusionOnly && terms_.lit)
  {
    gatherLight(row, block);
  }
  std::uint8_t bytes[4 * Size];
  composeColors(terms_, block, row.shown, row.count == Size ? rgba : bytes);
  if (row.count != Size)
  {
    std::copy_n(bytes, 4 * row.count, rgba);
  }
}

void PixelShader::loadColors(const Row& row, PixelBlock& block) const
{
  fill(block.ambientColor, in_.material.ambientColor);
  fill(block.diffuseColor, in_.material.diffuseColor);
  std::fill_n(
    block.alpha, Size, in_.material.translucent ? toByte(float(in_.material.opacity)) : 255);
  for (std::size_t lane = 0; in_.material.particleColors && lane < Size; ++lane)
  {
    if (row.shown[lane] != 0)
    {
      loadParticleColor(in_.material.particleColors + 4 * row.lookup.particles[lane], lane, block);
    }
  }
}

void PixelShader::loadParticleColor(
  const std::uint8_t* rgba, std::size_t lane, PixelBlock& block) const
{
  for (std::size_t c = 0; c < 3; ++c)
  {
    block.ambientColor[c][lane] = block.diffuseColor[c][lane] = (1.0f / 255) * rgba[c];
  }
  block.alpha[lane] = in_.material.translucent ? rgba[3] : 255;
}

void PixelShader::gatherLight(const Row& row, PixelBlock& block) const
{
  fill(block.diffuseLight, {});
  fill(block.specularLight, {});
  if (isParallel_)
  {
    gatherParallel(row, block);
    return;
  }
  for (std::size_t lane = 0; lane < row.count; ++lane)
  {
    if (row.shown[lane] != 0)
    {
      gatherAt(row.x + static_cast<int>(lane), row.y, row.pixel + lane, lane, block);
    }
  }
}

/// Lights without a place, no highlights, lengths that scale evenly: the local normal will do.
void PixelShader::gatherParallel(const Row& row, PixelBlock& block) const
{
  for (const PreparedLight& light : lights_)
  {
    std::uint8_t reach[Size] = {};
    if (light.mask)
    {
      std::copy_n(light.mask + row.pixel, row.count, reach);
    }
    addLight({ light.toLightLocal, light.light->color, light.mask ? reach : nullptr },
      row.lookup.texels, block);
  }
}

void PixelShader::gatherAt(
  int x, int y, std::size_t pixel, std::size_t lane, PixelBlock& block) const
{
  const TracedFrame& frame = in_.frame;
  const Vec3f normal = normalInWorld(frame.normal[pixel]);
  const Vec3d point = needsPoint_
    ? in_.rays.worldPoint(x + frame.sampleX, y + frame.sampleY, frame.t[pixel])
    : Vec3d{};
  const Vec3f view = needsView_
    ? in_.rays.worldDirection(x + frame.sampleX, y + frame.sampleY).as<float>()
    : Vec3f{};
  for (const PreparedLight& prepared : lights_)
  {
    if (prepared.mask && prepared.mask[pixel] == 0)
    {
      continue;
    }
    const Light& light = *prepared.light;
    const IncidentLight incident = illuminate(light, point);
    const Vec3f toLight = incident.direction.as<float>();
    const float facing = dot(normal, toLight);
    const auto strength = static_cast<float>(incident.strength);
    if (facing <= 0 || strength <= 0)
    {
      continue;
    }
    add(block.diffuseLight, lane, strength * facing, light.color);
    if (needsView_)
    {
      add(
        block.specularLight, lane, strength * highlight(light, toLight, normal, view), light.color);
    }
  }
}

float PixelShader::highlight(const Light& light, Vec3f toLight, Vec3f normal, Vec3f view) const
{
  // The mirrored ray for all lights but a lone headlight, whose direction is the axis of view.
  const float facing = dot(normal, toLight);
  const Vec3f mirrored = 2 * facing * normal - toLight;
  const float cosine = light.headlight ? facing : -dot(mirrored, view);
  return std::pow(std::max(cosine, 1e-5f), static_cast<float>(in_.material.specularPower));
}

Vec3f PixelShader::normalInWorld(Vec3f n) const
{
  const auto& m = toLocal_;
  return normalized(Vec3f{ n.x * m[0] + n.y * m[3] + n.z * m[6],
    n.x * m[1] + n.y * m[4] + n.z * m[7], n.x * m[2] + n.y * m[5] + n.z * m[8] });
}
}
