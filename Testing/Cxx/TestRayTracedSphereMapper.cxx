// SPDX-License-Identifier: BSD-3-Clause
// What the mapper keeps, answers and reports.
// Real windows: these tests need a display with OpenGL, Xvfb for instance.
#include "MemoryGrowth.h"
#include "ParameterTable.h"
#include "RayTracedSphereTestScene.h"
#include "VTKErrors.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkDepthSilhouettePass.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkRenderStepsPass.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace
{
TEST(RayTracedSphereMapper, TracesOnlyWhenTheViewOrTheSpheresChange)
{
  Scene scene(lattice(3));
  scene.mapper->ShadowsOn();
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 1);
  EXPECT_GT(scene.mapper->GetNumberOfShadowRays(), 0);
  const vtkIdType shadows = scene.mapper->GetNumberOfTracedShadows();
  EXPECT_EQ(shadows, 1);
  const Picture before = grab(scene.window);

  scene.actor->GetProperty()->SetColor(1, 0, 0);
  scene.mapper->SetShadingMode(vtkRayTracedSphereMapper::DIRECT_LIGHT);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 1);
  EXPECT_EQ(scene.mapper->GetNumberOfTracedShadows(), shadows) << "the light stayed where it was";
  EXPECT_GT(differingShare(before, grab(scene.window)), 0.1);

  vtkNew<vtkLight> light;
  light->SetPosition(5, 8, 9);
  scene.renderer->AddLight(light);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 1);
  EXPECT_EQ(scene.mapper->GetNumberOfTracedShadows(), shadows + 1) << "only the new light's";

  scene.renderer->GetActiveCamera()->Azimuth(5);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 2);
  scene.mapper->SetRadiusScale(0.5);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 3);
  scene.window->SetSize(90, 80);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 4);
  scene.actor->SetScale(1, 2, 1);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetNumberOfTracedFrames(), 5);
}

TEST(RayTracedSphereMapper, LayersDescribeTheFrame)
{
  Scene scene({ { 0, 0, 0, 1 } }, 41, 41);
  WarningCatcher warnings(scene.mapper);
  scene.mapper->SetInputData(makeBalls({ { 0, 0, 0, -1 }, { 0, 0, 0, 1 } }));
  scene.window->Render();
  EXPECT_EQ(warnings.count(), 1) << "one sphere has a negative radius";
  const double distance = scene.renderer->GetActiveCamera()->GetDistance();
  const vtkIdType middle = 20 * 41 + 20;
  ASSERT_EQ(scene.mapper->GetLayers()->GetNumberOfPoints(), 41 * 41);
  EXPECT_EQ(layer(scene, "id")->GetComponent(middle, 0), 1);
  EXPECT_EQ(layer(scene, "id")->GetComponent(0, 0), -1);
  EXPECT_NEAR(layer(scene, "Z")->GetComponent(middle, 0), distance - 1, 1e-4);
  EXPECT_TRUE(std::isinf(layer(scene, "Z")->GetComponent(0, 0)));
  EXPECT_NEAR(layer(scene, "N")->GetComponent(middle, 2), 1, 1e-4);
  EXPECT_EQ(layer(scene, "AO")->GetComponent(middle, 0), 1);
  EXPECT_EQ(layer(scene, "RGBA")->GetComponent(middle, 3), 255);
  EXPECT_EQ(layer(scene, "RGBA")->GetComponent(0, 3), 0);
}

TEST(RayTracedSphereMapper, BoundsIncludeTheRadii)
{
  Scene scene({ { 1, 2, 3, 0.5 }, { 4, 2, 3, 2 } });
  double bounds[6];
  scene.mapper->GetBounds(bounds);
  const double expected[6] = { 0.5, 6, 0, 4, 1, 5 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], expected[i], 1e-5);
  }
}

TEST(RayTracedSphereMapper, PointsAreSelectedByTheSphereUnderThePixel)
{
  Scene scene({ { 0, 0, 0, 1 }, { 3, 0, 0, 1 } }, 200, 100);
  scene.window->Render();
  for (const int association :
    { vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataObject::FIELD_ASSOCIATION_CELLS })
  {
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(scene.renderer);
    selector->SetFieldAssociation(association);
    selector->SetArea(110, 10, 199, 90);
    const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
    ASSERT_EQ(selection->GetNumberOfNodes(), 1u);
    auto* ids = vtkIdTypeArray::SafeDownCast(selection->GetNode(0)->GetSelectionList());
    ASSERT_EQ(ids->GetNumberOfTuples(), 1);
    EXPECT_EQ(ids->GetValue(0), 1);
  }
}

