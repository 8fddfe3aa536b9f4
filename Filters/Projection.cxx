// SPDX-License-Identifier: BSD-3-Clause
#include "Projection.h"

#include "vtkMatrix4x4.h"

#include <cmath>

namespace po
{
std::optional<WindowToEye> windowToEyeOf(vtkMatrix4x4* projection)
{
  const double determinant = projection ? projection->Determinant() : 0.0;
  if (!std::isfinite(determinant) || determinant == 0.0)
  {
    return std::nullopt;
  }
  Matrix4 inverse;
  vtkMatrix4x4::Invert(projection->GetData(), inverse.data());
  return makeWindowToEye(inverse);
}
}
