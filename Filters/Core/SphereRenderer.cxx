// SPDX-License-Identifier: BSD-3-Clause
#include "SphereRenderer.h"

#include <chrono>
#include <utility>

namespace po
{
namespace
{
/// Writes the seconds of its own life to a variable.
class Stopwatch
{
public:
  explicit Stopwatch(double& seconds)
    : seconds_(seconds)
  {
  }
  ~Stopwatch()
  {
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

bool sameView(const Camera& a, const Camera& b)
{
  return a.worldToEye == b.worldToEye && a.eyeToClip == b.eyeToClip && a.width == b.width &&
    a.height == b.height;
}

/// Do both lights reach the same points? Colours do not matter, nor how fast the light declines.
bool sameReach(const Light& a, const Light& b)
{
  const bool sameCone = a.coneAngle == b.coneAngle && a.direction == b.direction;
  return a.positional == b.positional &&
    (a.positional ? sameCone && a.position == b.position : a.direction == b.direction);
}

Matrix4 localToModel(const SphereCloud& cloud)
{
  const double s = cloud.scale;
  const Vec3d o = cloud.origin;
  return { s, 0, 0, o.x, 0, s, 0, o.y, 0, 0, s, o.z, 0, 0, 0, 1 };
}
}

void SphereRenderer::setCloud(SphereCloud cloud)
{
  cloud_ = std::move(cloud);
  scene_.reset();
  frameIsCurrent_ = false;
  isShaded_ = false;
}

void SphereRenderer::buildScene()
{
  const Stopwatch watch(statistics_.buildSeconds);
  scene_ = scenes_->get(cloud_.spheres, cloud_.centers);
}

bool SphereRenderer::trace(const Camera& camera, const Matrix4& modelToWorld)
{
  if (frameIsCurrent_ && sameView(camera, camera_) && modelToWorld == modelToWorld_)
  {
    return true;
  }
  frameIsCurrent_ = false;
  isShaded_ = false;
  shadowLights_.clear();
  rays_ = PrimaryRays::make(camera, multiply(modelToWorld, localToModel(cloud_)));
  if (!rays_)
  {
    return false;
  }
  if (!scene_)
  {
    buildScene();
  }
  {
    const Stopwatch watch(statistics_.traceSeconds);
    statistics_.trace = traceFrame(*scene_, *rays_, frame_);
  }
  ++statistics_.framesTraced;
  camera_ = camera;
  modelToWorld_ = modelToWorld;
  frameIsCurrent_ = true;
  return true;
}

void SphereRenderer::castShadows(const std::vector<Light>& lights)
{
  const auto isKept = [&](std::size_t i)
  { return i < shadowLights_.size() && sameReach(lights[i], shadowLights_[i]); };
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    if (!isKept(i))
    {
      moved.push_back(i);
    }
  }
  shadows_.lit.resize(lights.size());
  shadowLights_ = lights;
  if (moved.empty())
  {
    return; // the statistics stay those of the last time
  }
  const Stopwatch watch(statistics_.shadowSeconds);
  statistics_.shadows = {};
  for (const std::size_t i : moved)
  {
    const ShadowCounters counters =
      traceShadows(*scene_, *rays_, frame_, lights[i], shadows_.lit[i]);
    statistics_.shadows.rays += counters.rays;
    statistics_.shadows.skipped += counters.skipped;
    ++statistics_.shadowsTraced;
  }
}

void SphereRenderer::shade(const Material& material, const OcclusionTextures& textures,
  const std::vector<Light>& lights, bool shadows)
{
  const bool direct = material.mode != ShadingMode::AmbientOcclusion && material.lighting &&
    (material.diffuse > 0 || material.specular > 0);
  if (shadows && direct)
  {
    castShadows(lights);
  }
  else
  {
    shadowLights_.clear();
    shadows_.lit.clear();
  }
  const Stopwatch watch(statistics_.shadeSeconds);
  shadeFrame({ *rays_, frame_, cloud_.sourceIds, textures, lights, shadows_, material }, rgba_);
  isShaded_ = true;
}
}