TEST(RayTracedSphereMapper, MistakesGiveOneMessageAndNoCrash)
{
  Scene scene({ { 0, 0, 0, 1 } });
  ErrorCatcher errors(scene.mapper);
  WarningCatcher warnings(scene.mapper);
  scene.mapper->SetRadiusArray("nothing");
  scene.window->Render();
  scene.window->Render();
  ASSERT_EQ(errors.count(), 1);
  EXPECT_NE(errors.text().find("nothing"), std::string::npos);
  EXPECT_NE(errors.text().find("radius"), std::string::npos) << "lists what there is";

  scene.mapper->SetRadiusArray(nullptr);
  auto baked = makeBalls({ { 0, 0, 0, 1 } });
  bakeConstant(baked, 180);
  baked->GetPointData()->GetArray("AmbientOcclusionTexture")->SetComponent(0, 0, 7);
  scene.mapper->SetInputData(baked);
  const Picture picture = grab(scene.window);
  ASSERT_EQ(warnings.count(), 1);
  EXPECT_NE(warnings.text().find("AmbientOcclusionTexture"), std::string::npos);
  EXPECT_GT(picture.at(80, 60)[0], 200) << "drawn without occlusion";

  scene.mapper->SetInputData(vtkSmartPointer<vtkPolyData>::New());
  scene.window->Render();
  EXPECT_EQ(errors.count(), 1) << "nothing to draw is no mistake";
  EXPECT_EQ(scene.mapper->GetLayers()->GetNumberOfPoints(), 0);
}

TEST(RayTracedSphereMapper, WindowsAndResourcesComeAndGo)
{
  Scene scene(lattice(2), 50, 40);
  const Picture first = grab(scene.window);
  scene.window->Finalize();
  EXPECT_EQ(differingShare(first, grab(scene.window)), 0);
  scene.window->SetMultiSamples(4);
  scene.window->SetSize(1, 1);
  scene.window->Render();
  scene.window->SetSize(50, 40);
  scene.window->SetMultiSamples(0);
  EXPECT_EQ(differingShare(first, grab(scene.window)), 0);
}

TEST(RayTracedSphereMapper, DefaultsAreThoseOfTheXml)
{
  const auto root = vtk::TakeSmartPointer(
    vtkXMLUtilities::ReadElementFromFile(PLUGIN_XML_DIR "/Representations.xml"));
  ASSERT_TRUE(root);
  vtkXMLDataElement* proxy = findProxy(root, "RayTracedSphereRepresentation");
  ASSERT_TRUE(proxy);
  vtkNew<vtkRayTracedSphereMapper> mapper;
  const std::map<std::string, double> defaults{
    { "RadiusScale", mapper->GetRadiusScale() },
    { "ConstantRadius", mapper->GetConstantRadius() },
    { "RadiusFrom", mapper->GetRadiusFrom() },
    { "Density", mapper->GetDensity() },
    { "ShadingMode", mapper->GetShadingMode() },
    { "OcclusionOnDiffuse", mapper->GetOcclusionOnDiffuse() },
    { "Shadows", mapper->GetShadows() },
    { "SamplesPerPixel", mapper->GetSamplesPerPixel() },
    { "InteractiveRate", mapper->GetInteractiveRate() },
    { "TextureBudget", mapper->GetTextureBudget() },
  };
  for (const auto& [name, value] : defaults)
  {
    vtkXMLDataElement* property = nullptr;
    for (int i = 0; i < proxy->GetNumberOfNestedElements(); ++i)
    {
      vtkXMLDataElement* element = proxy->GetNestedElement(i);
      const char* own = element->GetAttribute("name");
      property = own && own == name ? element : property;
    }
    ASSERT_TRUE(property) << name;
    double inXml = -1;
    EXPECT_EQ(property->GetScalarAttribute("default_values", inXml), 1) << name;
    EXPECT_EQ(inXml, value) << name;
    EXPECT_EQ(property->GetAttribute("command"), "Set" + name);
  }
}

