// SPDX-License-Identifier: BSD-3-Clause
#include "BakeKey.h"

#include "Digest.h"

#include <cstdint>
#include <type_traits>
#include <variant>

namespace po
{
namespace
{
/// To be raised whenever a bake of the same task gives other bits, or entries another layout.
constexpr std::uint32_t ResultVersion = 9;

template <typename Number>
void addNumber(Digest& digest, Number number)
{
  static_assert(std::is_arithmetic_v<Number> || std::is_enum_v<Number>);
  digest.add(&number, sizeof(number));
}

void add(Digest& digest, Vec3d v)
{
  addNumber(digest, v.x);
  addNumber(digest, v.y);
  addNumber(digest, v.z);
}

void add(Digest&, const UniformBackground&) {}

void add(Digest& digest, const GradientBackground& gradient)
{
  const auto& [up, bottom, top] = gradient;
  add(digest, up);
  addNumber(digest, bottom);
  addNumber(digest, top);
}

void add(Digest& digest, const ImageBackground& image)
{
  const auto& [width, height, luminance] = image;
  addNumber(digest, width);
  addNumber(digest, height);
  digest.add(luminance);
}

// Members are taken apart by structured bindings, here and below: one that is added to a struct
// later does not compile until it is thought of.
void add(Digest& digest, const BakeSettings& settings)
{
  const auto& [textureResolution, samplesPerTexel, maximumDistance, dilateInside, insideThreshold,
    encoding, storage, storageError, seed, background, distantLight] = settings;
  addNumber(digest, textureResolution);
  addNumber(digest, samplesPerTexel);
  addNumber(digest, maximumDistance);
  addNumber(digest, dilateInside);
  addNumber(digest, insideThreshold);
  addNumber(digest, encoding);
  addNumber(digest, storage);
  addNumber(digest, storageError);
  addNumber(digest, seed);
  addNumber(digest, background.index());
  std::visit([&](const auto& sky) { add(digest, sky); }, background);
  if (distantLight) // without one the keys are those that there were before there were lights
  {
    const auto& [direction, intensity] = *distantLight;
    add(digest, direction);
    addNumber(digest, intensity);
  }
}

void add(Digest& digest, const SphereCloud& cloud)
{
  const auto& [origin, scale, spheres, centers, sourceIds, ghosts, ids, rejected] = cloud;
  add(digest, origin);
  addNumber(digest, scale);
  digest.add(spheres);
  digest.add(centers);
  digest.add(ids);
  // The others say what the data set was like; a task has none of them.
}

void add(Digest& digest, const Occluders& occluders)
{
  const auto& [spheres, mesh, centers] = occluders;
  digest.add(spheres);
  digest.add(centers);
  const auto& [vertices, triangles] = mesh;
  digest.add(vertices);
  digest.add(triangles);
}

void add(Digest& digest, const BakeTask& task)
{
  const auto& [cloud, receivers, occluders, settings, targetError, outOfCore, reuse] = task;
  static_cast<void>(outOfCore); // the bits are the same
  static_cast<void>(reuse);     // so they are of the task that it makes
  add(digest, cloud);
  digest.add(receivers);
  add(digest, occluders);
  add(digest, settings);
  addNumber(digest, targetError);
}

/// Of the tasks of all processes: what is decided for the whole set depends on all.
std::string keyOfAll(const std::string& own, const ProcessGroup& group)
{
  const ProcessGroup::Words words(own.begin(), own.end()); // a character each
  Digest all;
  all.add(own.data(), own.size());
  all.add(group.gather(words));
  return all.text();
}
}

std::string bakeKey(int method, const BakeTask& task, const ProcessGroup& group)
{
  Digest digest;
  addNumber(digest, ResultVersion); // its bytes also tell the order of bytes
  addNumber(digest, group.size());
  addNumber(digest, group.rank());
  addNumber(digest, method);
  add(digest, task);
  return keyOfAll(digest.text(), group);
}

std::string textureKey(int method, const BakeTask& task)
{
  BakeSettings settings = task.settings;
  const BakeSettings defaults;
  settings.dilateInside = defaults.dilateInside;
  settings.insideThreshold = defaults.insideThreshold;
  settings.encoding = defaults.encoding;
  settings.storage = defaults.storage;
  settings.storageError = defaults.storageError;
  Digest digest;
  addNumber(digest, method);
  add(digest, task.cloud.origin);
  addNumber(digest, task.cloud.scale);
  add(digest, settings);
  addNumber(digest, task.targetError);
  return digest.text();
}
}
