// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSphereSilhouettes.h"

#include "ControllerGroup.h"
#include "SharedPicture.h"
#include "ShrunkCamera.h"
#include "SilhouettePainter.h"
#include "SilhouetteParametersOf.h"
#include "SilhouetteRims.h"
#include "SphereRenderer.h"
#include "TracedLayers.h"

#include "vtkActor.h"
#include "vtkCommand.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"
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
  vtkSmartPointer<vtkMultiProcessController> Controller;
  vtkWeakPointer<vtkRenderer> Renderer;
  unsigned long Observers[2] = { 0, 0 };
  po::SharedSilhouettes Shared;

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

vtkSphereSilhouettes::~vtkSphereSilhouettes()
{
  this->SetRenderer(nullptr);
}

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

/// Are there lines to draw, by the parameters and what the renderer does?
bool vtkSphereSilhouettes::CanDraw(vtkRenderer* renderer)
{
  const std::string fault = po::faultOf(po::silhouetteParametersOf(*this));
  if (!fault.empty())
  {
    vtkErrorMacro(<< fault);
  }
  return fault.empty() && !renderer->GetSelector();
}

/// Not as volumetric geometry, which may be peeled layer by layer with what is translucent.
int vtkSphereSilhouettes::RenderOverlay(vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  auto* window =
    renderer ? vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()) : nullptr;
  if (!this->LineVisibility || !window || (!this->IsShared() && !this->CanDraw(renderer)))
  {
    return 0;
  }
  const po::SilhouetteViewport place = currentViewport(window);
  const bool tile = po::isTile(renderer);
  const int margin = tile ? po::tileMarginOf(po::silhouetteParametersOf(*this)) : 0;
  std::string error;
  if (!(tile ? this->FindAround(renderer, place, margin, error) : this->Find(renderer, place)))
  {
    return 0;
  }
  if (error.empty())
  {
    error = this->Internal->Painter.draw(
      window, place, margin, this->Internal->Pixels, this->IsShared() && !this->OrderedCompositing);
  }
  if (!error.empty())
  {
    vtkErrorMacro("Silhouettes cannot be drawn: " << error);
  }
  return error.empty() ? 1 : 0;
}

bool vtkSphereSilhouettes::Find(vtkRenderer* renderer, const po::SilhouetteViewport& place)
{
  return this->IsShared() ? this->FindTogether(renderer, place) : this->FindOwn(place);
}

bool vtkSphereSilhouettes::FindOwn(const po::SilhouetteViewport& place)
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

/// Every process finds, and draws into its own picture, the lines of all: of each pixel the picture
/// of one process is taken. Where several lie one over the other, each draws those of its spheres.
bool vtkSphereSilhouettes::FindTogether(vtkRenderer* renderer, const po::SilhouetteViewport& place)
{
  Internals& self = *this->Internal;
  const std::vector<vtkProp*> props(self.Actors.begin(), self.Actors.end());
  const po::OwnFrames own = po::framesOf(props, renderer, place.width, place.height);
  const po::ControllerGroup group(self.Controller);
  const auto scale = po::agreedScale(
    { this->CanDraw(renderer) && own.complete, place.width, place.height, po::scaleOf(props) },
    group);
  if (!scale)
  {
    return false;
  }
  const po::SilhouetteRule rule = po::resolve(po::silhouetteParametersOf(*this), *scale);
  const std::uint8_t* colors = own.actors.empty() ? nullptr : po::colorsOf(own.actors, self.Colors);
  const std::string error =
    po::findWithColors(own, rule, group, { colors, this->Darken }, self.Shared);
  if (!error.empty())
  {
    vtkErrorMacro("Silhouettes cannot be drawn: " << error);
    return false;
  }
  if (this->OrderedCompositing)
  {
    self.Shared.keepOwn(group.rank());
  }
  const po::PlacedLines& lines = self.Shared.lines();
  po::colorSilhouettes(lines.image, po::silhouetteStyleOf(*this),
    { self.Shared.colors().data(), nullptr, lines.windowDepth.data() }, self.Pixels);
  return true;
}

bool vtkSphereSilhouettes::FindAround(
  vtkRenderer* renderer, const po::SilhouetteViewport& tile, int margin, std::string& error)
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
  const bool found = this->Find(renderer, { 0, 0, width, height });
  state->PopFramebufferBindings();
  if (!found && !this->IsShared() && !this->Internal->Actors.empty())
  {
    error = "The spheres around a tile were not drawn.";
  }
  return found;
}

void vtkSphereSilhouettes::SetController(vtkMultiProcessController* controller)
{
  if (this->Internal->Controller != controller)
  {
    this->Internal->Controller = controller;
    this->SetUseBounds(this->IsShared());
    this->Modified();
  }
}

void vtkSphereSilhouettes::SetRenderer(vtkRenderer* renderer)
{
  Internals& self = *this->Internal;
  if (self.Renderer == renderer)
  {
    return;
  }
  if (self.Renderer)
  {
    self.Renderer->RemoveObserver(self.Observers[0]);
    self.Renderer->RemoveObserver(self.Observers[1]);
  }
  self.Renderer = renderer;
  this->IsRendering = false;
  if (renderer)
  {
    self.Observers[0] =
      renderer->AddObserver(vtkCommand::StartEvent, this, &vtkSphereSilhouettes::BeginPicture);
    self.Observers[1] =
      renderer->AddObserver(vtkCommand::EndEvent, this, &vtkSphereSilhouettes::EndPicture);
  }
}

void vtkSphereSilhouettes::BeginPicture()
{
  this->IsRendering = true;
}

void vtkSphereSilhouettes::EndPicture()
{
  this->IsRendering = false;
}

vtkMultiProcessController* vtkSphereSilhouettes::GetController()
{
  return this->Internal->Controller;
}

bool vtkSphereSilhouettes::IsShared()
{
  vtkMultiProcessController* controller = this->Internal->Controller;
  return controller && controller->GetNumberOfProcesses() > 1;
}

double* vtkSphereSilhouettes::GetBounds()
{
  // Otherwise the camera would go by them.
  if (!this->IsRendering || !this->IsShared() || !this->LineVisibility)
  {
    return nullptr;
  }
  constexpr double Wide = 1e12;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Bounds[2 * axis] = -Wide;
    this->Bounds[2 * axis + 1] = Wide;
  }
  return this->Bounds;
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
  os << indent << "Controller: " << this->Internal->Controller << "\n";
  os << indent << "OrderedCompositing: " << this->OrderedCompositing << "\n";
  os << indent << "LineVisibility: " << this->LineVisibility << "\n";
  os << indent << "Color: " << this->Color[0] << ", " << this->Color[1] << ", " << this->Color[2]
     << "\n";
  os << indent << "Opacity: " << this->Opacity << "\n";
  os << indent << "Darken: " << this->Darken << "\n";
}
