// SPDX-License-Identifier: BSD-3-Clause
#include "Shading.h"

#include "Constants.h"
#include "ForEachHit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace po
{
namespace
{
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

/// A light as pixels see it, where it is the same for all of them.
struct PreparedLight
{
  const Light* light;
  const std::uint8_t* mask; ///< or null: it reaches all pixels
  Vec3f toLight;            ///< of a light without a place
  Vec3f toLightLocal;       ///< its product with a local normal is that in world space
};

/// Colours pixels. What few scenes need, such as the direction of view (for highlights) or the
/// place of the hit (for lights that have a place), is computed only for those.
class PixelShader
{
public:
  explicit PixelShader(const ShadingInput& input)
    : in_(input)
    , needsView_(input.material.specular > 0)
    , isEven_(input.rays.functions().worldPerLocal > 0)
  {
    const double scale = 1 / largestEntry();
    for (std::size_t i = 0; i < toLocal_.size(); ++i)
    {
      toLocal_[i] = static_cast<float>(scale * input.rays.worldToLocal()[4 * (i / 3) + i % 3]);
    }
    for (std::size_t i = 0; i < input.lights.size(); ++i)
    {
      prepare(i);
      needsPoint_ = needsPoint_ || input.lights[i].positional;
    }
    isSimple_ = isEven_ && !needsView_ && !needsPoint_;
  }

  [[nodiscard]] std::uint8_t alpha(std::size_t pixel) const
  {
    const Material& m = in_.material;
    if (!m.translucent)
    {
      return 255;
    }
    return m.particleColors ? m.particleColors[4 * in_.particles[in_.frame.sphere[pixel]] + 3]
                            : toByte(static_cast<float>(m.opacity));
  }

  /// Occlusion of up to OcclusionTextures::BlockSize pixels, or 1 where it is not used.
  void lookUp(const std::size_t* pixels, std::size_t count, float* occlusion) const
  {
    if (in_.material.mode == ShadingMode::DirectLight || in_.textures.empty())
    {
      std::fill_n(occlusion, count, 1.0f);
      return;
    }
    std::array<std::int64_t, OcclusionTextures::BlockSize> particles;
    std::array<Vec3f, OcclusionTextures::BlockSize> normals;
    for (std::size_t i = 0; i < count; ++i)
    {
      particles[i] = in_.particles[in_.frame.sphere[pixels[i]]];
      normals[i] = in_.frame.normal[pixels[i]];
    }
    in_.textures.lookUp(particles.data(), normals.data(), count, occlusion);
  }

  [[nodiscard]] Vec3f shade(int x, int y, std::size_t pixel, float occlusion) const
  {
    const Material& m = in_.material;
    const std::int64_t particle =
      m.particleColors ? in_.particles[in_.frame.sphere[pixel]] : std::int64_t(0);
    const Vec3f diffuseColor = particleColor(m, particle, m.diffuseColor);
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
    const DirectLight light = isSimple_ ? gatherSimple(pixel) : gather(x, y, pixel);
    return ambient + diffuse * modulate(light.diffuse, diffuseColor) +
      static_cast<float>(m.specular) * modulate(light.specular, m.specularColor);
  }

private:
  void prepare(std::size_t i)
  {
    const bool masked = i < in_.shadows.lit.size() && !in_.shadows.lit[i].empty();
    const Vec3f toLight = (-in_.lights[i].direction).as<float>();
    const auto& m = toLocal_;
    // The transpose of what normals are multiplied by; its rows have one length where lengths scale
    // evenly, and only there this is used.
    const Vec3f local{ dot(Vec3f{ m[0], m[1], m[2] }, toLight),
      dot(Vec3f{ m[3], m[4], m[5] }, toLight), dot(Vec3f{ m[6], m[7], m[8] }, toLight) };
    lights_.push_back({ &in_.lights[i], masked ? in_.shadows.lit[i].data() : nullptr, toLight,
      (1 / length(Vec3f{ m[0], m[1], m[2] })) * local });
  }

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

  /// Lights without a place, no highlights, lengths that scale evenly: the local normal will do.
  [[nodiscard]] DirectLight gatherSimple(std::size_t pixel) const
  {
    const Vec3f normal = in_.frame.normal[pixel];
    DirectLight sum;
    for (const PreparedLight& prepared : lights_)
    {
      const float facing = dot(normal, prepared.toLightLocal);
      if (facing > 0 && !(prepared.mask && prepared.mask[pixel] == 0))
      {
        sum.diffuse = sum.diffuse + facing * prepared.light->color;
      }
    }
    return sum;
  }

  [[nodiscard]] DirectLight gather(int x, int y, std::size_t pixel) const
  {
    const Vec3f normal = normalInWorld(in_.frame.normal[pixel]);
    const TracedFrame& frame = in_.frame;
    const Vec3d point = needsPoint_
      ? in_.rays.worldPoint(x + frame.sampleX, y + frame.sampleY, in_.frame.t[pixel])
      : Vec3d{};
    const Vec3f view = needsView_
      ? in_.rays.worldDirection(x + frame.sampleX, y + frame.sampleY).as<float>()
      : Vec3f{};
    DirectLight sum;
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
  std::vector<PreparedLight> lights_;
  std::array<float, 9> toLocal_{}; ///< linear part of worldToLocal, by rows, scaled
  bool needsPoint_ = false;
  bool needsView_;
  bool isEven_;
  bool isSimple_ = false; ///< see gatherSimple
};
}

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
  constexpr std::size_t Block = OcclusionTextures::BlockSize;
  const auto shadeRow = [&](int y)
  {
    const auto width = static_cast<std::size_t>(in.frame.width);
    const std::size_t first = static_cast<std::size_t>(y) * width;
    std::array<std::size_t, Block> pixels;
    std::array<float, Block> occlusion;
    std::size_t count = 0;
    const auto flush = [&]
    {
      shader.lookUp(pixels.data(), count, occlusion.data());
      for (std::size_t i = 0; i < count; ++i)
      {
        const Vec3f color =
          shader.shade(static_cast<int>(pixels[i] - first), y, pixels[i], occlusion[i]);
        std::uint8_t* bytes = rgba.data() + 4 * pixels[i];
        bytes[0] = toByte(color.x);
        bytes[1] = toByte(color.y);
        bytes[2] = toByte(color.z);
        bytes[3] = shader.alpha(pixels[i]);
      }
      count = 0;
    };
    for (std::size_t pixel = first; pixel < first + width; ++pixel)
    {
      if (in.frame.sphere[pixel] == SphereScene::None)
      {
        std::fill_n(rgba.data() + 4 * pixel, 4, std::uint8_t(0));
        continue;
      }
      pixels[count++] = pixel;
      if (count == Block)
      {
        flush();
      }
    }
    flush();
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
