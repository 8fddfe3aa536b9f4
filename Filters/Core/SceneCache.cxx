// SPDX-License-Identifier: BSD-3-Clause
#include "SceneCache.h"

#include "Random.h"

#include <algorithm>
#include <cstring>

namespace po
{
namespace
{
std::uint64_t hashOf(const std::vector<Sphere>& spheres)
{
  std::uint64_t hash = spheres.size();
  for (const Sphere& sphere : spheres)
  {
    std::uint64_t words[2];
    static_assert(sizeof(words) == sizeof(Sphere));
    std::memcpy(words, &sphere, sizeof(words));
    hash = (hash ^ words[0]) * 0x9E3779B97F4A7C15ull;
    hash = ((hash >> 29) ^ words[1]) * 0xBF58476D1CE4E5B9ull + hash;
  }
  return mixBits(hash);
}

template <typename Element>
bool equal(const std::vector<Element>& a, const std::vector<Element>& b)
{
  return a.size() == b.size() &&
    (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Element)) == 0);
}
}

std::shared_ptr<const SphereScene> SceneCache::get(
  const std::vector<Sphere>& spheres, const std::vector<Vec3d>& centers)
{
  const std::uint64_t hash = hashOf(spheres);
  const std::lock_guard<std::mutex> lock(mutex_);
  forgetUnused();
  const auto [first, last] = scenes_.equal_range(hash);
  for (auto known = first; known != last; ++known)
  {
    auto scene = known->second.lock();
    if (scene && equal(scene->spheres(), spheres) && equal(scene->set().centers(), centers))
    {
      return scene;
    }
  }
  auto scene = std::make_shared<const SphereScene>(SphereSet(spheres, centers));
  scenes_.emplace(hash, scene);
  return scene;
}

std::size_t SceneCache::size()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  forgetUnused();
  return scenes_.size();
}

void SceneCache::forgetUnused()
{
  for (auto scene = scenes_.begin(); scene != scenes_.end();)
  {
    scene = scene->second.expired() ? scenes_.erase(scene) : std::next(scene);
  }
}
}
