// SPDX-License-Identifier: BSD-3-Clause
#include "SphereRenderer.h"

#include "FreeLength.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace po
{
namespace
{
double secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Writes the seconds of its own life to a variable.
class Stopwatch
{
public:
  explicit Stopwatch(double& seconds)
    : seconds_(seconds)
  {
  }
  ~Stopwatch() { seconds_ = secondsSince(start_); }
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

bool sameStyle(const Style& a, const Style& b)
{
  return a.material == b.material && a.texturesVersion == b.texturesVersion &&
    a.lights == b.lights && a.shadows == b.shadows && a.maximumLayers == b.maximumLayers;
}

/// Multiplies the light of each pixel by what the layer lets through, and tells which pixels still
/// get a visible share from behind.
std::vector<std::uint8_t> pixelsToLookBehind(const FrameLayer& layer, std::vector<float>& light)
{
  constexpr float Visible = 0.5f / 255;
  std::vector<std::uint8_t> wanted(light.size());
  for (std::size_t pixel = 0; pixel < light.size(); ++pixel)
  {
    light[pixel] *= 1 - float(layer.rgba[4 * pixel + 3]) / 255;
    const bool hit = layer.frame.sphere[pixel] != SphereScene::None;
    wanted[pixel] = hit && light[pixel] >= Visible ? 1 : 0;
  }
  return wanted;
}

bool countsUp(const std::vector<std::int64_t>& ids)
{
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (ids[i] != static_cast<std::int64_t>(i))
    {
      return false;
    }
  }
  return true;
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
  freeLength_.reset();
  isComplete_ = countsUp(cloud_.sourceIds);
  hidden_.clear();
  scene_.reset();
  forgetFrame();
}

double SphereRenderer::freeLength() const
{
  if (!freeLength_)
  {
    freeLength_ =
      meanFreeLength(cloud_, { static_cast<double>(cloud_.spheres.size()), cloud_.scale });
  }
  return *freeLength_;
}

void SphereRenderer::setHidden(std::vector<std::uint8_t> hidden)
{
  if (hidden != hidden_)
  {
    hidden_ = std::move(hidden);
    forgetFrame();
  }
}

void SphereRenderer::forgetFrame()
{
  frameIsCurrent_ = false;
  isShaded_ = false;
  first_.shadowLights.clear();
  behind_.clear();
  isNewView_ = true;
  tracedSample_ = 0;
}

FrameSettings SphereRenderer::settings(SamplePlace place) const
{
  return { place.x, place.y, hidden_.empty() ? nullptr : hidden_.data() };
}

void SphereRenderer::buildScene()
{
  const Stopwatch watch(statistics_.buildSeconds);
  scene_ = scenes_->get(cloud_.spheres, cloud_.centers);
}

bool SphereRenderer::isCurrent(const Camera& camera, const Matrix4& modelToWorld) const
{
  return frameIsCurrent_ && sameView(camera, camera_) && modelToWorld == modelToWorld_;
}

bool SphereRenderer::trace(const Camera& camera, const Matrix4& modelToWorld)
{
  if (isCurrent(camera, modelToWorld))
  {
    return true;
  }
  forgetFrame();
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
    statistics_.trace = traceFrame(*scene_, *rays_, settings(), first_.frame);
  }
  ++statistics_.framesTraced;
  camera_ = camera;
  modelToWorld_ = modelToWorld;
  frameIsCurrent_ = true;
  return true;
}

void SphereRenderer::castShadows(FrameLayer& layer)
{
  const std::vector<Light>& lights = style_.lights;
  const auto isKept = [&](std::size_t i)
  { return i < layer.shadowLights.size() && sameReach(lights[i], layer.shadowLights[i]); };
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    if (!isKept(i))
    {
      moved.push_back(i);
    }
  }
  layer.shadows.lit.resize(lights.size());
  layer.shadowLights = lights;
  if (moved.empty())
  {
    return; // the statistics stay those of the last time
  }
  const Stopwatch watch(statistics_.shadowSeconds);
  statistics_.shadows = {};
  for (const std::size_t i : moved)
  {
    const ShadowCounters counters = traceShadows(
      *scene_, settings().hidden, *rays_, layer.frame, lights[i], layer.shadows.lit[i]);
    statistics_.shadows.rays += counters.rays;
    statistics_.shadows.skipped += counters.skipped;
    ++statistics_.shadowsTraced;
  }
}

void SphereRenderer::shadeLayer(FrameLayer& layer)
{
  if (style_.shadows && style_.material.usesLights())
  {
    castShadows(layer);
  }
  else
  {
    layer.shadowLights.clear();
    layer.shadows.lit.clear();
  }
  const std::int64_t* particles = isComplete_ ? nullptr : cloud_.sourceIds.data();
  shadeFrame({ *rays_, layer.frame, particles, style_.textures, style_.lights, layer.shadows,
               style_.material },
    layer.rgba);
}

