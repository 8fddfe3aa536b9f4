// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkDepthSilhouettePassInternals_h
#define vtkDepthSilhouettePassInternals_h

#include "EyeDistance.h"
#include "SharedSilhouettes.h"
#include "SilhouettePainter.h"
#include "vtkDepthSilhouettePass.h"

#include "vtkActor.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderState.h"
#include "vtkRenderStepsPass.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace po
{
/// Where the renderer draws in the frame buffer that is bound.
[[nodiscard]] SilhouetteViewport viewportOf(const vtkRenderState* state);

[[nodiscard]] vtkOpenGLRenderWindow* windowOf(const vtkRenderState* state);

/// The projection that the mappers draw with; nothing if it is singular.
[[nodiscard]] std::optional<WindowToEye> windowToEyeOf(vtkRenderer* renderer);

/// A parameter asks for what is not there.
inline constexpr const char* NoSpheresForRadii =
  "ThresholdUnit asks for particle radii, but no ray-traced spheres are visible.";

/// The largest number of samples up to `wanted` with which a frame of so many pixels can be drawn.
[[nodiscard]] int samplesThatFit(int wanted, int width, int height);
}

/// What a pass keeps from one picture to the next.
struct vtkDepthSilhouettePass::Internals
{
  po::SilhouettePainter Painter;
  std::vector<vtkSmartPointer<vtkActor>> Actors; ///< that have lines; none: all
  vtkNew<vtkRenderStepsPass> ActorsPass;         ///< draws them alone
  po::SilhouetteScale Scale;                     ///< of the last whole picture
  bool HasScale = false;
  std::vector<float> ZBuffer, Distances, WindowDepth;
  const float* FrontDepth = nullptr; ///< what lines are hidden by; null: nothing
  std::vector<std::uint8_t> Colors;
  po::SilhouetteImage Lines;
  po::SilhouettePixels Pixels;
  int Margin = 0; ///< pixels of the lines around the viewport
  vtkSmartPointer<vtkMultiProcessController> Controller;
  po::SharedSilhouettes Shared;

  /// The scale of a whole picture, or, for a tile, that of the last whole picture.
  const po::SilhouetteScale& scale(const po::SilhouetteScale& ofThis, bool whole)
  {
    if (whole || !this->HasScale)
    {
      this->Scale = ofThis;
      this->HasScale = whole;
    }
    return this->Scale;
  }
};

#endif
