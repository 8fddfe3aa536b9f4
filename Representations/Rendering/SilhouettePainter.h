// SPDX-License-Identifier: BSD-3-Clause
#ifndef SilhouettePainter_h
#define SilhouettePainter_h

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

/// Pixels of a frame buffer.
struct SilhouetteViewport
{
  int X;
  int Y;
  int Width;
  int Height;
};

struct SilhouetteStyle
{
  po::SilhouetteParameters Edges;
  /// RGB and opacity, in [0, 1].
  std::array<float, 4> Color;
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
  std::string ReadDepth(vtkOpenGLRenderWindow* window, const SilhouetteViewport& viewport,
    const po::WindowToEye& windowToEye, bool whole);

  /// Draws over the frame buffer that is bound for drawing. The depth that was read reaches
  /// `margin` pixels beyond the viewport on each side.
  void DrawLines(const SilhouetteViewport& viewport, int margin, const SilhouetteStyle& style);

  void ReleaseGraphicsResources();

private:
  using Texture = vtkSmartPointer<vtkTextureObject>;

  /// Depth format of a frame buffer. Depth is only copied between equal formats.
  struct DepthFormat
  {
    bool Exists;
    int Type; // vtkTextureObject's enumeration
    bool Stencil;
    bool operator==(const DepthFormat& other) const;
  };

  static DepthFormat QueryDepthFormat(unsigned int frame);
  void Allocate(
    vtkOpenGLRenderWindow* window, const SilhouetteViewport& viewport, const DepthFormat& format);
  Texture AllocateFloat(int width, int height) const;
  bool BuildPrograms();

  bool CopyDepth(unsigned int frame, const SilhouetteViewport& viewport);
  void ComputeDistances(const po::WindowToEye& windowToEye);
  void FindFarthest();
  void DrawInto(vtkTextureObject* target, vtkOpenGLQuadHelper& quad);

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  DepthFormat Format{};
  vtkSmartPointer<vtkOpenGLFramebufferObject> Frame;
  Texture Depth;
  Texture Distances;
  /// Each level holds the farthest distance of 8 x 8 pixels of the one before; the last is 1 x 1.
  std::vector<Texture> Farthest;
  /// The last level as found for the last whole picture.
  Texture FarthestOfWhole;
  std::unique_ptr<vtkOpenGLQuadHelper> DistanceQuad;
  std::unique_ptr<vtkOpenGLQuadHelper> FarthestQuad;
  std::unique_ptr<vtkOpenGLQuadHelper> LineQuad;
};

#endif
