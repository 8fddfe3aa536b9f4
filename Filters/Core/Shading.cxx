// SPDX-License-Identifier: BSD-3-Clause
#include "Shading.h"

#include "Constants.h"
#include "ForEachHit.h"
#include "PixelShader.h"

#include <cmath>
#include <tuple>

namespace po
{
bool Light::operator==(const Light& o) const
{
  const auto all = [](const Light& l)
  {
    return std::tuple(l.positional, l.position.x, l.position.y, l.position.z, l.direction.x,
      l.direction.y, l.direction.z, l.color.x, l.color.y, l.color.z, l.coneAngle, l.exponent,
      l.attenuation, l.headlight);
  };
  return all(*this) == all(o);
}

bool Material::operator==(const Material& o) const
{
  const auto all = [](const Material& m)
  {
    const auto color = [](Vec3f c) { return std::tuple(c.x, c.y, c.z); };
    return std::tuple(m.mode, m.occlusionOnDiffuse, m.lighting, m.ambient, m.diffuse, m.specular,
      m.specularPower, color(m.ambientColor), color(m.diffuseColor), color(m.specularColor),
      m.translucent, m.opacity, m.particleColors, m.colorsVersion);
  };
  return all(*this) == all(o);
}

bool Material::usesLights() const
{
  return mode != ShadingMode::AmbientOcclusion && lighting && (diffuse > 0 || specular > 0);
}

IncidentLight illuminate(const Light& light, Vec3d point)
{
  if (!light.positional)
  {
    return { -light.direction, std::numeric_limits<double>::infinity(), 1 };
  }
  const Vec3d way = light.position - point;
  const double distance = length(way);
  const Vec3d direction = distance > 0 ? (1 / distance) * way : -light.direction;
  const auto& a = light.attenuation;
  double strength = 1 / (a[0] + a[1] * distance + a[2] * distance * distance);
  if (light.coneAngle < 90)
  {
    constexpr double RadiansPerDegree = Pi / 180;
    const double cosine = -dot(direction, light.direction);
    const bool inside = cosine >= std::cos(RadiansPerDegree * light.coneAngle);
    strength *= inside ? std::pow(cosine, light.exponent) : 0;
  }
  return { direction, distance, strength };
}

void shadeFrame(const ShadingInput& in, std::vector<std::uint8_t>& rgba)
{
  rgba.resize(4 * in.frame.pixels());
  const PixelShader shader(in);
  static_assert(DepthTileSize <= PixelBlock::Size);
  forEachTile(in.frame.width, in.frame.height,
    [&](const PixelRange& tile) { shader.shade(tile, rgba.data()); });
}

void lookUpOcclusion(const TracedFrame& frame, const std::vector<std::int64_t>& particles,
  const OcclusionTextures& textures, std::vector<float>& occlusion)
{
  occlusion.assign(frame.pixels(), 0);
  forEachHit(frame,
    [&](int, int, std::size_t pixel)
    {
      const auto particle = static_cast<std::size_t>(particles[frame.sphere[pixel]]);
      occlusion[pixel] = textures.at(particle, frame.normal[pixel]);
    });
}

Vec3d worldNormal(const PrimaryRays& rays, Vec3f localNormal)
{
  return normalized(transformTransposed(rays.worldToLocal(), localNormal.as<double>()));
}
}
