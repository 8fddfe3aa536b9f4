// SPDX-License-Identifier: BSD-3-Clause
#include "SharedPicture.h"

#include "ControllerGroup.h"
#include "DrawnProps.h"
#include "RenderState.h"
#include "SphereRenderer.h"
#include "vtkRayTracedSphereMapper.h"

#include "vtkActor.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <new>
#include <stdexcept>

namespace po
{
OwnFrames framesOf(const std::vector<vtkProp*>& props, vtkRenderer* renderer, int width, int height)
{
  OwnFrames own{ {}, cameraOf(renderer, width, height), true };
  for (vtkProp* prop : props)
  {
    auto* actor = vtkActor::SafeDownCast(prop);
    auto* mapper = actor ? vtkRayTracedSphereMapper::SafeDownCast(actor->GetMapper()) : nullptr;
    vtkPolyData* points = mapper && actor->GetVisibility() ? mapper->GetInput() : nullptr;
    if (!points || points->GetNumberOfPoints() == 0)
    {
      continue;
    }
    const TracedActor traced = tracedActorOf(actor, width, height);
    if (traced.renderer && traced.renderer->isCurrent(own.camera, placementOf(actor)))
    {
      own.actors.push_back(traced);
    }
    else
    {
      own.complete = false;
    }
  }
  return own;
}

SilhouetteScale scaleOf(const std::vector<vtkProp*>& props)
{
  return scaleOf(visibleActorsOf(props)).value_or(SilhouetteScale{});
}

std::optional<SilhouetteScale> agreedScale(const SilhouetteOffer& own, const ProcessGroup& group)
{
  constexpr std::size_t Words = 5;
  const auto size =
    static_cast<std::uint64_t>(own.width) << 32U | static_cast<std::uint64_t>(own.height);
  ProcessGroup::Words all;
  try
  {
    all = group.gather({ own.canShare ? 1U : 0U, size, wordOf(own.scale.meanRadius),
      wordOf(own.scale.depthRange), wordOf(own.scale.freeLength) });
  }
  catch (const WorkStopped&)
  {
    return std::nullopt; // for all of them
  }
  SilhouetteScale scale;
  bool agreed = true;
  for (std::size_t at = 0; at < all.size(); at += Words)
  {
    agreed = agreed && all[at] == 1 && all[at + 1] == all[1];
    scale.meanRadius = std::max(scale.meanRadius, doubleOf(all[at + 2]));
    scale.depthRange = std::max(scale.depthRange, doubleOf(all[at + 3]));
    scale.freeLength = std::max(scale.freeLength, doubleOf(all[at + 4]));
  }
  return agreed ? std::optional(scale) : std::nullopt;
}

bool isSoForAll(bool own, const ProcessGroup& group)
{
  try
  {
    return !group.any(!own);
  }
  catch (const WorkStopped&)
  {
    return false; // for all of them
  }
}

std::string runForLines(const ProcessGroup& group, const std::function<void()>& work)
{
  std::string error;
  const auto run = [&]
  {
    try
    {
      work();
    }
    catch (const std::bad_alloc&)
    {
      throw std::runtime_error("Memory ran out for lines of several processes.");
    }
  };
  static_cast<void>(runTogether(group, run, error));
  return error;
}

std::string findTogether(const OwnFrames& own, const SilhouetteRule& rule,
  const ProcessGroup& group, int destination, bool placed, SharedSilhouettes& silhouettes)
{
  return runForLines(group,
    [&] { silhouettes.find(layersOf(own.actors), own.camera, rule, group, destination, placed); });
}

std::string findWithColors(const OwnFrames& own, const SilhouetteRule& rule,
  const ProcessGroup& group, const OwnColors& colors, SharedSilhouettes& silhouettes)
{
  return runForLines(group,
    [&]
    {
      silhouettes.find(layersOf(own.actors), own.camera, rule, group, -1, true);
      silhouettes.shareColors(colors.rgba, colors.all, group);
    });
}
}
