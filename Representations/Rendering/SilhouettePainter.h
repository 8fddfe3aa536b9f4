// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouettePainter_h
#define po_SilhouettePainter_h

#include "SilhouettePixels.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"
#include "vtkWeakPointer.h"

#include <memory>
#include <string>
#include <vector>

namespace po
{
/// Pixels of a frame buffer.
struct SilhouetteViewport
{
  int x;
  int y;
  int width;
  int height;
};

/// Reads the depth and the colours of a frame buffer and draws lines over the same or another one.
/// Keeps textures of the viewport's size and the shader program between calls.
class SilhouettePainter
{
public:
  /// Reads the z-buffer of the frame buffer that is bound for drawing, rows from the bottom.
  /// Returns what went wrong; empty if nothing did.
  std::string readDepth(
    vtkOpenGLRenderWindow* window, const SilhouetteViewport& viewport, std::vector<float>& zBuffer);

  /// Reads RGBA bytes of the same frame buffer.
  std::string readColors(vtkOpenGLRenderWindow* window, const SilhouetteViewport& viewport,
    std::vector<std::uint8_t>& rgba);

  /// Blends lines over the frame buffer that is bound for drawing, except where what is there is
  /// nearer. The lines reach `margin` pixels beyond the viewport on each side; depth is not
  /// written.
  /// @param markBackground give lines that are drawn on the background a depth just before the far
  /// plane: for pictures that are composited by depth, where a pixel without depth does not count
  std::string draw(vtkOpenGLRenderWindow* window, const SilhouetteViewport& viewport, int margin,
    const SilhouettePixels& pixels, bool markBackground = false);

  void releaseGraphicsResources();

private:
  using Texture = vtkSmartPointer<vtkTextureObject>;

  /// Depth format of a frame buffer. Depth is only copied between equal formats.
  struct DepthFormat
  {
    bool exists;
    int type; // vtkTextureObject's enumeration
    bool stencil;
    bool operator==(const DepthFormat& other) const;
  };

  static DepthFormat queryDepthFormat(unsigned int frame);
  void use(vtkOpenGLRenderWindow* window);
  void allocate(const SilhouetteViewport& viewport, const DepthFormat& format);
  bool copy(unsigned int frame, const SilhouetteViewport& viewport);
  std::string read(vtkOpenGLRenderWindow* window, const SilhouetteViewport& viewport,
    unsigned int glFormat, unsigned int glType, void* target);
  std::string upload(const SilhouettePixels& pixels, int width, int height);

  vtkWeakPointer<vtkOpenGLRenderWindow> window_;
  DepthFormat format_{};
  vtkSmartPointer<vtkOpenGLFramebufferObject> frame_;
  Texture copiedDepth_, copiedColor_;
  Texture colors_, depths_;
  std::unique_ptr<vtkOpenGLQuadHelper> quad_;
};
}

#endif
