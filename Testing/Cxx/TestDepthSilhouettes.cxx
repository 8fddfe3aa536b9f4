// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthSilhouettes.h"
#include "vtkZBufferToDepth.h"

#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace
{
constexpr float Infinity = std::numeric_limits<float>::infinity();

/// Keeps what an algorithm reports instead of printing it.
class ErrorCatcher : public vtkCommand
{
public:
  static ErrorCatcher* New() { return new ErrorCatcher; }
  void Execute(vtkObject*, unsigned long, void* text) override
  {
    messages += static_cast<const char*>(text);
  }
  std::string messages;
};

template <typename Array>
vtkSmartPointer<Array> addArray(vtkImageData* image, const char* name, int components)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  array->Fill(1.0);
  image->GetPointData()->AddArray(array);
  return array;
}

/// An image whose extent does not start at 0, with a disc before the background in array Z and a
/// step at column 10 of its own; a second slice is a hundred times as deep.
vtkSmartPointer<vtkImageData> makeImage(int slices)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(-3, 60, 5, 54, 2, 1 + slices);
  auto z = addArray<vtkFloatArray>(image, "Z", 1);
  vtkIdType pixel = 0;
  for (int k = 0; k < slices; ++k)
  {
    for (int j = 0; j < 50; ++j)
    {
      for (int i = 0; i < 64; ++i)
      {
        const bool disc = (i - 30) * (i - 30) + (j - 25) * (j - 25) < 20 * 20;
        z->SetValue(pixel++, disc ? (i < 30 ? 5.0F : 6.0F) * (k ? 100.0F : 1.0F) : Infinity);
      }
    }
  }
  return image;
}

std::vector<float> values(vtkImageData* image)
{
  auto* array = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray("Silhouette"));
  if (!array)
  {
    return {};
  }
  return { array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfTuples() };
}

std::string errorOf(vtkAlgorithm* filter)
{
  vtkNew<ErrorCatcher> own;
  vtkNew<ErrorCatcher> executive;
  filter->AddObserver(vtkCommand::ErrorEvent, own);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executive);
  filter->Update();
  return own->messages;
}
}

TEST(DepthSilhouettes, AddsTheLineToTheInputsArrays)
{
  const auto image = makeImage(1);
  addArray<vtkUnsignedCharArray>(image, "RGBA", 4);
  image->GetPointData()->SetActiveScalars("RGBA");
  vtkNew<vtkDepthSilhouettes> filter;
  filter->SetInputData(image);
  filter->Update();

  vtkImageData* output = filter->GetOutput();
  EXPECT_TRUE(output->GetPointData()->HasArray("Z"));
  EXPECT_TRUE(output->GetPointData()->HasArray("RGBA"));
  EXPECT_STREQ(output->GetPointData()->GetScalars()->GetName(), "Silhouette");
  const std::vector<float> line = values(output);
  for (int i = 0; i < 64; ++i)
  {
    // Row 25 crosses the disc (columns 11 to 49) and the step inside it.
    EXPECT_EQ(line[25 * 64 + i], i == 10 || i == 30 || i == 50 ? 1.0F : 0.0F) << "column " << i;
  }
  EXPECT_STREQ(image->GetPointData()->GetScalars()->GetName(), "RGBA");
}

TEST(DepthSilhouettes, SlicesAreIndependent)
{
  vtkNew<vtkDepthSilhouettes> filter;
  filter->SetInputData(makeImage(1));
  filter->Update();
  const std::vector<float> single = values(filter->GetOutput());
  filter->SetInputData(makeImage(2));
  filter->Update();
  const std::vector<float> both = values(filter->GetOutput());
  ASSERT_EQ(both.size(), 2 * single.size());
  EXPECT_TRUE(std::equal(single.begin(), single.end(), both.begin()));
  EXPECT_TRUE(std::equal(single.begin(), single.end(), both.begin() + single.size()));
}

