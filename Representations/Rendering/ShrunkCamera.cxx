// SPDX-License-Identifier: BSD-3-Clause
#include "ShrunkCamera.h"

#include "vtkCamera.h"
#include "vtkHomogeneousTransform.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkTransform.h"

namespace po
{
ShrunkCamera::ShrunkCamera(vtkCamera* camera, double shareOfWidth, double shareOfHeight)
  : camera_(camera)
  , own_(camera->GetUserTransform())
{
  vtkNew<vtkTransform> shrink;
  shrink->Scale(shareOfWidth, shareOfHeight, 1.0);
  if (own_)
  {
    shrink->Concatenate(own_->GetMatrix());
  }
  camera_->SetUserTransform(shrink);
}

ShrunkCamera::~ShrunkCamera()
{
  camera_->SetUserTransform(own_);
}
}
