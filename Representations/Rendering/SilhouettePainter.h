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

/// Pixels of the bound frame buffer.
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

/// Draws silhouettes over the frame buffer that is bound for drawing, from that buffer's depth.
/// Keeps textures of the viewport's size and the shader programs between calls.
class SilhouettePainter
{
public:
  /// Returns what went wrong; empty if nothing did.
  std::string Paint(vtkOpenGLRenderWindow* window, const SilhouetteViewport& viewport,
    const po::WindowToEye& windowToEye, const SilhouetteStyle& style);

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
  void DrawLines(const SilhouetteViewport& viewport, const SilhouetteStyle& style);

  void DrawInto(vtkTextureObject* target, vtkOpenGLQuadHelper& quad);

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  DepthFormat Format{};
  vtkSmartPointer<vtkOpenGLFramebufferObject> Frame;
  Texture Depth;
  Texture Distances;
  /// Each level holds the farthest distance of 8 x 8 pixels of the one before; the last is 1 x 1.
  std::vector<Texture> Farthest;
  std::unique_ptr<vtkOpenGLQuadHelper> DistanceQuad;
  std::unique_ptr<vtkOpenGLQuadHelper> FarthestQuad;
  std::unique_ptr<vtkOpenGLQuadHelper> LineQuad;
};

#endif
