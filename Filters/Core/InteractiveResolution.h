// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_InteractiveResolution_h
#define po_InteractiveResolution_h

#include <cstddef>

namespace po
{
/// Chooses how coarse a frame must be to be ready in time, from what earlier frames took.
class InteractiveResolution
{
public:
  /// Not coarser than one ray for so many pixels in each direction.
  static constexpr int LargestReduction = 8;

  /// One frame took so long.
  void measured(std::size_t rays, double seconds);

  /// The smallest n for which width / n x height / n rays are expected to take no longer than
  /// 1 / rate seconds; 1 while nothing is known, and for a rate of 0.
  /// @param rate frames a second, at least 0
  [[nodiscard]] int reduction(int width, int height, double rate) const;

private:
  double secondsPerRay_ = 0; ///< decaying mean
};
}

#endif
