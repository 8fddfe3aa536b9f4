// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SceneCache_h
#define po_SceneCache_h

#include "SphereScene.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace po
{
/// Scenes that are in use, so that equal spheres, shown in several views, need one scene only. A
/// scene goes with its last user; the cache keeps none alive.
class SceneCache
{
public:
  /// The scene of exactly these spheres, built if there is none. Throws like SphereScene.
  /// @param centers in full, or none (see SphereSet)
  [[nodiscard]] std::shared_ptr<const SphereScene> get(
    const std::vector<Sphere>& spheres, const std::vector<Vec3d>& centers = {});

  /// Scenes in use.
  [[nodiscard]] std::size_t size();

private:
  void forgetUnused();

  std::mutex mutex_;
  std::unordered_multimap<std::uint64_t, std::weak_ptr<const SphereScene>> scenes_; ///< by content
};
}

#endif
