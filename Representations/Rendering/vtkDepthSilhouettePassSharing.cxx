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
  std::string error;
  bool found = po::isTile(state->GetRenderer()) && this->FindTogether(state, lines, error);
  this->RenderDelegate(state);
  if (!po::isTile(state->GetRenderer()))
  {
    found = this->FindTogether(state, lines, error);
  }
  const bool isFirst = self.Controller->GetLocalProcessId() == 0;
  if (found)
  {
    const po::PlacedLines& shared = self.Shared.lines();
    const float* depth = self.Actors.empty() ? nullptr : shared.windowDepth.data();
    return isFirst ? this->DrawLines(state, shared.image, { nullptr, nullptr, depth }) : "";
  }
  if (lines && isFirst && error.empty() && self.Actors.empty())
  {
    error = this->FindInZBuffer(state, 1, 0);
    return error.empty() ? this->DrawLines(state, self.Lines, {}) : error;
  }
  return error;
}

/// Finds the lines of ray-traced spheres of all processes, if all can take part; else returns
/// false.
bool vtkDepthSilhouettePass::FindTogether(
  const vtkRenderState* state, bool lines, std::string& error)
{
  Internals& self = *this->Internal;
  const bool tile = po::isTile(state->GetRenderer());
  const po::SilhouetteViewport viewport = po::viewportOf(state);
  self.Margin = tile ? po::tileMarginOf(po::silhouetteParametersOf(*this)) : 0;
  const int width = viewport.width + 2 * self.Margin, height = viewport.height + 2 * self.Margin;
  const std::vector<vtkProp*> props = self.Actors.empty()
    ? po::deepPropsOf(state)
    : std::vector<vtkProp*>(self.Actors.begin(), self.Actors.end());
  const po::ControllerGroup group(self.Controller);
  bool found = false;
  const auto find = [&](const vtkRenderState*)
  {
    const po::OwnFrames own = po::framesOf(props, state->GetRenderer(), width, height);
    const bool canShare = lines && own.complete && po::hasOnlySpheres(props);
    const auto scale =
      po::agreedScale({ canShare, width, height,
                        po::scaleOf(po::visibleActorsOf(props)).value_or(po::SilhouetteScale{}) },
        group);
    if (scale)
    {
      const po::SilhouetteRule rule =
        po::resolve(po::silhouetteParametersOf(*this), self.scale(*scale, !tile));
      error = po::findTogether(own, rule, group, 0, self.Shared);
      this->SharedBytes = static_cast<vtkIdType>(self.Shared.bytes().all());
      found = error.empty();
    }
    return std::string();
  };
  // A process whose part is out of sight may not have been asked to draw it.
  const bool draws = lines && po::hasOnlySpheres(props) &&
    (tile || !po::framesOf(props, state->GetRenderer(), width, height).complete);
  if (draws)
  {
    this->DrawAside(state, props, 1, self.Margin, find);
  }
  else
  {
    find(state);
  }
  return found;
}
