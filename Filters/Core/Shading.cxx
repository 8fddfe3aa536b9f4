// SPDX-License-Identifier: BSD-3-Clause
#include "Shading.h"

#include "Constants.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace po
{
namespace
{
/// Calls f(x, y, pixel) for all pixels that show a sphere, rows in parallel.
template <typename Function>
void forEachHit(const TracedFrame& frame, const Function& f)
{
  tbb::parallel_for(tbb::blocked_range<int>(0, frame.height),
    [&](const tbb::blocked_range<int>& rows)
    {
      for (int y = rows.begin(); y < rows.end(); ++y)
      {
        std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width);
        for (int x = 0; x < frame.width; ++x, ++pixel)
        {
          if (frame.sphere[pixel] != SphereScene::None)
          {
            f(x, y, pixel);
          }
        }
      }
    });
}

/// Component by component.
Vec3f modulate(Vec3f a, Vec3f b)
{
  return { a.x * b.x, a.y * b.y, a.z * b.z };
}

std::uint8_t toByte(float value)
{
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

/// Diffuse and specular light at a point, before the surface's colours.
struct DirectLight
{
  Vec3f diffuse, specular;
};

double highlight(const Light& light, Vec3d toLight, Vec3d normal, Vec3d view, double power)
{
  // The mirrored ray for all lights but a lone headlight, whose direction is the axis of view.
  const double facing = dot(normal, toLight);
  const Vec3d mirrored = 2 * facing * normal - toLight;
  const double cosine = light.headlight ? facing : -dot(mirrored, view);
  return std::pow(std::max(cosine, 1e-5), power);
}

DirectLight gather(const ShadingInput& in, std::size_t pixel, Vec3d point, Vec3d normal, Vec3d view)
{
  DirectLight sum;
  for (std::size_t i = 0; i < in.lights.size(); ++i)
  {
    const bool masked = i < in.shadows.lit.size() && !in.shadows.lit[i].empty();
    if (masked && in.shadows.lit[i][pixel] == 0)
    {
      continue;
    }
    const Light& light = in.lights[i];
    const IncidentLight incident = illuminate(light, point);
    const double facing = dot(normal, incident.direction);
    if (facing <= 0 || incident.strength <= 0)
    {
      continue;
    }
    sum.diffuse = sum.diffuse + static_cast<float>(incident.strength * facing) * light.color;
    if (in.material.specular > 0)
    {
      const double shine =
        highlight(light, incident.direction, normal, view, in.material.specularPower);
      sum.specular = sum.specular + static_cast<float>(incident.strength * shine) * light.color;
    }
  }
  return sum;
}

Vec3f particleColor(const Material& material, std::int64_t particle, Vec3f otherwise)
{
  if (!material.particleColors)
  {
    return otherwise;
  }
  const std::uint8_t* rgba = material.particleColors + 4 * particle;
  return (1.0f / 255) * Vec3f{ float(rgba[0]), float(rgba[1]), float(rgba[2]) };
}

Vec3f shadePixel(const ShadingInput& in, int x, int y, std::size_t pixel)
{
  const Material& m = in.material;
  const TracedFrame& frame = in.frame;
  const std::int64_t particle = in.particles[frame.sphere[pixel]];
  const Vec3f normal = frame.normal[pixel];
  const Vec3f diffuseColor = particleColor(m, particle, m.diffuseColor);
  const float occlusion = m.mode == ShadingMode::DirectLight
    ? 1.0f
    : in.textures.at(static_cast<std::size_t>(particle), normal.as<double>());
  if (m.mode == ShadingMode::AmbientOcclusion)
  {
    return occlusion * diffuseColor;
  }
  const Vec3f ambient =
    static_cast<float>(m.ambient) * occlusion * particleColor(m, particle, m.ambientColor);
  const float diffuse = static_cast<float>(m.diffuse) * (m.occlusionOnDiffuse ? occlusion : 1.0f);
  if (!m.lighting)
  {
    return ambient + diffuse * diffuseColor;
  }
  const DirectLight light = gather(in, pixel, in.rays.worldPoint(x + 0.5, y + 0.5, frame.t[pixel]),
    worldNormal(in.rays, normal), in.rays.worldDirection(x + 0.5, y + 0.5));
  return ambient + diffuse * modulate(light.diffuse, diffuseColor) +
    static_cast<float>(m.specular) * modulate(light.specular, m.specularColor);
}

/// Does the light reach the hit? One ray at most; counts what was done.
bool isLit(const SphereScene& scene, const PrimaryRays& rays, const TracedFrame& frame,
  const Light& light, int x, int y, std::size_t pixel, bool& traced)
{
  const IncidentLight incident =
    illuminate(light, rays.worldPoint(x + 0.5, y + 0.5, frame.t[pixel]));
  const Vec3d normal = frame.normal[pixel].as<double>();
  const Vec3d toLight = transformVector(rays.worldToLocal(), incident.direction);
  // A surface that faces away is dark by itself. The sign is the same in local and world space.
  traced = incident.strength > 0 && dot(normal, toLight) > 0;
  if (!traced)
  {
    return false;
  }
  const Sphere& sphere = scene.spheres()[frame.sphere[pixel]];
  const Vec3d origin = sphere.center().as<double>() + static_cast<double>(sphere.radius) * normal;
  const double localPerWorld = length(toLight);
  return !scene.occluded(origin.as<float>(), ((1 / localPerWorld) * toLight).as<float>(),
    static_cast<float>(incident.distance * localPerWorld), frame.sphere[pixel]);
}
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

ShadowCounters traceShadows(const SphereScene& scene, const PrimaryRays& rays,
  const TracedFrame& frame, const Light& light, std::vector<std::uint8_t>& lit)
{
  constexpr std::uint8_t Skipped = 2;
  lit.assign(frame.pixels(), 0);
  forEachHit(frame,
    [&](int x, int y, std::size_t pixel)
    {
      bool traced = false;
      const bool reached = isLit(scene, rays, frame, light, x, y, pixel, traced);
      lit[pixel] = traced ? reached : Skipped;
    });
  ShadowCounters counters;
  for (std::size_t pixel = 0; pixel < lit.size(); ++pixel)
  {
    const bool hit = frame.sphere[pixel] != SphereScene::None;
    const bool skipped = lit[pixel] == Skipped;
    counters.rays += hit && !skipped;
    counters.skipped += skipped;
    lit[pixel] = skipped ? 0 : lit[pixel];
  }
  return counters;
}

void shadeFrame(const ShadingInput& in, std::vector<std::uint8_t>& rgba)
{
  rgba.assign(4 * in.frame.pixels(), 0);
  forEachHit(in.frame,
    [&](int x, int y, std::size_t pixel)
    {
      const Vec3f color = shadePixel(in, x, y, pixel);
      rgba[4 * pixel + 0] = toByte(color.x);
      rgba[4 * pixel + 1] = toByte(color.y);
      rgba[4 * pixel + 2] = toByte(color.z);
      rgba[4 * pixel + 3] = 255;
    });
}

void lookUpOcclusion(const TracedFrame& frame, const std::vector<std::int64_t>& particles,
  const OcclusionTextures& textures, std::vector<float>& occlusion)
{
  occlusion.assign(frame.pixels(), 0);
  forEachHit(frame,
    [&](int, int, std::size_t pixel)
    {
      const auto particle = static_cast<std::size_t>(particles[frame.sphere[pixel]]);
      occlusion[pixel] = textures.at(particle, frame.normal[pixel].as<double>());
    });
}

Vec3d worldNormal(const PrimaryRays& rays, Vec3f localNormal)
{
  return normalized(transformTransposed(rays.worldToLocal(), localNormal.as<double>()));
}
}
