// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthSilhouettePass.h"

#include "Projection.h"
#include "SilhouettePainter.h"

#include "vtkCamera.h"
#include "vtkHomogeneousTransform.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkTransform.h"

#include <optional>

vtkStandardNewMacro(vtkDepthSilhouettePass);

namespace
{
/// Where the renderer draws in the frame buffer that is bound.
po::SilhouetteViewport viewportOf(const vtkRenderState* state)
{
  po::SilhouetteViewport viewport{};
  if (auto* frame = vtkOpenGLFramebufferObject::SafeDownCast(state->GetFrameBuffer()))
  {
    frame->GetLastSize(viewport.width, viewport.height);
  }
  else
  {
    state->GetRenderer()->GetTiledSizeAndOrigin(
      &viewport.width, &viewport.height, &viewport.x, &viewport.y);
  }
  return viewport;
}

/// The projection that the mappers draw with; nothing if it is singular.
std::optional<po::WindowToEye> windowToEyeOf(vtkRenderer* renderer)
{
  return po::windowToEyeOf(renderer->GetActiveCamera()->GetProjectionTransformMatrix(
    renderer->GetTiledAspectRatio(), -1.0, 1.0));
}

vtkOpenGLRenderWindow* windowOf(const vtkRenderState* state)
{
  return vtkOpenGLRenderWindow::SafeDownCast(state->GetRenderer()->GetRenderWindow());
}

/// Not with an empty viewport or a degenerate camera.
bool canBeSeen(const vtkRenderState* state)
{
  const po::SilhouetteViewport viewport = viewportOf(state);
  return viewport.width > 0 && viewport.height > 0 && windowToEyeOf(state->GetRenderer());
}

/// The window shows one tile of a larger picture.
bool isTile(const vtkRenderState* state)
{
  const int* scale = windowOf(state)->GetTileScale();
  return scale[0] > 1 || scale[1] > 1;
}

/// Pixels around a tile that the Laplacian of the tile's pixels needs.
constexpr int TileMargin = 1;
}

struct vtkDepthSilhouettePass::Internals
{
  po::SilhouettePainter Painter;
};

vtkDepthSilhouettePass::vtkDepthSilhouettePass()
  : Internal(std::make_unique<Internals>())
{
}

vtkDepthSilhouettePass::~vtkDepthSilhouettePass() = default;

bool vtkDepthSilhouettePass::CheckParameters()
{
  const std::string fault = po::faultOf({ this->Threshold, this->BackgroundDepth });
  if (!fault.empty())
  {
    vtkErrorMacro(<< fault);
  }
  return fault.empty();
}

void vtkDepthSilhouettePass::Render(const vtkRenderState* state)
{
  this->NumberOfRenderedProps = 0;
  if (!this->DelegatePass)
  {
    vtkWarningMacro("There is no delegate pass: nothing is drawn.");
    return;
  }
  // While a selection is made, colours are identifiers and must stay untouched.
  const bool selecting = state->GetRenderer()->GetSelector() != nullptr;
  const bool lines =
    this->LineVisibility && !selecting && this->CheckParameters() && canBeSeen(state);
  const bool tile = lines && isTile(state);
  const bool margins = tile && this->TileMargins;

  std::string error = margins ? this->ReadDepthAroundTile(state) : std::string();
  this->DelegatePass->Render(state);
  this->NumberOfRenderedProps += this->DelegatePass->GetNumberOfRenderedProps();
  if (lines && !margins)
  {
    error = this->ReadDepth(state, !tile);
  }
  if (!error.empty())
  {
    vtkErrorMacro(<< error << " No silhouettes are drawn.");
  }
  else if (lines)
  {
    this->DrawLines(state, margins ? TileMargin : 0);
  }
}

std::string vtkDepthSilhouettePass::ReadDepth(const vtkRenderState* state, bool whole)
{
  return this->Internal->Painter.readDepth(
    windowOf(state), viewportOf(state), *windowToEyeOf(state->GetRenderer()), whole);
}

std::string vtkDepthSilhouettePass::ReadDepthAroundTile(const vtkRenderState* state)
{
  vtkRenderer* renderer = state->GetRenderer();
  vtkOpenGLRenderWindow* window = windowOf(state);
  const po::SilhouetteViewport tile = viewportOf(state);
  const po::SilhouetteViewport around{ 0, 0, tile.width + 2 * TileMargin,
    tile.height + 2 * TileMargin };

  window->GetState()->PushFramebufferBindings();
  vtkNew<vtkOpenGLFramebufferObject> frame;
  frame->SetContext(window);
  frame->PopulateFramebuffer(
    around.width, around.height, true, 1, VTK_UNSIGNED_CHAR, true, 32, 0, false);

  // The tile's picture shrinks to the middle of the frame, so that its pixels stay what they are.
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkSmartPointer<vtkHomogeneousTransform> own = camera->GetUserTransform();
  vtkNew<vtkTransform> shrink;
  shrink->Scale(static_cast<double>(tile.width) / around.width,
    static_cast<double>(tile.height) / around.height, 1.0);
  if (own)
  {
    shrink->Concatenate(own->GetMatrix());
  }
  camera->SetUserTransform(shrink);

  vtkRenderState inside(renderer);
  inside.SetPropArrayAndCount(state->GetPropArray(), state->GetPropArrayCount());
  inside.SetFrameBuffer(frame);
  this->DelegatePass->Render(&inside);
  const std::string error =
    this->Internal->Painter.readDepth(window, around, *windowToEyeOf(renderer), false);

  camera->SetUserTransform(own);
  window->GetState()->PopFramebufferBindings();
  return error;
}

void vtkDepthSilhouettePass::DrawLines(const vtkRenderState* state, int margin)
{
  const po::SilhouetteStyle style{ { this->Threshold, this->BackgroundDepth },
    { static_cast<float>(this->Color[0]), static_cast<float>(this->Color[1]),
      static_cast<float>(this->Color[2]), static_cast<float>(this->Opacity) } };
  this->Internal->Painter.drawLines(viewportOf(state), margin, style);
}

void vtkDepthSilhouettePass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->Internal->Painter.releaseGraphicsResources();
}

void vtkDepthSilhouettePass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Threshold: " << this->Threshold << "\n";
  os << indent << "BackgroundDepth: " << this->BackgroundDepth << "\n";
  os << indent << "LineVisibility: " << this->LineVisibility << "\n";
  os << indent << "TileMargins: " << this->TileMargins << "\n";
  os << indent << "Color: " << this->Color[0] << ", " << this->Color[1] << ", " << this->Color[2]
     << "\n";
  os << indent << "Opacity: " << this->Opacity << "\n";
}
