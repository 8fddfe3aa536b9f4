// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SweepScene_h
#define po_SweepScene_h

#include "Sphere.h"

#include <cstddef>
#include <vector>

namespace po
{
/// The spheres of a scene in the order in which a sweep works: sorted into octaves of their radii,
/// so that a few large ones do not make the tiles and cells of the many small ones large, and
/// within an octave along a Morton curve, so that spheres that are near in space are near in
/// memory.
class SweepScene
{
public:
  /// Spheres [first, last), none more than twice as large as another. Octaves are numbered upward;
  /// each holds at least one sphere.
  struct Octave
  {
    unsigned first, last;
    float smallestRadius, largestRadius;
  };

  explicit SweepScene(const std::vector<Sphere>& spheres);

  [[nodiscard]] std::size_t size() const { return spheres_.size(); }
  [[nodiscard]] const Sphere& sphere(unsigned index) const { return spheres_[index]; }
  [[nodiscard]] const std::vector<Octave>& octaves() const { return octaves_; }

  /// The place of a sphere in the vector that this was made from, and back.
  [[nodiscard]] unsigned source(unsigned index) const { return source_[index]; }
  [[nodiscard]] unsigned indexOf(unsigned source) const { return indexOf_[source]; }

private:
  std::vector<Sphere> spheres_;
  std::vector<Octave> octaves_;
  std::vector<unsigned> source_;
  std::vector<unsigned> indexOf_;
};
}

#endif
