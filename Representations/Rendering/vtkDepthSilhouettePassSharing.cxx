// SPDX-License-Identifier: BSD-3-Clause
// Pictures that are composited from those of several processes.
#include "ControllerGroup.h"
#include "DividedImage.h"
#include "DrawnProps.h"
#include "SharedPicture.h"
#include "SilhouetteParametersOf.h"
#include "vtkDepthSilhouettePassInternals.h"

#include "vtkRenderer.h"

#include <stdexcept>

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
  const po::ControllerGroup group(self.Controller);
  // Right after a picture of tiles some processes still take a coarse one for a tile.
  const bool agreed = po::isSoForAll(tile, group) || po::isSoForAll(!tile, group);
  std::string error;
  bool found = agreed && tile && this->FindTogether(state, lines, error);
  this->RenderDelegate(state);
  if (agreed && !tile)
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

/// Finds the lines of all processes, if all can take part; else returns false.
bool vtkDepthSilhouettePass::FindTogether(
  const vtkRenderState* state, bool lines, std::string& error)
{
  Internals& self = *this->Internal;
  const po::ControllerGroup group(self.Controller);
  if (!po::isSoForAll(lines, group))
  {
    return false;
  }
  const bool tile = po::isTile(state->GetRenderer());
  self.Margin = tile ? po::tileMarginOf(po::silhouetteParametersOf(*this)) : 0;
  std::vector<vtkProp*> props = po::deepPropsOf(state);
  if (!self.Actors.empty())
  {
    props.assign(self.Actors.begin(), self.Actors.end());
  }
  const bool spheres = po::isSoForAll(po::hasOnlySpheres(props), group);
  if (spheres && (this->FindInFrames(state, props, error) || !error.empty()))
  {
    return error.empty();
  }
  const int samples = spheres ? 1 : this->Samples;
  // The composited z-buffer has all of a whole picture, one sample a pixel.
  const bool isNeeded = samples > 1 || tile || !self.Actors.empty() || this->OrderedCompositing;
  return isNeeded && this->FindInZBuffers(state, props, samples, error);
}

/// Finds the lines in traced frames, if all processes have one of all their spheres.
bool vtkDepthSilhouettePass::FindInFrames(
  const vtkRenderState* state, const std::vector<vtkProp*>& props, std::string& error)
{
  Internals& self = *this->Internal;
  vtkRenderer* renderer = state->GetRenderer();
  const bool tile = po::isTile(renderer);
  const po::SilhouetteViewport viewport = po::viewportOf(state);
  const int width = viewport.width + 2 * self.Margin, height = viewport.height + 2 * self.Margin;
  const po::ControllerGroup group(self.Controller);
  bool found = false;
  const auto find = [&](const vtkRenderState*)
  {
    const po::OwnFrames own = po::framesOf(props, renderer, width, height);
    const auto scale = po::agreedScale({ own.complete, width, height, po::scaleOf(props) }, group);
    if (scale)
    {
      const po::SilhouetteRule rule =
        po::resolve(po::silhouetteParametersOf(*this), self.scale(*scale, !tile));
      error = po::findTogether(own, rule, group, 0, !self.Actors.empty(), self.Shared);
      this->SharedBytes = static_cast<vtkIdType>(self.Shared.bytes().all());
      found = error.empty();
    }
    return error;
  };
  // A process whose part is out of sight may not have been asked to draw it.
  if (tile || !po::framesOf(props, renderer, width, height).complete)
  {
    this->DrawAside(state, props, 1, self.Margin, find);
  }
  else
  {
    find(state);
  }
  return found;
}

/// Finds the lines in z-buffers of all processes, of that many samples a pixel or less, if all can
/// read theirs.
bool vtkDepthSilhouettePass::FindInZBuffers(
  const vtkRenderState* state, const std::vector<vtkProp*>& props, int samples, std::string& error)
{
  Internals& self = *this->Internal;
  const po::SilhouetteViewport viewport = po::viewportOf(state);
  samples = po::samplesThatFit(
    samples, viewport.width + 2 * self.Margin, viewport.height + 2 * self.Margin);
  const po::ControllerGroup group(self.Controller);
  bool found = false;
  const auto find = [&](const vtkRenderState* inside)
  {
    const po::SilhouetteViewport frame = po::viewportOf(inside);
    std::string fault = self.Painter.readDepth(po::windowOf(inside), frame, self.ZBuffer);
    const auto scale =
      po::agreedScale({ fault.empty(), frame.width, frame.height,
                        po::scaleOf(self.Actors.empty() ? po::propsOf(state) : props) },
        group);
    if (scale)
    {
      const po::ZBuffer own{ self.ZBuffer, frame.width, frame.height, samples,
        *po::windowToEyeOf(inside->GetRenderer()) };
      fault = po::runForLines(group, [&] { this->FindInZBuffer(own, *scale); });
      found = fault.empty();
    }
    return fault;
  };
  error = this->DrawAside(state, props, samples, self.Margin, find);
  return found;
}

/// @param scale of the spheres, zeros if there are none
void vtkDepthSilhouettePass::FindInZBuffer(const po::ZBuffer& own, po::SilhouetteScale scale)
{
  Internals& self = *this->Internal;
  const po::ControllerGroup group(self.Controller);
  po::DividedImage image(own, self.Distances);
  const bool hasSpheres = scale.meanRadius > 0 || scale.depthRange > 0;
  if (this->ThresholdUnit != 0 && !hasSpheres)
  {
    throw std::runtime_error(po::NoSpheresForRadii);
  }
  std::size_t bytes = 0;
  if (!hasSpheres)
  {
    scale.depthRange = self.Shared.depthSpread(image, group);
    bytes = self.Shared.bytes().all();
  }
  po::SilhouetteParameters parameters = po::silhouetteParametersOf(*this);
  parameters.samples = own.samples;
  const bool whole = self.Margin == 0;
  self.Shared.find(
    image, po::resolve(parameters, self.scale(scale, whole)), group, 0, !self.Actors.empty());
  this->SharedBytes = static_cast<vtkIdType>(bytes + self.Shared.bytes().all());
}
