// SPDX-License-Identifier: BSD-3-Clause
// Points that were gathered from the blocks of a composite data set: looks of blocks, selection.
// Real windows: these tests need a display with OpenGL, Xvfb for instance.
#include "BlockTable.h"
#include "RayTracedSphereTestScene.h"

#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

#include <gtest/gtest.h>

namespace
{
/// Blocks 2 and 5 with two spheres each, in a row along x.
struct Blocks : Scene
{
  Blocks()
    : Scene({ { 0, 0, 0, 1 }, { 3, 0, 0, 1 }, { 6, 0, 0, 1 }, { 9, 0, 0, 1 } }, 240, 60)
  {
    po::setBlockTable(*mapper->GetInput(), { { 2, 0 }, { 5, 2 } });
    makeFlat(1, 0, 0);
    renderer->ResetCamera();
    window->Render();
  }

  /// Colours in the middles of the four spheres.
  std::vector<Pixel> colors()
  {
    const Picture picture = grab(window);
    std::vector<Pixel> result;
    for (int i = 0; i < 4; ++i)
    {
      const auto [x, y] = middleOf(i);
      result.push_back(picture.at(x, y));
    }
    return result;
  }

  /// The pixel of a sphere's middle.
  std::array<int, 2> middleOf(int sphere)
  {
    renderer->SetWorldPoint(3 * sphere, 0, 0, 1);
    renderer->WorldToDisplay();
    const double* p = renderer->GetDisplayPoint();
    return { static_cast<int>(p[0]), static_cast<int>(p[1]) };
  }
};

constexpr Pixel Black{ 0, 0, 0 }, Red{ 255, 0, 0 }, Blue{ 0, 0, 255 };

TEST(RayTracedSphereBlocks, HaveColoursAndVisibilityOfTheirOwn)
{
  Blocks scene;
  EXPECT_EQ(scene.colors(), (std::vector<Pixel>{ Red, Red, Red, Red }));
  scene.mapper->SetBlockColor(5, 0, 0, 1);
  EXPECT_EQ(scene.colors(), (std::vector<Pixel>{ Red, Red, Blue, Blue }));
  scene.mapper->SetBlockVisibility(2, false);
  EXPECT_EQ(scene.colors(), (std::vector<Pixel>{ Black, Black, Blue, Blue }));
  EXPECT_EQ(scene.mapper->GetNumberOfShownSpheres(), 2);
  scene.mapper->RemoveAllBlockStyles();
  scene.mapper->SetBlockOpacity(2, 0.5);
  EXPECT_NEAR(scene.colors()[0][0], 127, 2);
  EXPECT_EQ(scene.colors()[3], Red);
  scene.mapper->RemoveAllBlockStyles();
  EXPECT_EQ(scene.colors(), (std::vector<Pixel>{ Red, Red, Red, Red }));
}

TEST(RayTracedSphereBlocks, SelectionNamesTheBlockAndThePointInIt)
{
  Blocks scene;
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.renderer);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
  const auto [x, y] = scene.middleOf(3);
  selector->SetArea(x - 1, y - 1, x + 1, y + 1);
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  ASSERT_EQ(selection->GetNumberOfNodes(), 1u);
  vtkSelectionNode* node = selection->GetNode(0);
  EXPECT_EQ(node->GetProperties()->Get(vtkSelectionNode::COMPOSITE_INDEX()), 5);
  auto* ids = vtkIdTypeArray::SafeDownCast(node->GetSelectionList());
  ASSERT_EQ(ids->GetNumberOfTuples(), 1);
  EXPECT_EQ(ids->GetValue(0), 1);
}

TEST(RayTracedSphereBlocks, TranslucentAndSmoothSpheresAreSelectedLikeOthers)
{
  for (const bool translucent : { true, false })
  {
    Blocks scene;
    scene.actor->GetProperty()->SetOpacity(translucent ? 0.3 : 1);
    scene.mapper->SetSamplesPerPixel(4);
    const Picture before = grab(scene.window);
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(scene.renderer);
    selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
    selector->SetArea(0, 0, 239, 59);
    const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
    ASSERT_EQ(selection->GetNumberOfNodes(), 2u) << translucent;
    for (unsigned i = 0; i < 2; ++i)
    {
      EXPECT_EQ(selection->GetNode(i)->GetSelectionList()->GetNumberOfTuples(), 2) << translucent;
    }
    EXPECT_EQ(differingShare(grab(scene.window), before, 0), 0) << "the picture is as before";
  }
}
}