TEST(DepthSilhouettes, SeveralSamplesAPixelGiveASmallerImage)
{
  vtkNew<vtkDepthSilhouettes> filter;
  filter->SetInputData(makeImage(2));
  filter->SetSamples(2);
  filter->Update();
  vtkImageData* output = filter->GetOutput();
  int size[3];
  output->GetDimensions(size);
  EXPECT_EQ(size[0], 32);
  EXPECT_EQ(size[1], 25);
  EXPECT_EQ(size[2], 2);
  EXPECT_EQ(output->GetSpacing()[0], 2);
  EXPECT_EQ(output->GetOrigin()[0], -3 + 0.5);
  EXPECT_FALSE(output->GetPointData()->HasArray("Z"));
  const std::vector<float> line = values(output);
  const auto partly =
    std::count_if(line.begin(), line.end(), [](float value) { return value > 0 && value < 1; });
  EXPECT_GT(partly, 50);
}

TEST(DepthSilhouettes, TakesTheChosenArray)
{
  const auto image = makeImage(1);
  auto flat = addArray<vtkDoubleArray>(image, "flat", 1);
  vtkNew<vtkDepthSilhouettes> filter;
  filter->SetInputData(image);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "flat");
  filter->Update();
  EXPECT_EQ(values(filter->GetOutput()), std::vector<float>(64 * 50, 0.0F));
}

TEST(DepthSilhouettes, WithoutAChoiceTakesTheActiveScalarsBeforeZ)
{
  const auto image = makeImage(1);
  addArray<vtkDoubleArray>(image, "flat", 1);
  image->GetPointData()->SetActiveScalars("flat");
  for (const char* choice : { static_cast<const char*>(nullptr), "" })
  {
    vtkNew<vtkDepthSilhouettes> filter;
    filter->SetInputData(image);
    if (choice)
    {
      filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, choice);
    }
    filter->Update();
    EXPECT_EQ(values(filter->GetOutput()), std::vector<float>(64 * 50, 0.0F));
  }
}

TEST(DepthSilhouettes, Errors)
{
  const auto image = makeImage(1);
  addArray<vtkFloatArray>(image, "normals", 3);
  addArray<vtkUnsignedCharArray>(image, "bytes", 1);
  vtkNew<vtkDepthSilhouettes> filter;
  filter->SetInputData(image);
  for (const char* name : { "normals", "bytes", "missing" })
  {
    filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, name);
    EXPECT_NE(errorOf(filter).find(name), std::string::npos) << name;
    EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("Silhouette"));
  }
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Z");
  filter->SetThreshold(-1.0);
  EXPECT_NE(errorOf(filter).find("Threshold"), std::string::npos);
  filter->SetThreshold(1.0);
  filter->SetBackgroundDepth(std::numeric_limits<double>::quiet_NaN());
  EXPECT_NE(errorOf(filter).find("BackgroundDepth"), std::string::npos);

  filter->SetBackgroundDepth(0);
  filter->SetThresholdUnit(1);
  EXPECT_NE(errorOf(filter).find("ParticleRadius"), std::string::npos);
  filter->SetThresholdUnit(0);
  filter->SetSamples(4); // 64 x 50
  EXPECT_NE(errorOf(filter).find("multiple of Samples"), std::string::npos);

  vtkNew<vtkImageData> empty;
  empty->SetDimensions(4, 4, 1);
  vtkNew<vtkDepthSilhouettes> without;
  without->SetInputData(empty);
  EXPECT_NE(errorOf(without).find("no depth array"), std::string::npos);
}

TEST(ZBufferToDepth, ConvertsAndReportsWhatIsMissing)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 2, 1);
  auto z = addArray<vtkFloatArray>(image, "ImageScalars", 1);
  z->Fill(0.5);
  z->SetValue(4, 1.0F);
  vtkNew<vtkZBufferToDepth> filter;
  filter->SetInputData(image);
  EXPECT_NE(errorOf(filter).find("scalars"), std::string::npos);

  image->GetPointData()->SetActiveScalars("ImageScalars");
  image->Modified();
  EXPECT_NE(errorOf(filter).find("ProjectionMatrix"), std::string::npos);

  // Parallel projection from near = 1 to far = 3.
  vtkNew<vtkMatrix4x4> projection;
  projection->SetElement(2, 2, -1.0);
  projection->SetElement(2, 3, -2.0);
  filter->SetProjectionMatrix(projection);
  filter->Update();
  auto* depth = vtkFloatArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetArray("Z"));
  ASSERT_TRUE(depth);
  EXPECT_FLOAT_EQ(depth->GetValue(0), 2.0F);
  EXPECT_EQ(depth->GetValue(4), Infinity);
}
