// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Refinement_h
#define po_Refinement_h

#include "RefinementTimer.h"

#include "vtkNew.h"
#include "vtkWeakPointer.h"

#include <memory>

class vtkCallbackCommand;
class vtkPVRenderView;
class vtkRayTracedSphereMapper;

namespace po
{
/// Refines still pictures of a mapper step by step, while nothing changes in the view: by rays for
/// smooth edges, and by textures as they are read.
class Refinement
{
public:
  explicit Refinement(vtkRayTracedSphereMapper* mapper);
  ~Refinement();
  Refinement(const Refinement&) = delete;
  Refinement& operator=(const Refinement&) = delete;

  /// From now on the view is rendered again whenever the mapper has more to add.
  void begin(vtkPVRenderView* view);
  void end();

  /// Before each frame: in steps or all at once, as the view allows.
  /// @param view may be null
  void prepare(vtkPVRenderView* view);

private:
  vtkWeakPointer<vtkRayTracedSphereMapper> mapper_;
  vtkNew<vtkCallbackCommand> command_; ///< called when the mapper has more to add
  std::unique_ptr<RefinementTimer> timer_;
};
}

#endif
