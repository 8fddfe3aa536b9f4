// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouettePainter_h
#define po_SilhouettePainter_h

#include "DepthLaplacian.h"
#include "EyeDistance.h"

#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"
#include "vtkWeakPointer.h"

#include <array>
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

struct SilhouetteStyle
{
  SilhouetteParameters edges;
  /// RGB and opacity, in [0, 1].
  std::array<float, 4> color;
};

/// Reads the depth of a frame buffer and draws silhouettes over the same or another one. Keeps
/// textures of the viewport's size and the shader programs between calls.
class SilhouettePainter
{
public:
  /// Reads the depth of the frame buffer that is bound for drawing. `whole` says that the viewport
  /// shows the whole picture; automatic values of a tile are those of the last whole picture (of
  /// the tile itself if there was none), so that tiles fit together. Returns what went wrong;
  /// empty if nothing did.
  std::string readDepth(vtkOpenGLRenderWindow* window, const SilhouetteViewport& viewport,
    const WindowToEye& windowToEye, bool whole);

  /// Draws over the frame buffer that is bound for drawing. The depth that was read reaches
  /// `margin` pixels beyond the viewport on each side.
  void drawLines(const SilhouetteViewport& viewport, int margin, const SilhouetteStyle& style);

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
  void allocate(
    vtkOpenGLRenderWindow* window, const SilhouetteViewport& viewport, const DepthFormat& format);
  Texture allocateFloat(int width, int height) const;
  bool buildPrograms();

  bool copyDepth(unsigned int frame, const SilhouetteViewport& viewport);
  void computeDistances(const WindowToEye& windowToEye);
  void findFarthest();
  void drawInto(vtkTextureObject* target, vtkOpenGLQuadHelper& quad);

  vtkWeakPointer<vtkOpenGLRenderWindow> window_;
  DepthFormat format_{};
  vtkSmartPointer<vtkOpenGLFramebufferObject> frame_;
  Texture depth_;
  Texture distances_;
  /// Each level holds the farthest distance of 8 x 8 pixels of the one before; the last is 1 x 1.
  std::vector<Texture> farthest_;
  /// The last level as found for the last whole picture.
  Texture farthestOfWhole_;
  std::unique_ptr<vtkOpenGLQuadHelper> distanceQuad_;
  std::unique_ptr<vtkOpenGLQuadHelper> farthestQuad_;
  std::unique_ptr<vtkOpenGLQuadHelper> lineQuad_;
};
}

#endif
