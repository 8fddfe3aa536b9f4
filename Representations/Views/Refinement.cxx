// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkPVRenderView.h"
#include "vtkRayTracedSphereMapper.h"
#include "vtkRenderWindowInteractor.h"

namespace po
{
namespace
{
/// The flag is for views alone, but no event tells of it.
struct ScreenshotAccess : vtkPVRenderView
{
  static bool isCapturing(vtkPVRenderView& view)
  {
    bool (vtkPVView::*flag)() = &ScreenshotAccess::GetInCaptureScreenshot;
    return (view.*flag)();
  }
};
}

Refinement::Refinement(vtkRayTracedSphereMapper* mapper)
  : mapper_(mapper)
{
  command_->SetClientData(this);
  command_->SetCallback(
    [](vtkObject*, unsigned long, void* self, void*)
    {
      auto* me = static_cast<Refinement*>(self);
      if (me->timer_)
      {
        me->timer_->start();
      }
    });
  mapper->AddObserver(vtkCommand::UpdateEvent, command_);
}

Refinement::~Refinement()
{
  if (mapper_)
  {
    mapper_->RemoveObserver(command_);
  }
}

void Refinement::begin(vtkPVRenderView* view)
{
  timer_ = std::make_unique<RefinementTimer>(
    view, [mapper = mapper_] { return mapper && mapper->HasMoreToShow(); });
}

void Refinement::end()
{
  timer_.reset();
}

void Refinement::prepare(vtkPVRenderView* view)
{
  // Only what this process alone draws on a screen can be refined step by step.
  mapper_->SetProgressive(view && !ScreenshotAccess::isCapturing(*view) && view->GetInteractor() &&
    !view->GetUseDistributedRenderingForRender());
}
}
