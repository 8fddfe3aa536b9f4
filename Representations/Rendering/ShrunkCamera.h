// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ShrunkCamera_h
#define po_ShrunkCamera_h

#include "vtkSmartPointer.h"

class vtkCamera;
class vtkHomogeneousTransform;

namespace po
{
/// The camera's picture shrinks to the middle of a larger frame while this object lives, so that
/// its pixels stay what they are and what lies beyond them is seen too.
class ShrunkCamera
{
public:
  /// @param share of the picture in the width and the height of the frame
  ShrunkCamera(vtkCamera* camera, double shareOfWidth, double shareOfHeight);
  ~ShrunkCamera();
  ShrunkCamera(const ShrunkCamera&) = delete;
  void operator=(const ShrunkCamera&) = delete;

private:
  vtkCamera* camera_;
  vtkSmartPointer<vtkHomogeneousTransform> own_;
};
}

#endif
