// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSphereSilhouettes.h"

#include "ShrunkCamera.h"
#include "SilhouettePainter.h"
#include "SilhouetteParametersOf.h"
#include "SilhouetteRims.h"
#include "SphereRenderer.h"
#include "TracedLayers.h"

#include "vtkActor.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtk_glew.h"

#include <vector>

vtkStandardNewMacro(vtkSphereSilhouettes);

struct vtkSphereSilhouettes::Internals
{
  std::vector<vtkSmartPointer<vtkActor>> Actors;
  po::SilhouettePainter Painter;
  po::SilhouetteImage Lines;
  po::SilhouettePixels Pixels;
  std::vector<float> WindowDepth;
  std::vector<std::uint8_t> Colors;

  std::vector<po::TracedActor> tracedActors(const po::SilhouetteViewport& viewport) const
  {
    std::vector<po::TracedActor> traced;
    for (const auto& actor : this->Actors)
    {
      const po::TracedActor one = po::tracedActorOf(actor, viewport.width, viewport.height);
      if (actor->GetVisibility() && one.renderer && !one.renderer->cloud().spheres.empty())
      {
        traced.push_back(one);
      }
    }
    return traced;
  }
};

namespace
{
/// Where the spheres have just been drawn: all of a tile or of a pass's own buffer.
po::SilhouetteViewport currentViewport(vtkOpenGLRenderWindow* window)
{
  int viewport[4] = {};
  window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, viewport);
  return { viewport[0], viewport[1], viewport[2], viewport[3] };
}
}

vtkSphereSilhouettes::vtkSphereSilhouettes()
  : Internal(std::make_unique<Internals>())
{
  this->PickableOff();
  this->UseBoundsOff();
}

vtkSphereSilhouettes::~vtkSphereSilhouettes() = default;

void vtkSphereSilhouettes::AddActor(vtkActor* actor)
{
  if (actor)
  {
    this->Internal->Actors.emplace_back(actor);
    this->Modified();
  }
}

void vtkSphereSilhouettes::RemoveAllActors()
{
  this->Internal->Actors.clear();
  this->Modified();
}

int vtkSphereSilhouettes::RenderVolumetricGeometry(vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  auto* window =
    renderer ? vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()) : nullptr;
  if (!this->LineVisibility || !window || renderer->GetSelector())
  {
    return 0;
  }
  const po::SilhouetteParameters parameters = po::silhouetteParametersOf(*this);
  if (const std::string fault = po::faultOf(parameters); !fault.empty())
  {
    vtkErrorMacro(<< fault);
    return 0;
  }
  const po::SilhouetteViewport place = currentViewport(window);
  const bool tile = po::isTile(renderer);
  const int margin = tile ? po::tileMarginOf(parameters) : 0;
  std::string error;
  if (tile)
  {
    error = this->FindAround(renderer, place, margin);
  }
  else if (!this->Find(place))
  {
    return 0;
  }
  if (error.empty())
  {
    error = this->Internal->Painter.draw(window, place, margin, this->Internal->Pixels);
  }
  if (!error.empty())
  {
    vtkErrorMacro("Silhouettes cannot be drawn: " << error);
  }
  return error.empty() ? 1 : 0;
}

bool vtkSphereSilhouettes::Find(const po::SilhouetteViewport& place)
{
  Internals& self = *this->Internal;
  const std::vector<po::TracedActor> actors = self.tracedActors(place);
  if (actors.empty())
  {
    self.Pixels = {};
    return false;
  }
  const po::SilhouetteRule rule =
    po::resolve(po::silhouetteParametersOf(*this), *po::scaleOf(po::actorsOf(actors)));
  po::findTracedSilhouettes(po::depthOf(actors), rule, self.Lines, { true, true });
  const po::SilhouetteSurroundings surroundings{ po::colorsOf(actors, self.Colors),
    po::windowDepthOf(actors, self.WindowDepth) };
  po::colorSilhouettes(self.Lines, po::silhouetteStyleOf(*this), surroundings, self.Pixels);
  return true;
}

std::string vtkSphereSilhouettes::FindAround(
  vtkRenderer* renderer, const po::SilhouetteViewport& tile, int margin)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  const int width = tile.width + 2 * margin, height = tile.height + 2 * margin;
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglScissor scissor(state);
  const po::ShrunkCamera shrunk(renderer->GetActiveCamera(),
    static_cast<double>(tile.width) / width, static_cast<double>(tile.height) / height);
  state->PushFramebufferBindings();
  vtkNew<vtkOpenGLFramebufferObject> frame;
  frame->SetContext(window);
  frame->PopulateFramebuffer(width, height, true, 1, VTK_UNSIGNED_CHAR, true, 32, 0, false);
  state->vtkglViewport(0, 0, width, height);
  state->vtkglScissor(0, 0, width, height);
  for (const auto& actor : this->Internal->Actors)
  {
    if (actor->GetVisibility())
    {
      actor->RenderOpaqueGeometry(renderer);
    }
  }
  const bool found = this->Find({ 0, 0, width, height });
  state->PopFramebufferBindings();
  return found || this->Internal->Actors.empty() ? "" : "The spheres around a tile were not drawn.";
}

void vtkSphereSilhouettes::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Painter.releaseGraphicsResources();
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkSphereSilhouettes::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  po::print(os, indent, po::silhouetteParametersOf(*this));
  os << indent << "LineVisibility: " << this->LineVisibility << "\n";
  os << indent << "Color: " << this->Color[0] << ", " << this->Color[1] << ", " << this->Color[2]
     << "\n";
  os << indent << "Opacity: " << this->Opacity << "\n";
  os << indent << "Darken: " << this->Darken << "\n";
}
