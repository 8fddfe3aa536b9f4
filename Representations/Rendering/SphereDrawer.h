// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereDrawer_h
#define po_SphereDrawer_h

#include "FrameDrawer.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkActor;
class vtkHardwareSelector;
class vtkPolyDataMapper;

namespace po
{
class SphereRenderer;

/// Puts traced spheres into the current frame buffer: as a picture, or as the ids that a hardware
/// selector reads.
class SphereDrawer
{
public:
  /// Draws all layers of the shaded frame, back to front.
  /// @param version another number for other pictures
  /// @param mapper, actor what is drawn
  /// @return why that failed, empty on success
  [[nodiscard]] std::string draw(vtkOpenGLRenderWindow* window, const SphereRenderer& renderer,
    std::uint64_t version, vtkPolyDataMapper* mapper, vtkActor* actor);

  /// Draws the traced frame in the colours of the selector's current pass.
  /// @return why that failed, empty on success
  [[nodiscard]] std::string drawForSelection(vtkOpenGLRenderWindow* window,
    const SphereRenderer& renderer, vtkHardwareSelector& selector, vtkPolyDataMapper* mapper,
    vtkActor* actor);

  void releaseGraphicsResources(vtkWindow* window);

private:
  FrameDrawer picture_, selection_;
  std::uint64_t selectionVersion_ = 0;
  std::vector<std::uint8_t> selectionColors_;
};
}

#endif
