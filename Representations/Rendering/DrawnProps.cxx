// SPDX-License-Identifier: BSD-3-Clause
#include "DrawnProps.h"

#include "vtkRayTracedSphereMapper.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkMath.h"
#include "vtkRenderState.h"

#include <algorithm>

namespace po
{
namespace
{
/// As the surface of a representation is that shows nothing.
bool isEmpty(vtkProp* prop)
{
  const double* bounds = prop->GetBounds();
  return bounds && !vtkMath::AreBoundsInitialized(bounds);
}

/// Does a prop write depth?
bool isDeep(vtkProp* prop)
{
  return prop->GetVisibility() && !vtkActor2D::SafeDownCast(prop) && prop->HasOpaqueGeometry() &&
    !isEmpty(prop);
}
}

std::vector<vtkProp*> propsOf(const vtkRenderState* state)
{
  return { state->GetPropArray(), state->GetPropArray() + state->GetPropArrayCount() };
}

std::vector<vtkProp*> deepPropsOf(const vtkRenderState* state)
{
  std::vector<vtkProp*> props = propsOf(state);
  props.erase(
    std::remove_if(props.begin(), props.end(), [](vtkProp* prop) { return !isDeep(prop); }),
    props.end());
  return props;
}

std::vector<vtkActor*> visibleActorsOf(const std::vector<vtkProp*>& props)
{
  std::vector<vtkActor*> actors;
  for (vtkProp* prop : props)
  {
    auto* actor = vtkActor::SafeDownCast(prop);
    if (actor && actor->GetVisibility())
    {
      actors.push_back(actor);
    }
  }
  return actors;
}

bool hasOnlySpheres(const std::vector<vtkProp*>& props)
{
  const auto isSpheres = [](vtkProp* prop)
  {
    auto* actor = vtkActor::SafeDownCast(prop);
    return actor && vtkRayTracedSphereMapper::SafeDownCast(actor->GetMapper());
  };
  return std::all_of(
    props.begin(), props.end(), [&](vtkProp* prop) { return !isDeep(prop) || isSpheres(prop); });
}

std::vector<TracedActor> tracedActorsOf(const vtkRenderState* state, int width, int height)
{
  std::vector<TracedActor> traced;
  const std::vector<vtkProp*> props = propsOf(state);
  for (vtkActor* actor : visibleActorsOf(props))
  {
    const TracedActor one = tracedActorOf(actor, width, height);
    if (one.renderer)
    {
      traced.push_back(one);
    }
  }
  const auto deep = std::count_if(props.begin(), props.end(), isDeep);
  return deep == static_cast<std::ptrdiff_t>(traced.size()) ? traced : std::vector<TracedActor>{};
}

OpaqueActors::OpaqueActors(const std::vector<vtkSmartPointer<vtkActor>>& actors)
{
  for (const auto& actor : actors)
  {
    if (!actor->GetForceOpaque())
    {
      actor->ForceOpaqueOn();
      forced_.push_back(actor);
    }
  }
}

OpaqueActors::~OpaqueActors()
{
  for (const auto& actor : forced_)
  {
    actor->ForceOpaqueOff();
  }
}
}
