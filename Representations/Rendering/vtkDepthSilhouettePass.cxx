// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthSilhouettePassInternals.h"

#include "DrawnProps.h"
#include "ImageDepth.h"
#include "Projection.h"
#include "ShrunkCamera.h"
#include "SilhouetteParametersOf.h"
#include "SilhouetteRims.h"
#include "TracedLayers.h"

#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <optional>
#include <vector>

vtkStandardNewMacro(vtkDepthSilhouettePass);

namespace po
{
SilhouetteViewport viewportOf(const vtkRenderState* state)
{
  SilhouetteViewport viewport{};
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

vtkOpenGLRenderWindow* windowOf(const vtkRenderState* state)
{
  return vtkOpenGLRenderWindow::SafeDownCast(state->GetRenderer()->GetRenderWindow());
}

std::optional<WindowToEye> windowToEyeOf(vtkRenderer* renderer)
{
  return windowToEyeOf(renderer->GetActiveCamera()->GetProjectionTransformMatrix(
    renderer->GetTiledAspectRatio(), -1.0, 1.0));
}

int samplesThatFit(int wanted, int width, int height)
{
  // Side of the largest frame that every OpenGL 3.2 draws.
  constexpr int LargestFrame = 8192;
  int samples = wanted;
  while (samples > 1 && samples * std::max(width, height) > LargestFrame)
  {
    samples /= 2;
  }
  return samples;
}
}

namespace
{
/// Not with an empty viewport or a degenerate camera.
bool canBeSeen(const vtkRenderState* state)
{
  const po::SilhouetteViewport viewport = po::viewportOf(state);
  return viewport.width > 0 && viewport.height > 0 && po::windowToEyeOf(state->GetRenderer());
}

/// A picture with its border repeated `margin` pixels beyond it.
std::vector<std::uint8_t> pad(
  const std::vector<std::uint8_t>& rgba, int width, int height, int margin)
{
  std::vector<std::uint8_t> padded;
  for (int j = -margin; j < height + margin; ++j)
  {
    for (int i = -margin; i < width + margin; ++i)
    {
      const auto pixel = rgba.begin() +
        4 *
          (static_cast<std::ptrdiff_t>(std::clamp(j, 0, height - 1)) * width +
            std::clamp(i, 0, width - 1));
      padded.insert(padded.end(), pixel, pixel + 4);
    }
  }
  return padded;
}

/// The nearest window depth of the samples of each pixel.
void findNearest(const std::vector<float>& zBuffer, int width, int height, int samples,
  std::vector<float>& nearest)
{
  nearest.assign(static_cast<std::size_t>(width) * height, 1);
  for (int j = 0; j < height * samples; ++j)
  {
    for (int i = 0; i < width * samples; ++i)
    {
      float& z = nearest[static_cast<std::size_t>(j / samples) * width + i / samples];
      z = std::min(z, zBuffer[static_cast<std::size_t>(j) * width * samples + i]);
    }
  }
}

}

vtkDepthSilhouettePass::vtkDepthSilhouettePass()
  : Internal(std::make_unique<Internals>())
{
}

vtkDepthSilhouettePass::~vtkDepthSilhouettePass() = default;

void vtkDepthSilhouettePass::AddActor(vtkActor* actor)
{
  if (actor)
  {
    this->Internal->Actors.emplace_back(actor);
    this->Modified();
  }
}

void vtkDepthSilhouettePass::RemoveAllActors()
{
  this->Internal->Actors.clear();
  this->Modified();
}

bool vtkDepthSilhouettePass::CheckParameters()
{
  const std::string fault = po::faultOf(po::silhouetteParametersOf(*this));
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
  const std::string error =
    this->IsShared() ? this->RenderShared(state, lines) : this->RenderAlone(state, lines);
  if (!error.empty())
  {
    vtkErrorMacro("Silhouettes cannot be drawn: " << error);
  }
}

void vtkDepthSilhouettePass::RenderDelegate(const vtkRenderState* state)
{
  this->DelegatePass->Render(state);
  this->NumberOfRenderedProps += this->DelegatePass->GetNumberOfRenderedProps();
}

std::string vtkDepthSilhouettePass::RenderAlone(const vtkRenderState* state, bool lines)
{
  Internals& self = *this->Internal;
  const bool around =
    lines && this->TileMargins && (po::isTile(state->GetRenderer()) || !self.Actors.empty());
  std::string error = around ? this->FindAround(state) : std::string();
  this->RenderDelegate(state);
  if (lines && !around)
  {
    error = this->Prepare(state);
  }
  return lines && error.empty()
    ? this->DrawLines(state, self.Lines, { nullptr, self.FrontDepth, nullptr })
    : error;
}

std::string vtkDepthSilhouettePass::Prepare(const vtkRenderState* state)
{
  const po::SilhouetteViewport viewport = po::viewportOf(state);
  // With several processes the frame buffer has what others have drawn too.
  if (this->TileMargins && !po::tracedActorsOf(state, viewport.width, viewport.height).empty())
  {
    return this->FindInTracedFrames(state, 0);
  }
  const int samples = po::samplesThatFit(this->Samples, viewport.width, viewport.height);
  return samples > 1 && this->TileMargins ? this->FindAround(state)
                                          : this->FindInZBuffer(state, 1, 0);
}

std::string vtkDepthSilhouettePass::FindInTracedFrames(const vtkRenderState* state, int margin)
{
  Internals& self = *this->Internal;
  const po::SilhouetteViewport viewport = po::viewportOf(state);
  const auto actors = po::tracedActorsOf(state, viewport.width, viewport.height);
  const po::SilhouetteScale& scale =
    self.scale(*po::scaleOf(po::actorsOf(actors)), !po::isTile(state->GetRenderer()));
  const po::SilhouetteRule rule = po::resolve(po::silhouetteParametersOf(*this), scale);
  const bool placed = !self.Actors.empty();
  po::findTracedSilhouettes(
    po::depthOf(actors), rule, self.Lines, { this->Darken || placed || rule.samples > 1, true });
  self.Margin = margin;
  self.FrontDepth = placed ? po::windowDepthOf(actors, self.WindowDepth) : nullptr;
  return "";
}

std::string vtkDepthSilhouettePass::FindInZBuffer(
  const vtkRenderState* state, int samples, int margin)
{
  Internals& self = *this->Internal;
  const po::SilhouetteViewport viewport = po::viewportOf(state);
  std::string error = self.Painter.readDepth(po::windowOf(state), viewport, self.ZBuffer);
  if (!error.empty())
  {
    return error;
  }
  po::eyeDistances(*po::windowToEyeOf(state->GetRenderer()), self.ZBuffer, viewport.width,
    viewport.height, self.Distances);
  const po::ImageDepth<float> depth(
    po::DepthImage<float>{ self.Distances.data(), viewport.width, viewport.height }, samples);
  po::SilhouetteParameters parameters = po::silhouetteParametersOf(*this);
  parameters.samples = samples;
  const auto ofSpheres = po::scaleOf(po::visibleActorsOf(po::propsOf(state)));
  if (this->ThresholdUnit != 0 && !ofSpheres)
  {
    return po::NoSpheresForRadii;
  }
  const po::SilhouetteScale& scale =
    self.scale(ofSpheres ? *ofSpheres : po::SilhouetteScale{ 0, po::depthSpread(depth) },
      !po::isTile(state->GetRenderer()));
  const bool placed = !self.Actors.empty();
  po::findSilhouettes(depth, po::resolve(parameters, scale), self.Lines,
    { this->Darken || placed || samples > 1, true });
  self.Margin = margin;
  self.FrontDepth = nullptr;
  if (placed)
  {
    findNearest(self.ZBuffer, depth.width(), depth.height(), samples, self.WindowDepth);
    self.FrontDepth = self.WindowDepth.data();
  }
  return "";
}

std::string vtkDepthSilhouettePass::FindAround(const vtkRenderState* state)
{
  Internals& self = *this->Internal;
  const po::SilhouetteViewport tile = po::viewportOf(state);
  const int margin =
    po::isTile(state->GetRenderer()) ? po::tileMarginOf(po::silhouetteParametersOf(*this)) : 0;
  const int width = tile.width + 2 * margin, height = tile.height + 2 * margin;
  std::vector<vtkProp*> props = po::propsOf(state);
  if (!self.Actors.empty())
  {
    props.assign(self.Actors.begin(), self.Actors.end());
  }
  const bool spheres = po::hasOnlySpheres(props);
  const int samples = spheres ? 1 : po::samplesThatFit(this->Samples, width, height);
  return this->DrawAside(state, props, samples, margin,
    [&](const vtkRenderState* inside)
    {
      const bool traced = spheres && !po::tracedActorsOf(inside, width, height).empty();
      return traced ? this->FindInTracedFrames(inside, margin)
                    : this->FindInZBuffer(inside, samples, margin);
    });
}

/// Draws props into a frame buffer of its own, `samples` times as large and `margin` pixels larger
/// on each side, and calls `use` while it and its camera are there.
std::string vtkDepthSilhouettePass::DrawAside(const vtkRenderState* state,
  const std::vector<vtkProp*>& props, int samples, int margin,
  const std::function<std::string(const vtkRenderState*)>& use)
{
  Internals& self = *this->Internal;
  vtkRenderer* renderer = state->GetRenderer();
  vtkOpenGLRenderWindow* window = po::windowOf(state);
  const po::SilhouetteViewport tile = po::viewportOf(state);
  const int width = tile.width + 2 * margin, height = tile.height + 2 * margin;
  const po::OpaqueActors opaque(self.Actors);
  const po::ShrunkCamera shrunk(renderer->GetActiveCamera(),
    static_cast<double>(tile.width) / width, static_cast<double>(tile.height) / height);

  window->GetState()->PushFramebufferBindings();
  vtkNew<vtkOpenGLFramebufferObject> frame;
  frame->SetContext(window);
  frame->PopulateFramebuffer(
    samples * width, samples * height, true, 1, VTK_UNSIGNED_CHAR, true, 32, 0, false);
  vtkRenderState inside(renderer);
  inside.SetPropArrayAndCount(const_cast<vtkProp**>(props.data()), static_cast<int>(props.size()));
  inside.SetFrameBuffer(frame);
  // A delegate may draw all of the renderer's props, as ParaView's does, or composite them.
  const bool byDelegate = self.Actors.empty() && !this->IsShared();
  (byDelegate ? this->DelegatePass : self.ActorsPass.Get())->Render(&inside);
  std::string error = use(&inside);
  window->GetState()->PopFramebufferBindings();
  return error;
}

std::string vtkDepthSilhouettePass::DrawLines(const vtkRenderState* state,
  const po::SilhouetteImage& lines, po::SilhouetteSurroundings surroundings)
{
  Internals& self = *this->Internal;
  const po::SilhouetteViewport viewport = po::viewportOf(state);
  if (this->Darken || !lines.inside.empty())
  {
    std::string error = self.Painter.readColors(po::windowOf(state), viewport, self.Colors);
    if (!error.empty())
    {
      return error;
    }
    if (self.Margin > 0)
    {
      self.Colors = pad(self.Colors, viewport.width, viewport.height, self.Margin);
    }
    surroundings.rgba = self.Colors.data();
  }
  po::colorSilhouettes(lines, po::silhouetteStyleOf(*this), surroundings, self.Pixels);
  return self.Painter.draw(po::windowOf(state), viewport, self.Margin, self.Pixels);
}

void vtkDepthSilhouettePass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->Internal->Painter.releaseGraphicsResources();
  this->Internal->ActorsPass->ReleaseGraphicsResources(window);
}

void vtkDepthSilhouettePass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  po::print(os, indent, po::silhouetteParametersOf(*this));
  os << indent << "LineVisibility: " << this->LineVisibility << "\n";
  os << indent << "Controller: " << this->Internal->Controller << "\n";
  os << indent << "OrderedCompositing: " << this->OrderedCompositing << "\n";
  os << indent << "SharedBytes: " << this->SharedBytes << "\n";
  os << indent << "TileMargins: " << this->TileMargins << "\n";
  os << indent << "Color: " << this->Color[0] << ", " << this->Color[1] << ", " << this->Color[2]
     << "\n";
  os << indent << "Opacity: " << this->Opacity << "\n";
  os << indent << "Darken: " << this->Darken << "\n";
}
