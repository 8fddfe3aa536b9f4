// SPDX-License-Identifier: BSD-3-Clause
#include "InteractiveResolution.h"

#include <algorithm>
#include <cmath>

namespace po
{
void InteractiveResolution::measured(std::size_t rays, double seconds)
{
  if (rays == 0)
  {
    return;
  }
  // One slow frame, while the machine did something else, must not make the next ones coarse.
  constexpr double NewShare = 0.5;
  const double now = seconds / static_cast<double>(rays);
  secondsPerRay_ = secondsPerRay_ == 0 ? now : (1 - NewShare) * secondsPerRay_ + NewShare * now;
}

int InteractiveResolution::reduction(int width, int height, double rate) const
{
  const double factor = std::sqrt(rate * secondsPerRay_ * width * height);
  return std::clamp(static_cast<int>(std::ceil(factor)), 1, LargestReduction);
}
}
