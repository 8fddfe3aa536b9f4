// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereBoxes_h
#define po_SphereBoxes_h

#include "SphereSet.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace po
{
/// The spheres of a brick, in boxes of some that are near each other.
class SphereBoxes
{
public:
  /// In a box. A hierarchy over single spheres would take more memory than these themselves, and
  /// half a second to build for a million; with 4 or 8 in a box queries take longer.
  static constexpr std::size_t Size = 16;

  /// @param brick must outlive this
  explicit SphereBoxes(const Brick& brick);

  [[nodiscard]] unsigned count() const
  {
    return static_cast<unsigned>((brick_->count + Size - 1) / Size);
  }

  /// Of a box.
  [[nodiscard]] std::size_t spheresIn(unsigned box) const
  {
    return std::min(Size, brick_->count - Size * box);
  }
  /// One of these, relative to the origin of the brick.
  [[nodiscard]] const Sphere& sphere(unsigned box, std::size_t i) const
  {
    return brick_->spheres[place(box, i)];
  }
  /// Its number in the set.
  [[nodiscard]] unsigned id(unsigned box, std::size_t i) const { return brick_->id(place(box, i)); }

  /// The spheres of a box that come within a distance of a point, as bits; rounding may add some
  /// that just do not, but loses none.
  [[nodiscard]] unsigned near(unsigned box, Vec3f point, float distance) const;

private:
  [[nodiscard]] unsigned place(unsigned box, std::size_t i) const
  {
    const std::size_t at = Size * box + i;
    return places_.empty() ? static_cast<unsigned>(at) : places_[at];
  }

  const Brick* brick_;
  std::vector<unsigned> places_; ///< box after box; empty: one after the other
};
}

#endif
