// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RefinementTimer_h
#define po_RefinementTimer_h

#include "vtkWeakPointer.h"

#include <functional>

class vtkObject;
class vtkPVRenderView;
class vtkRenderWindowInteractor;

namespace po
{
/// Renders a view again as soon as its event loop is idle; without an event loop, in a script for
/// instance, nothing happens.
class RefinementTimer
{
public:
  /// @param isReady is a picture worth while? Otherwise it is asked again a little later.
  RefinementTimer(vtkPVRenderView* view, std::function<bool()> isReady);
  ~RefinementTimer();
  RefinementTimer(const RefinementTimer&) = delete;
  RefinementTimer& operator=(const RefinementTimer&) = delete;

  /// Asks for one still picture more. While the user drags none is rendered: the picture after that
  /// asks anew.
  void start();

private:
  void stop();
  void tick();
  static void onTimer(vtkObject* caller, unsigned long event, void* self, void* timer);

  vtkWeakPointer<vtkPVRenderView> view_;
  std::function<bool()> isReady_;
  vtkWeakPointer<vtkRenderWindowInteractor> interactor_;
  unsigned long observer_ = 0;
  int timer_ = 0; ///< 0: none is running
};
}

#endif
