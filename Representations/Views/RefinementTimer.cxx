// SPDX-License-Identifier: BSD-3-Clause
#include "RefinementTimer.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPVRenderView.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"

#include <utility>

namespace po
{
namespace
{
constexpr unsigned long Milliseconds = 10;
}

RefinementTimer::RefinementTimer(vtkPVRenderView* view, std::function<bool()> isReady)
  : view_(view)
  , isReady_(std::move(isReady))
{
}

RefinementTimer::~RefinementTimer()
{
  this->stop();
}

void RefinementTimer::stop()
{
  if (interactor_ && observer_ != 0)
  {
    interactor_->RemoveObserver(observer_);
  }
  if (interactor_ && timer_ != 0)
  {
    interactor_->DestroyTimer(timer_);
  }
  observer_ = 0;
  timer_ = 0;
}

void RefinementTimer::start()
{
  vtkRenderWindowInteractor* interactor = view_ ? view_->GetInteractor() : nullptr;
  if (!interactor || (interactor == interactor_ && timer_ != 0))
  {
    return;
  }
  if (interactor != interactor_)
  {
    this->stop();
    interactor_ = interactor;
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(this);
    command->SetCallback(&RefinementTimer::onTimer);
    observer_ = interactor->AddObserver(vtkCommand::TimerEvent, command);
  }
  timer_ = interactor->CreateOneShotTimer(Milliseconds);
}

void RefinementTimer::onTimer(vtkObject*, unsigned long, void* self, void* timer)
{
  auto* me = static_cast<RefinementTimer*>(self);
  if (!timer || me->timer_ == 0 || *static_cast<int*>(timer) != me->timer_)
  {
    return;
  }
  me->interactor_->DestroyTimer(me->timer_);
  me->timer_ = 0;
  me->tick();
}

void RefinementTimer::tick()
{
  const bool dragging = !view_ || view_->GetRenderWindow()->GetDesiredUpdateRate() >= 1;
  if (dragging)
  {
    return;
  }
  if (isReady_())
  {
    view_->StillRender();
  }
  else
  {
    this->start();
  }
}
}
