// SPDX-License-Identifier: BSD-3-Clause
// Pictures that are composited from those of several processes.
#include "ControllerGroup.h"
#include "DrawnProps.h"
#include "SharedPicture.h"
#include "SilhouetteParametersOf.h"
#include "vtkDepthSilhouettePassInternals.h"

#include "vtkRenderer.h"

void vtkDepthSilhouettePass::SetController(vtkMultiProcessController* controller)
{
  if (this->Internal->Controller != controller)
  {
    this->Internal->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkDepthSilhouettePass::GetController()
{
  return this->Internal->Controller;
}

bool vtkDepthSilhouettePass::IsShared()
{
  vtkMultiProcessController* controller = this->Internal->Controller;
  return controller && controller->GetNumberOfProcesses() > 1;
}

/// All processes must call it, those too that have no lines to draw.
std::string vtkDepthSilhouettePass::RenderShared(const vtkRenderState* state, bool lines)
{
  Internals& self = *this->Internal;
  const bool tile = po::isTile(state->GetRenderer());
  std::string error;
  bool found = tile && this->FindTogether(state, lines, error);
  this->RenderDelegate(state);
  if (!tile)
  {
    found = this->FindTogether(state, lines, error);
  }
  if (!lines || !error.empty() || self.Controller->GetLocalProcessId() != 0)
  {
    return error;
  }
  if (found)
  {
    const po::PlacedLines& shared = self.Shared.lines();
    const float* depth = self.Actors.empty() ? nullptr : shared.windowDepth.data();
    return this->DrawLines(state, shared.image, { nullptr, nullptr, depth });
  }
  if (self.Actors.empty())
  {
    error = this->FindInZBuffer(state, 1, 0);
    return error.empty() ? this->DrawLines(state, self.Lines, {}) : error;
  }
  return "";
}

/// Finds the lines of ray-traced spheres of all processes, if all can take part; else returns
/// false.
bool vtkDepthSilhouettePass::FindTogether(
  const vtkRenderState* state, bool lines, std::string& error)
{
  Internals& self = *this->Internal;
  vtkRenderer* renderer = state->GetRenderer();
  const bool tile = po::isTile(renderer);
  const po::SilhouetteViewport viewport = po::viewportOf(state);
  self.Margin = tile ? po::tileMarginOf(po::silhouetteParametersOf(*this)) : 0;
  const int width = viewport.width + 2 * self.Margin, height = viewport.height + 2 * self.Margin;
  std::vector<vtkProp*> props = po::deepPropsOf(state);
  if (!self.Actors.empty())
  {
    props.assign(self.Actors.begin(), self.Actors.end());
  }
  const bool canShare = lines && po::hasOnlySpheres(props);
  bool found = false;
  const auto find = [&](const vtkRenderState*)
  {
    const po::OwnFrames own = po::framesOf(props, renderer, width, height);
    found = this->FindInFrames(
      own, { canShare && own.complete, width, height, po::scaleOf(props) }, !tile, error);
    return error;
  };
  // A process whose part is out of sight may not have been asked to draw it.
  if (canShare && (tile || !po::framesOf(props, renderer, width, height).complete))
  {
    this->DrawAside(state, props, 1, self.Margin, find);
  }
  else
  {
    find(state);
  }
  return found;
}

/// @param whole is it all of a picture, not a tile?
bool vtkDepthSilhouettePass::FindInFrames(
  const po::OwnFrames& own, const po::SilhouetteOffer& offer, bool whole, std::string& error)
{
  Internals& self = *this->Internal;
  const po::ControllerGroup group(self.Controller);
  const auto scale = po::agreedScale(offer, group);
  if (!scale)
  {
    return false;
  }
  const po::SilhouetteRule rule =
    po::resolve(po::silhouetteParametersOf(*this), self.scale(*scale, whole));
  error = po::findTogether(own, rule, group, 0, !self.Actors.empty(), self.Shared);
  this->SharedBytes = static_cast<vtkIdType>(self.Shared.bytes().all());
  return error.empty();
}
