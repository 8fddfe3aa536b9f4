// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthSilhouettePass.h"

#include "SilhouettePainter.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"

#include <cmath>

vtkStandardNewMacro(vtkDepthSilhouettePass);

namespace
{

/// Where the renderer draws in the frame buffer that is bound.
SilhouetteViewport ViewportOf(const vtkRenderState* state)
{
  SilhouetteViewport viewport{};
  if (auto* frame = vtkOpenGLFramebufferObject::SafeDownCast(state->GetFrameBuffer()))
  {
    frame->GetLastSize(viewport.Width, viewport.Height);
  }
  else
  {
    state->GetRenderer()->GetTiledSizeAndOrigin(
      &viewport.Width, &viewport.Height, &viewport.X, &viewport.Y);
  }
  return viewport;
}

/// The projection that the mappers draw with; nothing if it is singular.
std::optional<po::WindowToEye> WindowToEyeOf(vtkRenderer* renderer)
{
  vtkMatrix4x4* projection = renderer->GetActiveCamera()->GetProjectionTransformMatrix(
    renderer->GetTiledAspectRatio(), -1.0, 1.0);
  const double determinant = projection->Determinant();
  if (!std::isfinite(determinant) || determinant == 0.0)
  {
    return std::nullopt;
  }
  po::Matrix4 inverse;
  vtkMatrix4x4::Invert(projection->GetData(), inverse.data());
  return po::MakeWindowToEye(inverse);
}

} // namespace

struct vtkDepthSilhouettePass::Internals
{
  SilhouettePainter Painter;
};

vtkDepthSilhouettePass::vtkDepthSilhouettePass()
  : Internal(std::make_unique<Internals>())
{
}

vtkDepthSilhouettePass::~vtkDepthSilhouettePass() = default;

bool vtkDepthSilhouettePass::CheckParameters()
{
  if (!(this->Threshold >= 0.0) || !std::isfinite(this->Threshold))
  {
    vtkErrorMacro("Threshold is " << this->Threshold
                                  << "; it must be a length >= 0 in world units (0: automatic).");
    return false;
  }
  if (!(this->BackgroundDepth >= 0.0) || !std::isfinite(this->BackgroundDepth))
  {
    vtkErrorMacro("BackgroundDepth is "
      << this->BackgroundDepth << "; it must be a depth >= 0 in world units (0: automatic).");
    return false;
  }
  return true;
}

void vtkDepthSilhouettePass::Render(const vtkRenderState* state)
{
  this->NumberOfRenderedProps = 0;
  if (!this->DelegatePass)
  {
    vtkWarningMacro("There is no delegate pass: nothing is drawn.");
    return;
  }
  this->DelegatePass->Render(state);
  this->NumberOfRenderedProps += this->DelegatePass->GetNumberOfRenderedProps();

  // While a selection is made, colours are identifiers and must stay untouched.
  const bool selecting = state->GetRenderer()->GetSelector() != nullptr;
  if (this->LineVisibility && !selecting && this->CheckParameters())
  {
    this->DrawLines(state);
  }
}

void vtkDepthSilhouettePass::DrawLines(const vtkRenderState* state)
{
  const SilhouetteViewport viewport = ViewportOf(state);
  const auto windowToEye = WindowToEyeOf(state->GetRenderer());
  if (viewport.Width <= 0 || viewport.Height <= 0 || !windowToEye)
  {
    return; // an empty viewport or a degenerate camera shows nothing
  }
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(state->GetRenderer()->GetRenderWindow());
  const SilhouetteStyle style{ { this->Threshold, this->BackgroundDepth },
    { static_cast<float>(this->Color[0]), static_cast<float>(this->Color[1]),
      static_cast<float>(this->Color[2]), static_cast<float>(this->Opacity) } };
  const std::string error = this->Internal->Painter.Paint(window, viewport, *windowToEye, style);
  if (!error.empty())
  {
    vtkErrorMacro(<< error << " No silhouettes are drawn.");
  }
}

void vtkDepthSilhouettePass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->Internal->Painter.ReleaseGraphicsResources();
}

void vtkDepthSilhouettePass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Threshold: " << this->Threshold << "\n";
  os << indent << "BackgroundDepth: " << this->BackgroundDepth << "\n";
  os << indent << "LineVisibility: " << this->LineVisibility << "\n";
  os << indent << "Color: " << this->Color[0] << ", " << this->Color[1] << ", " << this->Color[2]
     << "\n";
  os << indent << "Opacity: " << this->Opacity << "\n";
}
