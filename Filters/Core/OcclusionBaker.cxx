// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionBaker.h"

#include "BakedLight.h"
#include "Dilation.h"
#include "Random.h"
#include "TexelMap.h"
#include "TextureIntake.h"
#include "TextureSizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <utility>

namespace po
{
namespace
{
/// Turns what an estimator finds into rows of a table and means, particle by particle.
class TextureCollector
{
public:
  TextureCollector(const BakeSettings& settings, std::size_t particles, bool outOfCore)
    : settings_(settings)
    , neighbours_(settings.textureResolution)
    , textures_(settings, particles, outOfCore)
    , shares_(texelShares(settings.textureResolution))
    , known_(shares_.size())
    , texture_(shares_.size())
  {
    mean_.reserve(particles);
    for (int row = 0; row < settings.textureResolution; ++row)
    {
      areas_.push_back(texelArea(settings.textureResolution, row));
    }
  }

  void add(const RawTextures& raw)
  {
    for (std::size_t i = 0; i < raw.count; ++i)
    {
      const std::size_t offset = i * texture_.size();
      addParticle(raw.values + offset, raw.outsideShares + offset);
    }
  }

  /// @param noise see storeTextures
  void finish(BakeResult& result, double noise, const ProcessGroup& group)
  {
    result.mean = std::move(mean_);
    result.table = textures_.finish(noise, group, result.rowOf);
    if (settings_.storage == Storage::OneValue && areaOutside_ > 0)
    {
      result.table.comparedArea = areaOutside_;
      result.table.difference = std::sqrt(squaresFromMeans_ / areaOutside_);
    }
    result.counters.texturesStored = static_cast<std::uint64_t>(result.table.textures);
    result.counters.particlesDark =
      static_cast<std::uint64_t>(std::count(result.mean.begin(), result.mean.end(), 0.0f));
  }

private:
  void addParticle(const float* values, const float* shares)
  {
    const bool oneValue = settings_.storage == Storage::OneValue;
    if (std::all_of(values, values + texture_.size(), [](float value) { return value == 0; }))
    {
      mean_.push_back(0);
      textures_.addDark();
      if (oneValue)
      {
        std::fill(texture_.begin(), texture_.end(), 0.0f);
        addSquaresFrom(0, shares);
      }
      return;
    }
    mean_.push_back(meanOutside(values, shares));
    fillTexture(values, shares);
    if (oneValue)
    {
      addSquaresFrom(mean_.back(), shares);
    }
    textures_.add(oneValue ? &mean_.back() : texture_.data(), shares);
  }

  /// Mean over the area outside other spheres; 0 if there is none.
  [[nodiscard]] float meanOutside(const float* values, const float* shares) const
  {
    double light = 0;
    double area = 0;
    const auto columns = static_cast<std::size_t>(settings_.textureResolution);
    for (std::size_t texel = 0; texel < texture_.size(); ++texel)
    {
      const double outside = areas_[texel / columns] * static_cast<double>(shares[texel]);
      light += outside * static_cast<double>(values[texel]);
      area += outside;
    }
    return area > 0 ? static_cast<float>(light / area) : 0.0f;
  }

  /// Of the texture at hand, over the area outside other spheres.
  void addSquaresFrom(float mean, const float* shares)
  {
    for (std::size_t texel = 0; texel < texture_.size(); ++texel)
    {
      const float outside = shares_[texel] * shares[texel];
      const float difference = texture_[texel] - mean;
      squaresFromMeans_ += static_cast<double>(outside * difference * difference);
      areaOutside_ += static_cast<double>(outside);
    }
  }

  /// Texels that lie inside get their value by dilation, or 0.
  void fillTexture(const float* values, const float* shares)
  {
    std::copy(values, values + texture_.size(), texture_.begin());
    bool anyInside = false;
    for (std::size_t texel = 0; texel < texture_.size(); ++texel)
    {
      const bool inside = isInside(shares[texel]);
      known_[texel] = inside ? 0 : 1;
      anyInside = anyInside || inside;
      texture_[texel] = inside ? 0.0f : texture_[texel];
    }
    if (anyInside && settings_.dilateInside)
    {
      dilate(neighbours_, texture_.data(), known_);
    }
  }

