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
  return static_cast<std::uint8_t>(255.0f * std::clamp(value, 0.0f, 1.0f) + 0.5f);
}

/// Diffuse and specular light at a point, before the surface's colours.
struct DirectLight
{
  Vec3f diffuse, specular;
};

Vec3f particleColor(const Material& material, std::int64_t particle, Vec3f otherwise)
{
  if (!material.particleColors)
  {
    return otherwise;
  }
  const std::uint8_t* rgba = material.particleColors + 4 * particle;
  return (1.0f / 255) * Vec3f{ float(rgba[0]), float(rgba[1]), float(rgba[2]) };
}

/// Colours pixels one by one. What few scenes need, such as the direction of view (for highlights)
/// or the place of the hit (for lights that have a place), is computed only for those.
class PixelShader
{
public:
  explicit PixelShader(const ShadingInput& input)
    : in_(input)
    , needsView_(input.material.specular > 0)
  {
    for (std::size_t i = 0; i < input.lights.size(); ++i)
    {
      const bool masked = i < input.shadows.lit.size() && !input.shadows.lit[i].empty();
      masks_.push_back(masked ? input.shadows.lit[i].data() : nullptr);
      needsPoint_ = needsPoint_ || input.lights[i].positional;
    }
    const double scale = 1 / largestEntry();
    for (std::size_t i = 0; i < toLocal_.size(); ++i)
    {
      toLocal_[i] = static_cast<float>(scale * input.rays.worldToLocal()[4 * (i / 3) + i % 3]);
    }
  }

  [[nodiscard]] Vec3f shade(int x, int y, std::size_t pixel) const
  {
    const Material& m = in_.material;
    const std::int64_t particle = in_.particles[in_.frame.sphere[pixel]];
    const Vec3f diffuseColor = particleColor(m, particle, m.diffuseColor);
    const float occlusion = m.mode == ShadingMode::DirectLight
      ? 1.0f
      : in_.textures.at(static_cast<std::size_t>(particle), in_.frame.normal[pixel]);
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
    const DirectLight light = gather(x, y, pixel);
    return ambient + diffuse * modulate(light.diffuse, diffuseColor) +
      static_cast<float>(m.specular) * modulate(light.specular, m.specularColor);
  }

private:
  /// Normals follow the transpose of worldToLocal; a common factor does not matter to them, and
  /// keeps any scale of the data within the range of a float.
  [[nodiscard]] double largestEntry() const
  {
    double largest = 0;
    for (std::size_t row = 0; row < 3; ++row)
    {
      for (std::size_t column = 0; column < 3; ++column)
      {
        largest = std::max(largest, std::abs(in_.rays.worldToLocal()[4 * row + column]));
      }
    }
    return largest;
  }

  [[nodiscard]] Vec3f normalInWorld(Vec3f n) const
  {
    const auto& m = toLocal_;
    return normalized(Vec3f{ n.x * m[0] + n.y * m[3] + n.z * m[6],
      n.x * m[1] + n.y * m[4] + n.z * m[7], n.x * m[2] + n.y * m[5] + n.z * m[8] });
  }

  [[nodiscard]] DirectLight gather(int x, int y, std::size_t pixel) const
  {
    const Vec3f normal = normalInWorld(in_.frame.normal[pixel]);
    const Vec3d point =
      needsPoint_ ? in_.rays.worldPoint(x + 0.5, y + 0.5, in_.frame.t[pixel]) : Vec3d{};
    const Vec3f view = needsView_ ? in_.rays.worldDirection(x + 0.5, y + 0.5).as<float>() : Vec3f{};
    DirectLight sum;
    for (std::size_t i = 0; i < in_.lights.size(); ++i)
    {
      if (masks_[i] && masks_[i][pixel] == 0)
      {
        continue;
      }
      const Light& light = in_.lights[i];
      const IncidentLight incident = illuminate(light, point);
      const Vec3f toLight = incident.direction.as<float>();
      const float facing = dot(normal, toLight);
      const auto strength = static_cast<float>(incident.strength);
      if (facing <= 0 || strength <= 0)
      {
        continue;
      }
      sum.diffuse = sum.diffuse + (strength * facing) * light.color;
      if (needsView_)
      {
        sum.specular =
          sum.specular + (strength * highlight(light, toLight, normal, view)) * light.color;
      }
    }
    return sum;
  }

  [[nodiscard]] float highlight(const Light& light, Vec3f toLight, Vec3f normal, Vec3f view) const
  {
    // The mirrored ray for all lights but a lone headlight, whose direction is the axis of view.
    const float facing = dot(normal, toLight);
    const Vec3f mirrored = 2 * facing * normal - toLight;
    const float cosine = light.headlight ? facing : -dot(mirrored, view);
    return std::pow(std::max(cosine, 1e-5f), static_cast<float>(in_.material.specularPower));
  }

  const ShadingInput& in_;
  std::vector<const std::uint8_t*> masks_; ///< of each light, or null: it reaches all pixels
  std::array<float, 9> toLocal_{};         ///< linear part of worldToLocal, by rows, scaled
  bool needsPoint_ = false;
  bool needsView_;
};

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
  const Sphere sphere = scene.set().inBrick(frame.sphere[pixel]);
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
  rgba.resize(4 * in.frame.pixels());
  const PixelShader shader(in);
  const auto shadeRow = [&](int y)
  {
    std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(in.frame.width);
    for (int x = 0; x < in.frame.width; ++x, ++pixel)
    {
      const bool hit = in.frame.sphere[pixel] != SphereScene::None;
      const Vec3f color = hit ? shader.shade(x, y, pixel) : Vec3f{};
      std::uint8_t* bytes = rgba.data() + 4 * pixel;
      bytes[0] = toByte(color.x);
      bytes[1] = toByte(color.y);
      bytes[2] = toByte(color.z);
      bytes[3] = hit ? 255 : 0;
    }
  };
  tbb::parallel_for(0, in.frame.height, shadeRow);
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