void SphereRenderer::shade(const Style& style)
{
  const bool arrived = style.textures.paged() && style.textures.paged()->collect() > 0;
  const bool canAdd = lacksTextures_ && (arrived || style.waitForTextures);
  if (isShaded_ && !canAdd && sameStyle(style, style_))
  {
    return;
  }
  style_ = style;
  const Stopwatch watch(statistics_.shadeSeconds);
  beginPicture();
  statistics_.missingTextures = fetchTextures(first_.frame);
  shadeLayer(first_);
  shadeBehind();
  lacksTextures_ = isWaiting();
  ++statistics_.framesShaded;
  average_.clear();
  rimDepth_.clear();
  samples_ = 1;
  isShaded_ = true;
}

void SphereRenderer::beginPicture()
{
  if (isNewView_ && style_.textures.paged())
  {
    style_.textures.paged()->beginView();
  }
  isNewView_ = false;
}

/// Asks for the textures that a frame shows, where they are loaded while they are seen.
/// @return how many are missing
std::size_t SphereRenderer::fetchTextures(const TracedFrame& frame)
{
  const std::shared_ptr<PagedTextures>& paged = style_.textures.paged();
  if (!paged)
  {
    return 0;
  }
  const std::vector<std::int32_t>& rows =
    demand_.of(frame, cloud_.sourceIds, style_.textures, paged->size());
  const std::size_t missing = paged->demand(rows);
  if (!style_.waitForTextures || !paged->isLoading())
  {
    return missing;
  }
  const auto start = std::chrono::steady_clock::now();
  paged->wait();
  statistics_.waitSeconds += secondsSince(start);
  return paged->demand(rows);
}

bool SphereRenderer::isWaiting() const
{
  return style_.textures.paged() && style_.textures.paged()->isLoading();
}

bool SphereRenderer::canGoOn() const
{
  return !isWaiting() || style_.textures.paged()->hasNews();
}

void SphereRenderer::shadeBehind()
{
  if (!style_.material.translucent)
  {
    behind_.clear();
    return;
  }
  const auto most = static_cast<std::size_t>(std::max(style_.maximumLayers - 1, 0));
  behind_.resize(std::min(behind_.size(), most));
  std::vector<float> light(first_.frame.pixels(), 1); // that all layers so far let through
  for (std::size_t number = 0; number < most; ++number)
  {
    const FrameLayer& inFront = number == 0 ? first_ : behind_[number - 1];
    if (!traceLayer(inFront, number, pixelsToLookBehind(inFront, light)))
    {
      behind_.resize(number);
      return;
    }
    statistics_.missingTextures += fetchTextures(behind_[number].frame);
    shadeLayer(behind_[number]);
  }
}

bool SphereRenderer::traceLayer(
  const FrameLayer& inFront, std::size_t number, std::vector<std::uint8_t> wanted)
{
  if (std::find(wanted.begin(), wanted.end(), 1) == wanted.end())
  {
    return false;
  }
  if (number < behind_.size() && behind_[number].wanted == wanted)
  {
    return true;
  }
  behind_.resize(number);
  FrameLayer layer;
  layer.wanted = std::move(wanted);
  const TraceCounters counters =
    traceBehind(*scene_, *rays_, settings(), inFront.frame, layer.wanted, layer.frame);
  ++statistics_.layersTraced;
  if (counters.hits > 0)
  {
    behind_.push_back(std::move(layer));
  }
  return counters.hits > 0;
}

void SphereRenderer::refine(int samples)
{
  if (style_.material.translucent || samples_ >= samples || (lacksTextures_ && isWaiting()))
  {
    return;
  }
  if (rimDepth_.empty())
  {
    average_.add(first_.rgba);
    rimDepth_.assign(first_.frame.pixels(), 2);
  }
  for (; samples_ < samples; ++samples_)
  {
    traceSample();
    fetchTextures(sample_.frame);
    if (isWaiting())
    {
      break;
    }
    shadeLayer(sample_);
    average_.add(sample_.rgba);
    addRims(sample_.frame);
    ++statistics_.samplesAdded;
  }
  average_.write(first_.rgba);
}

/// The next sample, unless it was traced before and waits for textures.
void SphereRenderer::traceSample()
{
  if (tracedSample_ != samples_)
  {
    (void)traceFrame(*scene_, *rays_, settings(samplePlace(samples_)), sample_.frame);
    sample_.shadowLights.clear();
    tracedSample_ = samples_;
  }
}

void SphereRenderer::addRims(const TracedFrame& sample)
{
  for (std::size_t pixel = 0; pixel < rimDepth_.size(); ++pixel)
  {
    if (first_.frame.sphere[pixel] == SphereScene::None)
    {
      rimDepth_[pixel] = std::min(rimDepth_[pixel], sample.windowDepth[pixel]);
    }
  }
}
}