/// Spheres whose number and arrays change every time the pipeline is asked: in the midst of a
/// render.
class Restless : public vtkPolyDataAlgorithm
{
public:
  static Restless* New();
  vtkTypeMacro(Restless, vtkPolyDataAlgorithm);
  int executions = 0;

protected:
  Restless() { this->SetNumberOfInputPorts(0); }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override
  {
    auto data = makeBalls(lattice(1 + executions % 4));
    bakeConstant(data, static_cast<unsigned char>(100 + executions % 100));
    if (executions % 3 == 1)
    {
      data->GetPointData()->RemoveArray(executions % 2 ? "value" : "radius");
    }
    if (executions % 5 == 4)
    {
      data->Initialize();
    }
    vtkPolyData::GetData(output)->ShallowCopy(data);
    ++executions;
    return 1;
  }
};
vtkStandardNewMacro(Restless);

TEST(RayTracedSphereMapper, DataMayChangeWhileItRenders)
{
  Scene scene(lattice(2), 60, 50);
  vtkNew<Restless> source;
  scene.mapper->SetInputConnection(source->GetOutputPort());
  scene.mapper->ScalarVisibilityOn();
  scene.mapper->SetScalarModeToUsePointFieldData();
  scene.mapper->SelectColorArray("value");
  ErrorCatcher errors(scene.mapper); // of arrays that have gone
  vtkNew<vtkCallbackCommand> change;
  change->SetClientData(source);
  change->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { static_cast<Restless*>(data)->Modified(); });
  // Before the bounds are known, between the bounds and the spheres, after the frame.
  scene.renderer->AddObserver(vtkCommand::StartEvent, change);
  scene.renderer->AddObserver(vtkCommand::ResetCameraClippingRangeEvent, change);
  scene.renderer->AddObserver(vtkCommand::EndEvent, change);
  scene.window->AddObserver(vtkCommand::StartEvent, change);
  for (int i = 0; i < 40; ++i)
  {
    scene.renderer->ResetCameraClippingRange();
    scene.window->Render();
    scene.mapper->GetLayers();
  }
  EXPECT_GE(source->executions, 40);

  scene.renderer->RemoveAllObservers();
  scene.window->RemoveAllObservers();
  scene.mapper->ScalarVisibilityOff();
  scene.mapper->SetInputData(makeBalls(lattice(2)));
  scene.renderer->ResetCamera();
  Scene fresh(lattice(2), 60, 50);
  EXPECT_EQ(differingShare(grab(scene.window), grab(fresh.window)), 0);
}

TEST(RayTracedSphereMapper, ArraysMayShrinkUnderTheFrame)
{
  Scene scene(lattice(3), 60, 50);
  auto baked = makeBalls(lattice(3));
  bakeConstant(baked, 100);
  scene.mapper->SetInputData(baked);
  scene.window->Render();
  // The spheres are still the old ones when these arrays are gone.
  baked->GetPointData()->GetArray("AmbientOcclusionTexture")->SetNumberOfTuples(1);
  baked->GetFieldData()->GetArray("AmbientOcclusionTextures")->SetNumberOfTuples(0);
  baked->GetPointData()->GetArray("AmbientOcclusionTexture")->Modified();
  WarningCatcher warnings(scene.mapper);
  scene.actor->GetProperty()->SetColor(1, 0, 0);
  scene.window->Render();
  EXPECT_EQ(warnings.count(), 1);
  baked->GetPointData()->GetArray("radius")->SetNumberOfTuples(2);
  baked->GetPointData()->GetArray("radius")->Modified();
  ErrorCatcher errors(scene.mapper);
  scene.window->Render();
  EXPECT_EQ(errors.count(), 1);
}

TEST(RayTracedSphereMapper, AThousandSizesReachAPlateauOfMemory)
{
  Scene scene(lattice(3));
  vtkNew<vtkDepthSilhouettePass> lines;
  scene.renderer->SetPass(lines);
  vtkNew<vtkRenderStepsPass> steps;
  lines->SetDelegatePass(steps);
  const double growth = growthOver(1000, 300,
    [&](int i)
    {
      scene.window->SetSize(20 + 37 * i % 100, 20 + 53 * i % 90);
      scene.window->Render();
    });
  constexpr double LargestGrowth = 8; // megabytes; a frame of the least size takes 20 kB
  EXPECT_GE(scene.mapper->GetNumberOfTracedFrames(), 1000) << "every size is a new frame";
  EXPECT_LT(growth, LargestGrowth);
}
}
