// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BackgroundIrradiance_h
#define po_BackgroundIrradiance_h

#include "Background.h"

namespace po
{
/// What an open surface with a given normal receives of a background:
/// (1/pi) integral of L(w) max(0, n.w) dw, exactly 1 under the uniform background.
class BackgroundIrradiance
{
public:
  explicit BackgroundIrradiance(const Background& background);

  /// @param normal a unit vector
  [[nodiscard]] double operator()(Vec3d normal) const;

private:
  /// A uniform or gradient background is integrated in closed form, an image into a map by normal.
  Background source_;
};
}

#endif
