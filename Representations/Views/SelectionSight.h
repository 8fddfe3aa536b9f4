// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SelectionSight_h
#define po_SelectionSight_h

#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <array>
#include <vector>

class vtkActor;
class vtkHardwareSelector;
class vtkObject;
class vtkPVRenderView;
class vtkRenderer;

namespace po
{
/// Lets a view's hardware selector see through actors that cannot be picked, such as the marks of
/// what is selected. It leaves them out, but not their depth, which it takes from a picture of all
/// that is visible: so what they cover would be taken for background, that is for a neighbour that
/// is not covered. Marks of particles that are cropped may cover anything.
class SelectionSight
{
public:
  SelectionSight() = default;
  ~SelectionSight();
  SelectionSight(const SelectionSight&) = delete;
  SelectionSight& operator=(const SelectionSight&) = delete;

  /// From now on in this view, and in no other.
  void begin(vtkPVRenderView* view);
  void end();

private:
  static void onSelection(vtkObject* caller, unsigned long event, void* self, void* data);
  void hide();
  void show();

  vtkWeakPointer<vtkHardwareSelector> selector_;
  vtkWeakPointer<vtkRenderer> renderer_;
  std::array<unsigned long, 2> observers_{};
  std::vector<vtkSmartPointer<vtkActor>> hidden_; ///< while the selector is at work
};
}

#endif