  [[nodiscard]] bool isInside(float share) const
  {
    return share <= 0 || static_cast<double>(share) < settings_.insideThreshold;
  }

  const BakeSettings& settings_;
  TexelNeighbours neighbours_;
  TextureIntake textures_;
  std::vector<double> areas_;   ///< steradians of a texel, by row
  std::vector<float> shares_;   ///< of the sphere, by texel
  double squaresFromMeans_ = 0; ///< integrated over the area outside other spheres
  double areaOutside_ = 0;      ///< as a share of a sphere
  std::vector<float> mean_;
  std::vector<std::uint8_t> known_; ///< of the texture at hand
  std::vector<float> texture_;
};

template <typename Element>
void append(std::vector<Element>& first, const std::vector<Element>& second)
{
  first.reserve(first.size() + second.size());
  first.insert(first.end(), second.begin(), second.end());
}

/// Centres in full, if there are none those of the floats.
void fillCenters(const std::vector<Sphere>& spheres, std::vector<Vec3d>& centers)
{
  centers.reserve(spheres.size());
  for (std::size_t i = centers.size(); i < spheres.size(); ++i)
  {
    centers.push_back(spheres[i].center().as<double>());
  }
}

/// The particles, then the occluders. Takes the spheres out of the cloud.
SphereSet joined(SphereCloud& cloud, const Occluders& occluders)
{
  std::vector<Sphere> spheres = std::move(cloud.spheres);
  std::vector<Vec3d> centers = std::move(cloud.centers);
  if (!centers.empty() || !occluders.centers.empty())
  {
    std::vector<Vec3d> others = occluders.centers;
    fillCenters(occluders.spheres, others);
    fillCenters(spheres, centers);
    append(centers, others);
  }
  append(spheres, occluders.spheres);
  return SphereSet(std::move(spheres), std::move(centers));
}

/// @param kept null: there are no other textures, and none are kept
BakeResult bakeBetween(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, const OcclusionEstimator& estimator, Progress& progress,
  TextureMemory* kept)
{
  BakeResult result;
  const bool outOfCore = estimator.isOutOfCore();
  const ProcessGroup& group = scene.group; // outlives the scene, which may end with the sweep
  TextureCollector collector(settings, kept ? kept->size() : particles.size(), outOfCore);
  std::optional<BakedLight> light;
  if (settings.light)
  {
    light.emplace(scene, particles, settings, outOfCore, progress);
    if (progress.aborted())
    {
      result.aborted = true;
      return result; // other processes may be amid the light: nothing more is exchanged with them
    }
  }
  const auto collect = [&](const RawTextures& textures) { collector.add(textures); };
  const auto take = [&](const RawTextures& raw)
  {
    const RawTextures lit = light ? light->addTo(raw, progress) : raw;
    kept ? kept->add(lit, collect) : collect(lit);
  };
  estimator.estimate(scene, particles, settings, progress, take, result.counters);
  result.counters.rays += light ? light->rays() : 0;
  result.aborted = progress.aborted();
  if (!result.aborted)
  {
    double error = estimator.estimatedError();
    if (kept)
    {
      kept->finish(error, collect);
      error = kept->estimatedError();
    }
    collector.finish(result, SureShareOfError * error, group);
  }
  return result;
}

/// Hierarchies of Embree, the spheres, rows and means; measured below 300 bytes a sphere.
constexpr double BytesPerSphere = 300;
}

BakeScene::BakeScene(
  SphereCloud sphereCloud, const Occluders& occluders, const ProcessGroup& processes)
  : receivers_(sphereCloud.spheres.size())
  , set_(std::make_shared<const SphereSet>(joined(sphereCloud, occluders)))
  , hasMesh_(!occluders.mesh.triangles.empty())
  , cloud(std::move(sphereCloud))
  , overlaps(*set_)
  , group(processes)
{
  if (hasMesh_)
  {
    rays_ = std::make_unique<SphereScene>(set_, occluders.mesh);
  }
}

void BakeScene::prepareRays() const
{
  if (!rays_)
  {
    rays_ = std::make_unique<SphereScene>(set_);
  }
}

std::uint64_t BakeScene::randomKey(unsigned particle) const
{
  if (!cloud.ids.empty())
  {
    return mixBits(cloud.ids[particle] + 0x9E3779B97F4A7C15ull);
  }
  std::array<std::uint64_t, 2> words{};
  static_assert(sizeof(words) == sizeof(Sphere));
  std::memcpy(words.data(), &set_->spheres()[particle], sizeof(words));
  return mixBits(words[0] + 0x9E3779B97F4A7C15ull * mixBits(words[1]));
}

void BakeCounters::add(const BakeCounters& other)
{
  particles += other.particles;
  texels += other.texels;
  rays += other.rays;
  samplesInside += other.samplesInside;
  texelsInside += other.texelsInside;
  particlesBuried += other.particlesBuried;
  particlesAlone += other.particlesAlone;
  particlesDark += other.particlesDark;
  texturesStored += other.texturesStored;
  spheresClosed += other.spheresClosed;
  spheresNeverSeen += other.spheresNeverSeen;
  directionsBlack += other.directionsBlack;
}

BakeCounters BakeCounters::summed(const ProcessGroup& group) const
{
  BakeCounters all = *this;
  for (std::uint64_t* number : { &all.particles, &all.texels, &all.rays, &all.samplesInside,
         &all.texelsInside, &all.particlesBuried, &all.particlesAlone, &all.particlesDark,
         &all.texturesStored, &all.spheresClosed, &all.spheresNeverSeen })
  {
    *number = group.sum(*number);
  }
  all.directionsBlack =
    static_cast<std::uint64_t>(group.largest(static_cast<double>(directionsBlack)));
  all.threads = static_cast<unsigned>(group.sum(std::uint64_t(threads)));
  return all;
}

namespace
{
/// Of a table in the form it is stored in, and on its way there, in bytes a texel.
double tableBytesPerTexel(const BakeSettings& settings, bool outOfCore)
{
  if (settings.storage == Storage::OneValue)
  {
    return 0;
  }
  // The linear table stays until it is encoded, mostly at once but not always, out of core in a
  // file (see TextureIntake); the encoded one may be copied into the blocks of a data set.
  const double linear = outOfCore && TextureIntake::spills(settings) ? 0 : 4;
  const double encoded = settings.encoding == Encoding::UInt8Gamma2 ? 1 + 1 : 4;
  const double weights = TextureIntake::weighsTexels(settings) ? 1 : 0;
  return linear + encoded + weights;
}
}

double bakeMemory(
  std::size_t particles, const BakeSettings& settings, const OcclusionEstimator& estimator)
{
  const bool outOfCore = estimator.isOutOfCore();
  const double texels =
    static_cast<double>(settings.textureResolution) * settings.textureResolution;
  const double light = settings.light ? LightSweep::bytesPerTexel(outOfCore) : 0;
  return static_cast<double>(particles) *
    (BytesPerSphere +
      texels * (tableBytesPerTexel(settings, outOfCore) + light + estimator.bytesPerTexel()));
}

double occluderMemory(std::size_t spheres, std::size_t triangles)
{
  // The hierarchy while it is built, and the mesh itself: measured below 220 bytes a triangle.
  constexpr double bytesPerTriangle = 250;
  return static_cast<double>(spheres) * BytesPerSphere +
    static_cast<double>(triangles) * bytesPerTriangle;
}

BakeResult bakeOcclusion(const BakeScene& scene, const BakeSettings& settings,
  const OcclusionEstimator& estimator, Progress& progress)
{
  std::vector<unsigned> all(scene.receivers());
  std::iota(all.begin(), all.end(), 0u);
  return bakeOcclusion(scene, all, settings, estimator, progress);
}

BakeResult bakeOcclusion(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, const OcclusionEstimator& estimator, Progress& progress)
{
  return bakeBetween(scene, particles, settings, estimator, progress, nullptr);
}

BakeResult bakeOcclusion(const BakeScene& scene, const std::vector<unsigned>& particles,
  const BakeSettings& settings, const OcclusionEstimator& estimator, Progress& progress,
  TextureMemory& kept)
{
  return bakeBetween(scene, particles, settings, estimator, progress, &kept);
}
}
