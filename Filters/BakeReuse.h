// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakeReuse_h
#define po_BakeReuse_h

#include "BakeMethods.h"
#include "TextureMemory.h"

#include <optional>
#include <string>
#include <vector>

namespace po
{
/// The textures of the last bake, of which the next one takes over those of particles around which
/// nothing has changed.
///
/// With a bounded distance, and by a method whose textures are the same bits whatever else is
/// baked, a texture depends on the spheres and triangles within that distance alone. So what is
/// taken over has the bits that a bake would give.
class BakeReuse
{
public:
  /// Is the task one that textures can be kept of?
  [[nodiscard]] static bool suits(int method, const BakeTask& task);

  /// Upper bound of what it will take more memory than it has by now.
  [[nodiscard]] double bytesMissing(const BakeTask& task) const;

  /// What of the task is to be baked, and the spheres that matter to it; nothing: all of it.
  /// Nothing is kept until commit().
  [[nodiscard]] std::optional<BakeTask> begin(int method, const BakeTask& task);

  [[nodiscard]] TextureMemory& textures() { return textures_; }

  /// The most that a texture took, of those kept too.
  [[nodiscard]] int mostDirections(int ofBaked);

  /// The bake is done.
  void commit() { isValid_ = true; }

private:
  [[nodiscard]] std::vector<std::int32_t> findUnchanged(const BakeTask& task) const;

  bool isValid_ = false;
  std::string key_;
  // Of the last bake that has begun:
  std::vector<Sphere> spheres_; ///< particles, then occluders
  std::vector<std::uint64_t> ids_;
  std::vector<unsigned> receivers_;
  OccluderMesh mesh_;
  int directions_ = 0;
  TextureMemory textures_;
};
}

#endif
