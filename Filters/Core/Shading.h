// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Shading_h
#define po_Shading_h

#include "FrameTracer.h"
#include "OcclusionTextures.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace po
{
/// A light in world space, with the meaning that OpenGL gave to the numbers.
struct Light
{
  bool positional = false;
  Vec3d position;              ///< of a positional light
  Vec3d direction{ 0, 0, -1 }; ///< unit vector along which the light shines
  Vec3f color{ 1, 1, 1 };      ///< intensity included
  double coneAngle = 180;      ///< degrees from the axis; from 90 on there is no cone
  double exponent = 0;         ///< decline within the cone: cos^exponent
  std::array<double, 3> attenuation{ 1, 0, 0 }; ///< 1 / (a0 + a1 d + a2 d^2) at distance d
  /// Highlights by cos^n of the angle to the axis of view instead of to the mirrored ray: how VTK
  /// draws a lone headlight.
  bool headlight = false;

  [[nodiscard]] bool operator==(const Light& other) const;
};

/// The light that reaches a point.
struct IncidentLight
{
  Vec3d direction; ///< unit vector towards the light
  double distance; ///< to a positional light, otherwise infinity
  double strength; ///< attenuation and cone, at least 0
};

[[nodiscard]] IncidentLight illuminate(const Light& light, Vec3d worldPoint);

/// Which pixels each light reaches.
struct ShadowMasks
{
  std::vector<std::vector<std::uint8_t>> lit; ///< one mask a light; an empty one: all pixels
};

struct ShadowCounters
{
  std::size_t rays = 0;
  std::size_t skipped = 0; ///< pixels whose surface faces away, or is out of reach of the light
};

/// Traces one occlusion ray for each pixel that the light may reach. Occluders are all spheres of
/// the scene, seen or not, but the hidden ones.
/// @param hidden see FrameSettings
ShadowCounters traceShadows(const SphereScene& scene, const std::uint8_t* hidden,
  const PrimaryRays& rays, const TracedFrame& frame, const Light& light,
  std::vector<std::uint8_t>& lit);

enum class ShadingMode
{
  DirectLight = 0,      ///< ambient + diffuse + specular; textures are not used
  AmbientOcclusion = 1, ///< occlusion times the surface's colour; lights are not used
  Both = 2
};

/// Surface and style, with VTK's meaning of the coefficients.
struct Material
{
  ShadingMode mode = ShadingMode::Both;
  bool occlusionOnDiffuse = true; ///< in mode Both occlusion scales diffuse light too
  bool lighting = true;           ///< off: ambient + diffuse colour as they are
  double ambient = 0, diffuse = 1, specular = 0, specularPower = 1;
  Vec3f ambientColor{ 1, 1, 1 }, diffuseColor{ 1, 1, 1 }, specularColor{ 1, 1, 1 };
  bool translucent = false; ///< off: opacities do not count
  double opacity = 1;       ///< 0 to 1; not used with colours of particles, which bring their own
  /// RGBA of each particle in place of the ambient and diffuse colours, or null.
  const std::uint8_t* particleColors = nullptr;
  std::uint64_t colorsVersion = 0; ///< another number for other contents of particleColors

  [[nodiscard]] bool operator==(const Material& other) const;

  /// Do lights take part?
  [[nodiscard]] bool usesLights() const;
};

/// Everything that colours a traced frame.
struct ShadingInput
{
  const PrimaryRays& rays;
  const TracedFrame& frame;
  const std::int64_t*
    particles; ///< of each sphere, see SphereCloud; null: each sphere's own number
  const OcclusionTextures& textures;
  const std::vector<Light>& lights;
  const ShadowMasks& shadows; ///< fewer masks than lights: the others cast no shadows
  Material material;
};

/// RGBA bytes of each pixel, computed in parallel: alpha is opacity, colour is not multiplied by
/// it. The background is all 0.
void shadeFrame(const ShadingInput& input, std::vector<std::uint8_t>& rgba);

/// Occlusion value of each pixel, 0 on background.
void lookUpOcclusion(const TracedFrame& frame, const std::vector<std::int64_t>& particles,
  const OcclusionTextures& textures, std::vector<float>& occlusion);

/// World-space unit normal of a pixel that shows a sphere.
[[nodiscard]] Vec3d worldNormal(const PrimaryRays& rays, Vec3f localNormal);
}

#endif
