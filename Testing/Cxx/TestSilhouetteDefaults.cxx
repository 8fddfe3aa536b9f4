// SPDX-License-Identifier: BSD-3-Clause
/// One parameter, one name, one default: silhouettes of the view and of the representation, from
/// the server-manager XML over the render pass and the prop to the core.

#include "ParameterTable.h"
#include "SilhouetteParametersOf.h"

#include "vtkDepthSilhouettePass.h"
#include "vtkNew.h"
#include "vtkSphereSilhouettes.h"

#include <gtest/gtest.h>

namespace
{
template <typename Object>
ParameterTable defaultsOf(Object& object, bool visible)
{
  const double* color = object.GetColor();
  return {
    { "SilhouetteVisibility", { visible } },
    { "SilhouetteLineDensity", { object.GetLineDensity() } },
    { "SilhouetteThreshold", { object.GetThreshold() } },
    { "SilhouetteThresholdUnit", { object.GetThresholdUnit() } },
    { "SilhouetteSamples", { object.GetSamples() } },
    { "SilhouetteLineWidth", { object.GetLineWidth() } },
    { "SilhouetteWidthByJump", { object.GetWidthByJump() } },
    { "SilhouetteMaximumLineWidth", { object.GetMaximumLineWidth() } },
    { "SilhouetteGreyByJump", { object.GetGreyByJump() } },
    { "SilhouetteJumpFrom", { object.GetJumpFrom() } },
    { "SilhouetteJumpTo", { object.GetJumpTo() } },
    { "SilhouetteSlopeTest", { object.GetSlopeTest() } },
    { "SilhouetteBackgroundLines", { object.GetBackgroundLines() } },
    { "SilhouetteBackgroundDepth", { object.GetBackgroundDepth() } },
    { "SilhouetteColor", { color[0], color[1], color[2] } },
    { "SilhouetteDarken", { object.GetDarken() } },
    { "SilhouetteOpacity", { object.GetOpacity() } },
  };
}

template <typename Object>
std::string printed(Object& object)
{
  std::ostringstream os;
  po::print(os, "", po::silhouetteParametersOf(object));
  return os.str();
}
}

TEST(SilhouetteDefaults, OfTheViewAgreeWithThePass)
{
  vtkNew<vtkDepthSilhouettePass> pass;
  expectDefaultsOfXml("Views.xml", "RenderViewWithSilhouettes",
    defaultsOf(*pass, pass->GetLineVisibility()), "Silhouette");
}

TEST(SilhouetteDefaults, OfTheRepresentationAgreeWithTheProp)
{
  vtkNew<vtkSphereSilhouettes> prop;
  // The representation asks for no lines until the user does.
  expectDefaultsOfXml(
    "Representations.xml", "RayTracedSphereRepresentation", defaultsOf(*prop, false), "Silhouette");
}

TEST(SilhouetteDefaults, OfThePassAndThePropAgreeWithTheCore)
{
  vtkNew<vtkDepthSilhouettePass> pass;
  vtkNew<vtkSphereSilhouettes> prop;
  std::ostringstream ofCore;
  po::print(ofCore, "", po::SilhouetteParameters());
  EXPECT_EQ(printed(*pass), ofCore.str());
  EXPECT_EQ(printed(*prop), ofCore.str());
}
