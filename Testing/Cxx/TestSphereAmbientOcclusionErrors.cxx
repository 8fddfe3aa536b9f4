// SPDX-License-Identifier: BSD-3-Clause
// What the filter refuses, and how it ends when it is aborted.
#include "BakeFilterTestSupport.h"

#include "vtkCallbackCommand.h"
#include "vtkFloatArray.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

struct BadInput
{
  const char* name;
  void (*spoil)(vtkSphereAmbientOcclusion*, vtkPolyData*);
  const char* says;
};

void PrintTo(const BadInput& bad, std::ostream* os)
{
  *os << bad.name;
}

class SphereAmbientOcclusionErrors : public testing::TestWithParam<BadInput>
{
};

TEST_P(SphereAmbientOcclusionErrors, NamesWhatIsWrong)
{
  vtkNew<vtkSphereAmbientOcclusion> filter;
  const auto data = lattice(2);
  filter->SetInputData(data);
  GetParam().spoil(filter, data);
  const std::string error = errorOf(filter);
  EXPECT_NE(error.find(GetParam().says), std::string::npos) << "the message was: " << error;
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutput());
  EXPECT_EQ(output->GetNumberOfPoints(), data->GetNumberOfPoints());
  EXPECT_FALSE(output->GetPointData()->HasArray("AmbientOcclusion"));
  EXPECT_FALSE(output->GetFieldData()->HasArray("AmbientOcclusionTextures"));
}

const BadInput BadInputs[] = {
  { "NoPoints", [](auto*, vtkPolyData* d) { d->Initialize(); }, "no points" },
  { "MissingArray", [](auto* f, vtkPolyData*) { f->SetRadiusArray("size"); }, "'size'" },
  { "WrongSize",
    [](auto* f, vtkPolyData* d)
    {
      radiiOf(d)->SetNumberOfTuples(3);
      f->SetRadiusArray("radius");
    },
    "3 values for 8 points" },
  { "Vector",
    [](auto* f, vtkPolyData* d)
    {
      vtkNew<vtkFloatArray> v;
      v->SetName("v");
      v->SetNumberOfComponents(3);
      v->SetNumberOfTuples(8);
      d->GetPointData()->AddArray(v);
      f->SetRadiusArray("v");
    },
    "3 components" },
  { "AllInvalid", [](auto*, vtkPolyData* d) { radiiOf(d)->Fill(-1); }, "No particle is usable" },
  { "ResolutionZero", [](auto* f, vtkPolyData*) { f->SetTextureResolution(0); },
    "TextureResolution must be between 1 and 64" },
  { "ResolutionHuge", [](auto* f, vtkPolyData*) { f->SetTextureResolution(65); },
    "TextureResolution must be between 1 and 64" },
  { "SamplesZero", [](auto* f, vtkPolyData*) { f->SetSamplesPerTexel(0); },
    "SamplesPerTexel must be between" },
  { "SamplesHuge", [](auto* f, vtkPolyData*) { f->SetSamplesPerTexel(2000000); },
    "SamplesPerTexel must be between" },
  { "NegativeDistance", [](auto* f, vtkPolyData*) { f->SetMaximumDistance(-1); },
    "MaximumDistance" },
  { "NaNDistance", [](auto* f, vtkPolyData*) { f->SetMaximumDistance(NaN); }, "MaximumDistance" },
  { "TargetErrorOne", [](auto* f, vtkPolyData*) { f->SetTargetError(1.5); }, "TargetError" },
  { "Threshold", [](auto* f, vtkPolyData*) { f->SetInsideThreshold(-0.1); }, "InsideThreshold" },
  { "Scale", [](auto* f, vtkPolyData*) { f->SetRadiusScale(0); }, "RadiusScale" },
  { "ConstantRadius", [](auto* f, vtkPolyData*) { f->SetConstantRadius(-2); }, "ConstantRadius" },
  { "Seed", [](auto* f, vtkPolyData*) { f->SetSeed(-1); }, "Seed" },
  { "Encoding", [](auto* f, vtkPolyData*) { f->SetEncoding(7); }, "Encoding" },
  { "Method", [](auto* f, vtkPolyData*) { f->SetMethod(4); }, "Method must be between" },
  { "NoBackgroundFile",
    [](auto* f, vtkPolyData*) { f->SetBackground(vtkSphereAmbientOcclusion::Image); },
    "BackgroundImage is empty" },
  { "UnreadableBackground",
    [](auto* f, vtkPolyData*)
    {
      f->SetBackground(vtkSphereAmbientOcclusion::Image);
      f->SetBackgroundImage("no-such-file.exr");
    },
    "no-such-file.exr" },
  { "ZeroUp",
    [](auto* f, vtkPolyData*)
    {
      f->SetBackground(vtkSphereAmbientOcclusion::Gradient);
      f->SetBackgroundUp(0, 0, 0);
    },
    "BackgroundUp" },
};

INSTANTIATE_TEST_SUITE_P(All, SphereAmbientOcclusionErrors, testing::ValuesIn(BadInputs),
  [](const auto& info) { return info.param.name; });

TEST(SphereAmbientOcclusion, RefusesWhatDoesNotFitIntoMemory)
{
  // 64 x 64 texels of 8 bytes each for 20 million particles: more than 600 GiB.
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(20000000);
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    points->SetPoint(i, static_cast<double>(i), 0, 0);
  }
  data->SetPoints(points);
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetInputData(data);
  filter->SetConstantRadius(0.5);
  filter->SetTextureResolution(64);
  filter->SetEncoding(vtkSphereAmbientOcclusion::Float32Linear);
  const std::string error = errorOf(filter);
  EXPECT_NE(error.find("GiB of memory"), std::string::npos) << error;
  EXPECT_NE(error.find("TextureResolution"), std::string::npos) << error;
}

TEST(SphereAmbientOcclusion, AnAbortLeavesNoHalfBake)
{
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetInputData(lattice(12));
  filter->SetTextureResolution(64);
  filter->SetSamplesPerTexel(1000);
  struct State
  {
    double progress = 0;
    int calls = 0;
  } state;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&state);
  command->SetCallback(
    [](vtkObject* caller, unsigned long, void* client, void*)
    {
      auto* seen = static_cast<State*>(client);
      auto* algorithm = vtkAlgorithm::SafeDownCast(caller);
      EXPECT_GE(algorithm->GetProgress(), seen->progress);
      seen->progress = algorithm->GetProgress();
      if (++seen->calls == 4)
      {
        algorithm->SetAbortExecute(1);
      }
    });
  filter->AddObserver(vtkCommand::ProgressEvent, command);
  EXPECT_EQ(errorOf(filter), "");
  EXPECT_GE(state.calls, 4);
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutput());
  EXPECT_FALSE(output->GetPointData()->HasArray("AmbientOcclusion"));
  EXPECT_FALSE(output->GetFieldData()->HasArray("AmbientOcclusionTextures"));
}
}
