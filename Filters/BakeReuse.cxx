// SPDX-License-Identifier: BSD-3-Clause
#include "BakeReuse.h"

#include "BakeKey.h"
#include "SceneChanges.h"

#include <algorithm>
#include <utility>

namespace po
{
namespace
{
/// Particles, then occluders: numbered as in a BakeScene.
std::vector<Sphere> spheresOf(const BakeTask& task)
{
  std::vector<Sphere> all = task.cloud.spheres;
  all.insert(all.end(), task.occluders.spheres.begin(), task.occluders.spheres.end());
  return all;
}

float reachOf(const BakeTask& task)
{
  return task.cloud.toLocalReach(task.settings.maximumDistance);
}

std::vector<Sphere> selected(
  const std::vector<Sphere>& spheres, const std::vector<unsigned>& numbers)
{
  std::vector<Sphere> some;
  some.reserve(numbers.size());
  for (const unsigned number : numbers)
  {
    some.push_back(spheres[number]);
  }
  return some;
}

/// The receivers whose texture is not there.
std::vector<unsigned> changedReceivers(
  const BakeTask& task, const std::vector<std::int32_t>& earlier)
{
  std::vector<unsigned> changed;
  for (std::size_t i = 0; i < earlier.size(); ++i)
  {
    if (earlier[i] < 0)
    {
      changed.push_back(task.receivers[i]);
    }
  }
  return changed;
}

/// The receivers, ascending, with the spheres that they can see, in the order of the task.
BakeTask taskOf(const std::vector<unsigned>& receivers, const BakeTask& task)
{
  const std::vector<Sphere> all = spheresOf(task);
  const std::vector<std::uint8_t> matters =
    markWithin(all, selected(all, receivers), reachOf(task));
  BakeTask part;
  part.settings = task.settings;
  part.targetError = task.targetError;
  part.cloud.origin = task.cloud.origin;
  part.cloud.scale = task.cloud.scale;
  part.occluders.mesh = task.occluders.mesh;
  auto receiver = receivers.begin();
  for (unsigned i = 0; i < all.size(); ++i)
  {
    if (matters[i] == 0)
    {
      continue;
    }
    if (i >= task.cloud.spheres.size())
    {
      part.occluders.spheres.push_back(all[i]);
      continue;
    }
    if (receiver != receivers.end() && *receiver == i)
    {
      part.receivers.push_back(static_cast<unsigned>(part.cloud.spheres.size()));
      ++receiver;
    }
    part.cloud.spheres.push_back(all[i]);
    if (!task.cloud.ids.empty())
    {
      part.cloud.ids.push_back(task.cloud.ids[i]);
    }
  }
  return part;
}
}

bool BakeReuse::suits(int method, const BakeTask& task)
{
  // What is wider than floats is cut up as a whole.
  return task.reuseUnchanged && mayReuse(method, task.settings.maximumDistance, task.targetError) &&
    task.cloud.centers.empty() && task.occluders.centers.empty();
}

double BakeReuse::bytesMissing(const BakeTask& task) const
{
  const double side = task.settings.textureResolution;
  const double most =
    TextureMemory::BytesPerTexel * side * side * static_cast<double>(task.receivers.size());
  return std::max(0.0, most - textures_.bytes());
}

std::optional<BakeTask> BakeReuse::begin(int method, const BakeTask& task)
{
  std::string key = textureKey(method, task);
  if (!isValid_ || key != key_)
  {
    textures_ = TextureMemory(task.settings.textureResolution);
    directions_ = 0;
  }
  const bool isKnown = std::exchange(isValid_, false) && key == key_;
  key_ = std::move(key);
  const std::vector<std::int32_t> earlier =
    isKnown ? findUnchanged(task) : std::vector<std::int32_t>(task.receivers.size(), -1);
  spheres_ = spheresOf(task);
  ids_ = task.cloud.ids;
  receivers_ = task.receivers;
  mesh_ = task.occluders.mesh;
  textures_.begin(earlier);
  if (textures_.reused() == 0)
  {
    return {};
  }
  return taskOf(changedReceivers(task, earlier), task);
}

int BakeReuse::mostDirections(int ofBaked)
{
  directions_ = std::max(directions_, ofBaked);
  return directions_;
}

/// For each receiver the number of its texture in the last bake, or -1.
std::vector<std::int32_t> BakeReuse::findUnchanged(const BakeTask& task) const
{
  std::vector<std::int32_t> unchanged(task.receivers.size(), -1);
  const SceneChanges changes = findChanges(spheres_, mesh_, spheresOf(task), task.occluders.mesh);
  if (!changes.inOrder || ids_.empty() != task.cloud.ids.empty())
  {
    return unchanged; // of spheres that are equally near the order decides which count as nearest
  }
  const std::vector<std::uint8_t> isNearChange =
    markWithin(selected(task.cloud.spheres, task.receivers), changes.balls, reachOf(task));
  for (std::size_t i = 0; i < unchanged.size(); ++i)
  {
    const unsigned now = task.receivers[i];
    const std::int32_t earlier = changes.earlier[now];
    if (earlier < 0 || isNearChange[i] != 0)
    {
      continue;
    }
    const auto before = static_cast<unsigned>(earlier);
    const auto found = std::lower_bound(receivers_.begin(), receivers_.end(), before);
    const bool isSame = found != receivers_.end() && *found == before &&
      (ids_.empty() || ids_[before] == task.cloud.ids[now]);
    unchanged[i] = isSame ? static_cast<std::int32_t>(found - receivers_.begin()) : -1;
  }
  return unchanged;
}
}
