// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_DrawnProps_h
#define po_DrawnProps_h

#include "TracedLayers.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkActor;
class vtkProp;
class vtkRenderState;

/// What a render state draws.
namespace po
{
[[nodiscard]] std::vector<vtkProp*> propsOf(const vtkRenderState* state);

/// Those that write depth.
[[nodiscard]] std::vector<vtkProp*> deepPropsOf(const vtkRenderState* state);

[[nodiscard]] std::vector<vtkActor*> visibleActorsOf(const std::vector<vtkProp*>& props);

/// Are ray-traced spheres all that writes depth?
[[nodiscard]] bool hasOnlySpheres(const std::vector<vtkProp*>& props);

/// The traced frames of this size that make up all depth of the frame buffer; empty if anything
/// else does.
[[nodiscard]] std::vector<TracedActor> tracedActorsOf(
  const vtkRenderState* state, int width, int height);

/// Forces translucent actors to be drawn as opaque ones while this object lives.
class OpaqueActors
{
public:
  explicit OpaqueActors(const std::vector<vtkSmartPointer<vtkActor>>& actors);
  ~OpaqueActors();
  OpaqueActors(const OpaqueActors&) = delete;
  void operator=(const OpaqueActors&) = delete;

private:
  std::vector<vtkSmartPointer<vtkActor>> forced_;
};
}

#endif
