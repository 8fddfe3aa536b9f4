// SPDX-License-Identifier: BSD-3-Clause
#include "SelectionSight.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPVHardwareSelector.h"
#include "vtkPVRenderView.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"

namespace po
{
namespace
{
/// A view keeps its selector to itself and to those that are derived from it.
class OpenView : public vtkPVRenderView
{
public:
  static constexpr vtkPVHardwareSelector* vtkPVRenderView::*SelectorOfView = &OpenView::Selector;
};

vtkHardwareSelector* selectorOf(vtkPVRenderView& view)
{
  return view.*OpenView::SelectorOfView;
}
}

SelectionSight::~SelectionSight()
{
  this->end();
}

void SelectionSight::begin(vtkPVRenderView* view)
{
  this->end();
  selector_ = selectorOf(*view);
  renderer_ = view->GetRenderer();
  if (selector_)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(this);
    command->SetCallback(&SelectionSight::onSelection);
    observers_ = { selector_->AddObserver(vtkCommand::StartEvent, command),
      selector_->AddObserver(vtkCommand::EndEvent, command) };
  }
}

void SelectionSight::end()
{
  this->show();
  for (unsigned long& observer : observers_)
  {
    if (selector_ && observer != 0)
    {
      selector_->RemoveObserver(observer);
    }
    observer = 0;
  }
}

void SelectionSight::onSelection(vtkObject*, unsigned long event, void* self, void*)
{
  auto* me = static_cast<SelectionSight*>(self);
  event == vtkCommand::StartEvent ? me->hide() : me->show();
}

void SelectionSight::hide()
{
  vtkPropCollection* props = renderer_ ? renderer_->GetViewProps() : nullptr;
  for (int i = 0; props && i < props->GetNumberOfItems(); ++i)
  {
    auto* actor = vtkActor::SafeDownCast(props->GetItemAsObject(i));
    if (actor && actor->GetVisibility() && !actor->GetPickable())
    {
      actor->VisibilityOff();
      hidden_.emplace_back(actor);
    }
  }
}

void SelectionSight::show()
{
  for (const vtkSmartPointer<vtkActor>& actor : hidden_)
  {
    actor->VisibilityOn();
  }
  hidden_.clear();
}
}
