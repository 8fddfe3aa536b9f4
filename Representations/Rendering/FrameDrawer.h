// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_FrameDrawer_h
#define po_FrameDrawer_h

#include "vtkNew.h"
#include "vtkTextureObject.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkAbstractMapper;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkProp;
class vtkWindow;

namespace po
{
/// The part of the frame buffer that is drawn to, in pixels.
struct PixelRectangle
{
  int x = 0, y = 0, width = 0, height = 0;
};

/// Pixels with depth, rows from the bottom. They are stretched over the viewport.
struct PixelLayer
{
  int width = 0, height = 0;
  const std::vector<std::uint8_t>* rgba = nullptr; ///< 4 bytes a pixel
  const std::vector<float>* depth = nullptr;       ///< window depth; pixels beyond 1 are not drawn
};

/// How pixels meet what is in the frame buffer. Depth is tested in all cases.
enum class Blending
{
  None,       ///< replaces colour and depth
  Over,       ///< mixes colours by alpha, replaces depth
  OverColors, ///< mixes colours by alpha, leaves depth
  Peeled      ///< as the render passes of the prop ask: depth peeling sorts what is translucent
};

/// Puts computed pixels with depth into the current frame buffer, tested against what is there.
class FrameDrawer
{
public:
  FrameDrawer();
  ~FrameDrawer();

  /// The current OpenGL viewport: that of the renderer, of a tile, or of a pass's own buffer.
  [[nodiscard]] static PixelRectangle currentViewport(vtkOpenGLRenderWindow* window);

  /// Hands layers to OpenGL, unless those of the same version are there already.
  /// @return why that failed, empty on success
  std::string load(
    vtkOpenGLRenderWindow* window, const std::vector<PixelLayer>& layers, std::uint64_t version);

  /// Draws a layer that was loaded. OpenGL's state is left as it was.
  /// @param mapper, prop what is drawn, for the render passes that the prop is drawn by
  /// @return why that failed, empty on success
  std::string draw(vtkOpenGLRenderWindow* window, std::size_t layer, Blending blending,
    vtkAbstractMapper* mapper, vtkProp* prop);

  void releaseGraphicsResources(vtkWindow* window);

private:
  struct Textures
  {
    vtkNew<vtkTextureObject> colors, depths;
  };

  vtkOpenGLQuadHelper* readyProgram(
    vtkOpenGLRenderWindow* window, Blending blending, vtkAbstractMapper* mapper, vtkProp* prop);

  std::vector<std::unique_ptr<Textures>> textures_;
  vtkOpenGLRenderWindow* window_ = nullptr; ///< of the textures
  std::uint64_t version_ = 0;
  std::map<std::string, std::unique_ptr<vtkOpenGLQuadHelper>> quads_; ///< by fragment shader
};
}

#endif
