// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_FrameDrawer_h
#define po_FrameDrawer_h

#include "vtkNew.h"
#include "vtkTextureObject.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkWindow;

namespace po
{
/// The part of the frame buffer that is drawn to, in pixels.
struct PixelRectangle
{
  int x = 0, y = 0, width = 0, height = 0;
};

/// Puts computed pixels with depth into the current frame buffer, tested against what is there.
class FrameDrawer
{
public:
  FrameDrawer();
  ~FrameDrawer();

  /// The current OpenGL viewport: that of the renderer, of a tile, or of a pass's own buffer.
  [[nodiscard]] static PixelRectangle currentViewport(vtkOpenGLRenderWindow* window);

  /// Draws width * height pixels, rows from the bottom. OpenGL's state is left as it was.
  ///
  /// @param rgba 4 bytes a pixel, drawn without blending
  /// @param depth window depth, 0 to 1; pixels beyond 1 are not drawn
  /// @param error why nothing was drawn, empty on success
  void draw(vtkOpenGLRenderWindow* window, const PixelRectangle& viewport,
    const std::vector<std::uint8_t>& rgba, const std::vector<float>& depth, std::string& error);

  void releaseGraphicsResources(vtkWindow* window);

private:
  bool upload(vtkOpenGLRenderWindow* window, const PixelRectangle& viewport,
    const std::vector<std::uint8_t>& rgba, const std::vector<float>& depth);
  bool readyProgram(vtkOpenGLRenderWindow* window);

  vtkNew<vtkTextureObject> colors_, depths_;
  std::unique_ptr<vtkOpenGLQuadHelper> quad_;
};
}

#endif
