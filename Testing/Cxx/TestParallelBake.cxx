// SPDX-License-Identifier: BSD-3-Clause
// Several processes bake one set: each result is compared with a bake of the whole set by one
// process alone. Run by mpiexec with any number of processes.

#include "BakedTextures.h"
#include "ParallelBakeTestSupport.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkMPIController.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace
{
class ParallelBake : public testing::TestWithParam<int>
{
};

TEST_P(ParallelBake, SameBitsHoweverTheParticlesAreDistributed)
{
  const auto whole = mixedCloud(600);
  const auto prepare = [](vtkSphereAmbientOcclusion* filter)
  {
    filter->SetMethod(GetParam());
    filter->SetSamplesPerTexel(16);
  };
  const vtkIdType half = whole->GetNumberOfPoints() / 2;
  for (const Owner& owner :
    { Owner(interleaved), Owner([&](vtkIdType i) { return i < half ? 0 : size() - 1; }),
      Owner([](vtkIdType) { return size() - 1; }) })
  {
    EXPECT_EQ(differenceFromAlone(whole, owner, prepare).particles, 0);
  }
}

TEST_P(ParallelBake, SameBitsWithIds)
{
  const auto whole = mixedCloud(300);
  vtkNew<vtkIdTypeArray> numbers;
  numbers->SetName("number");
  for (vtkIdType i = 0; i < whole->GetNumberOfPoints(); ++i)
  {
    numbers->InsertNextValue(i);
  }
  whole->GetPointData()->AddArray(numbers);
  const auto prepare = [](vtkSphereAmbientOcclusion* filter)
  {
    filter->SetMethod(GetParam());
    filter->SetSamplesPerTexel(4);
    filter->SetIdArray("number");
  };
  EXPECT_EQ(differenceFromAlone(whole, interleaved, prepare).particles, 0);
}

TEST_P(ParallelBake, SameBitsWithALight)
{
  const auto prepare = [](vtkSphereAmbientOcclusion* filter)
  {
    filter->SetMethod(GetParam());
    filter->SetSamplesPerTexel(4);
    filter->BakeLightOn();
  };
  EXPECT_EQ(differenceFromAlone(mixedCloud(300), interleaved, prepare).particles, 0);
}

TEST_P(ParallelBake, SameBitsOfACroppedSet)
{
  const auto prepare = [](vtkSphereAmbientOcclusion* filter)
  {
    filter->SetMethod(GetParam());
    filter->SetSamplesPerTexel(4);
    filter->SetCropArray("radius");
    filter->SetCropRange(0.2, 0.5);
  };
  EXPECT_EQ(differenceFromAlone(mixedCloud(400), interleaved, prepare).particles, 0);
}

TEST_P(ParallelBake, SameWithATargetError)
{
  const auto whole = mixedCloud(300);
  const auto prepare = [](vtkSphereAmbientOcclusion* filter)
  {
    filter->SetMethod(GetParam());
    filter->SetTextureResolution(4);
    filter->SetTargetError(0.03);
  };
  EXPECT_EQ(differenceFromAlone(whole, interleaved, prepare).particles, 0);
  const auto together = bake(ownPart(whole, interleaved), true, prepare);
  EXPECT_GT(together->GetEstimatedError(), 0);
  EXPECT_LE(together->GetEstimatedError(), 0.03);
}

TEST_P(ParallelBake, WithAMaximumDistanceAHaloIsEnough)
{
  const auto whole = mixedCloud(2000);
  const auto prepare = [](vtkSphereAmbientOcclusion* filter)
  {
    filter->SetMethod(GetParam());
    filter->SetTextureResolution(4);
    filter->SetSamplesPerTexel(16);
    filter->SetMaximumDistance(1.5);
  };
  const auto owner = [&](vtkIdType i)
  {
    const double share = (whole->GetPoint(i)[0] - 1000) / std::cbrt(2000.0);
    return std::min(static_cast<int>(share * size()), size() - 1);
  };
  const Difference found = differenceFromAlone(whole, owner, prepare);
  EXPECT_LE(found.largest, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Methods, ParallelBake,
  testing::Values(vtkSphereAmbientOcclusion::Sweep, vtkSphereAmbientOcclusion::Embree,
    vtkSphereAmbientOcclusion::Reference));

/// A name that all processes know.
std::string sharedFolder()
{
  unsigned number = std::random_device()();
  processes()->Broadcast(&number, 1, 0);
  return (std::filesystem::temp_directory_path() / ("ParticleOcclusion-" + std::to_string(number)))
    .string();
}

double meanAt(vtkPolyData* data, vtkIdType i)
{
  return data->GetPointData()->GetArray("AmbientOcclusion")->GetComponent(i, 0);
}

TEST(ParallelBakeFilter, LoadsFromACacheOnlyIfAllCan)
{
  const auto whole = mixedCloud(300);
  const std::string folder = sharedFolder();
  const auto prepare = [&](vtkSphereAmbientOcclusion* filter)
  {
    filter->UseCacheOn();
    filter->SetCacheDirectory(folder.c_str());
  };
  const auto own = ownPart(whole, interleaved);
  const auto first = bake(own, true, prepare);
  EXPECT_FALSE(first->GetLoadedFromCache());
  const auto second = bake(own, true, prepare);
  EXPECT_TRUE(second->GetLoadedFromCache());
  for (vtkIdType i = 0; i < own->GetNumberOfPoints(); ++i)
  {
    EXPECT_EQ(meanAt(output(first), i), meanAt(output(second), i));
  }
  EXPECT_EQ(first->GetNumberOfTextures(), second->GetNumberOfTextures());
  processes()->Barrier();
  const auto entries = std::filesystem::directory_iterator(folder);
  EXPECT_EQ(std::distance(entries, {}), size());
  processes()->Barrier();
  if (rank() == 0)
  {
    std::filesystem::remove(std::filesystem::directory_iterator(folder)->path());
  }
  processes()->Barrier();
  EXPECT_FALSE(bake(own, true, prepare)->GetLoadedFromCache());
  EXPECT_TRUE(bake(own, true, prepare)->GetLoadedFromCache());
  processes()->Barrier();
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
}

TEST(ParallelBakeFilter, EstimatesOneRadiusForAll)
{
  const auto whole = mixedCloud(2500, false);
  // One half is thin, the other dense: each alone would have another spacing.
  const auto owner = [](vtkIdType i) { return i % 10 == 0 ? 0 : size() - 1; };
  EXPECT_EQ(differenceFromAlone(whole, owner, [](vtkSphereAmbientOcclusion*) {}).particles, 0);
}

TEST(ParallelBakeFilter, GhostsCountOnce)
{
  const auto whole = mixedCloud(400);
  // Everybody also has a copy of every third particle of the others.
  const auto own = part(whole, [](vtkIdType i) { return interleaved(i) == rank() || i % 3 == 0; });
  vtkDataArray* numbers = own->GetPointData()->GetArray("number");
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; i < own->GetNumberOfPoints(); ++i)
  {
    const auto number = static_cast<vtkIdType>(numbers->GetComponent(i, 0));
    ghosts->InsertNextValue(
      interleaved(number) == rank() ? 0 : vtkDataSetAttributes::DUPLICATEPOINT);
  }
  own->GetPointData()->AddArray(ghosts);
  const auto nothing = [](vtkSphereAmbientOcclusion*) {};
  const auto alone = bake(whole, false, nothing);
  const auto together = bake(own, true, nothing);
  EXPECT_EQ(together->GetNumberOfParticles(), 400);
  EXPECT_EQ(difference(output(alone), output(together)).particles, 0); // of the ghosts too
}

TEST(ParallelBakeFilter, OccludersOfAllProcessesCount)
{
  const auto whole = mixedCloud(200);
  const double low = 999, high = 1001 + std::cbrt(200.0);
  vtkNew<vtkPolyData> floor;
  vtkNew<vtkPoints> corners;
  corners->InsertNextPoint(low, low, low);
  corners->InsertNextPoint(high, low, low);
  corners->InsertNextPoint(high, high, low);
  corners->InsertNextPoint(low, high, low);
  vtkNew<vtkCellArray> polygons;
  polygons->InsertNextCell({ 0, 1, 2, 3 });
  floor->SetPoints(corners);
  floor->SetPolys(polygons);
  vtkNew<vtkPolyData> ball;
  vtkNew<vtkPoints> center;
  center->InsertNextPoint(1002, 1002, high + 2);
  vtkNew<vtkDoubleArray> radius;
  radius->SetName("radius");
  radius->InsertNextValue(2);
  ball->SetPoints(center);
  ball->GetPointData()->AddArray(radius);

  const auto occluders = [&](bool withFloor, bool withBall)
  {
    auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    blocks->SetBlock(0, withFloor ? floor.Get() : nullptr);
    blocks->SetBlock(1, withBall ? ball.Get() : nullptr);
    return blocks;
  };
  for (const double distance : { 0.0, 4.0 })
  {
    const auto with = [&](vtkDataObject* data)
    {
      return [=](vtkSphereAmbientOcclusion* filter)
      {
        filter->SetInputDataObject(vtkSphereAmbientOcclusion::OccludersPort, data);
        filter->SetMaximumDistance(distance);
      };
    };
    const auto alone = bake(whole, false, with(occluders(true, true)));
    const auto together =
      bake(ownPart(whole, interleaved), true, with(occluders(rank() == 0, rank() == size() - 1)));
    EXPECT_STREQ(together->GetMethodUsed(), "Embree");
    EXPECT_EQ(parameter(output(together)->GetFieldData(), "occluderTriangles"), "2");
    EXPECT_EQ(parameter(output(together)->GetFieldData(), "occluderSpheres"), "1");
    EXPECT_LE(difference(output(alone), output(together)).largest, distance > 0 ? 1e-4 : 0);
    const auto without = bake(ownPart(whole, interleaved), true, [](vtkSphereAmbientOcclusion*) {});
    EXPECT_GT(difference(output(alone), output(without)).largest, 0.1);
  }
}

TEST(ParallelBakeFilter, TablesOfAllProcessesHaveOneScale)
{
  const auto whole = lattice(5);
  const auto prepare = [](vtkSphereAmbientOcclusion* filter)
  {
    filter->SetEncoding(vtkSphereAmbientOcclusion::UInt8Gamma2);
    filter->SetBackground(vtkSphereAmbientOcclusion::Gradient);
    filter->SetBackgroundTop(3);
  };
  const auto owner = [](vtkIdType i) { return i < 25 ? 0 : size() - 1; }; // the lowest layer
  const auto alone = bake(whole, false, prepare);
  const auto together = bake(ownPart(whole, owner), true, prepare);
  EXPECT_EQ(difference(output(alone), output(together)).particles, 0);
  EXPECT_EQ(parameter(output(alone)->GetFieldData(), "maximum"),
    parameter(output(together)->GetFieldData(), "maximum"));
}

TEST(ParallelBakeFilter, StoredTexturesDoNotDependOnTheProcesses)
{
  const auto whole = mixedCloud(600);
  for (const int storage : { vtkSphereAmbientOcclusion::VariableSize,
         vtkSphereAmbientOcclusion::Compressed, vtkSphereAmbientOcclusion::OneValue })
  {
    const auto prepare = [&](vtkSphereAmbientOcclusion* filter)
    {
      filter->SetEncoding(vtkSphereAmbientOcclusion::UInt8Gamma2);
      filter->SetStorage(storage);
    };
    const auto alone = bake(whole, false, prepare);
    const auto together = bake(ownPart(whole, interleaved), true, prepare);
    std::string fault;
    const po::BakedTextures a = po::readBakedTextures(*output(alone), fault);
    EXPECT_EQ(fault, "");
    const po::BakedTextures b = po::readBakedTextures(*output(together), fault);
    EXPECT_EQ(fault, "");
    vtkDataArray* numbers = output(together)->GetPointData()->GetArray("number");
    for (vtkIdType i = 0; i < numbers->GetNumberOfTuples(); ++i)
    {
      const auto number = static_cast<std::size_t>(numbers->GetComponent(i, 0));
      for (const po::Vec3f direction : { po::Vec3f{ 1, 2, 3 }, po::Vec3f{ -1, 0.5f, -0.2f } })
      {
        EXPECT_EQ(
          a.textures.at(number, direction), b.textures.at(static_cast<std::size_t>(i), direction));
      }
    }
    EXPECT_NEAR(alone->GetStorageDifference(), together->GetStorageDifference(), 1e-9);
  }
}

TEST(ParallelBakeFilter, AnErrorOfOneProcessIsTheErrorOfAll)
{
  const auto data = ownPart(mixedCloud(100), interleaved);
  if (rank() == size() - 1)
  {
    data->GetPointData()->RemoveArray("radius");
  }
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetController(processes());
  filter->SetRadiusArray("radius");
  filter->SetInputData(data);
  const std::string error = errorOf(filter);
  EXPECT_EQ(output(filter)->GetNumberOfPoints(), data->GetNumberOfPoints()); // the input
  EXPECT_FALSE(output(filter)->GetPointData()->HasArray("AmbientOcclusion"));
  if (rank() == 0)
  {
    const bool tellsWho =
      error.find("Process " + std::to_string(size() - 1) + ": ") != std::string::npos;
    EXPECT_EQ(tellsWho, size() > 1) << error;
    EXPECT_NE(error.find("'radius'"), std::string::npos) << error;
  }
  else
  {
    EXPECT_EQ(error, "");
  }
  filter->SetRadiusArray("(none)"); // the next execution is not disturbed
  EXPECT_EQ(errorOf(filter), "");
  EXPECT_EQ(filter->GetNumberOfParticles(), 100);
}

TEST(ParallelBakeFilter, NoPointsAnywhereIsAnError)
{
  vtkNew<vtkPolyData> nothing;
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetController(processes());
  filter->SetInputData(nothing);
  const std::string error = errorOf(filter);
  EXPECT_EQ(error.find("no points") != std::string::npos, rank() == 0) << error;
}

TEST(ParallelBakeFilter, AProcessWithoutParticlesHasTheArraysToo)
{
  const auto whole = mixedCloud(50);
  const auto together =
    bake(ownPart(whole, [](vtkIdType) { return 0; }), true, [](vtkSphereAmbientOcclusion*) {});
  for (const char* name : { "AmbientOcclusion", "AmbientOcclusionTexture" })
  {
    ASSERT_NE(output(together)->GetPointData()->GetArray(name), nullptr);
  }
  EXPECT_NE(output(together)->GetFieldData()->GetArray("AmbientOcclusionTextures"), nullptr);
}

void abortOnLastProcess(vtkObject* caller, unsigned long, void* count, void*)
{
  if (rank() == size() - 1)
  {
    ++*static_cast<int*>(count);
    vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
  }
}

TEST(ParallelBakeFilter, WhenOneIsAbortedAllAre)
{
  const auto data = ownPart(mixedCloud(1500), interleaved);
  int calls = 0;
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(abortOnLastProcess);
  command->SetClientData(&calls);
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetController(processes());
  filter->SetMethod(vtkSphereAmbientOcclusion::Reference);
  filter->SetInputData(data);
  filter->AddObserver(vtkCommand::ProgressEvent, command);
  EXPECT_EQ(errorOf(filter), "");
  EXPECT_EQ(calls > 0, rank() == size() - 1);
  if (rank() != size() - 1) // there VTK itself empties the output
  {
    EXPECT_EQ(output(filter)->GetNumberOfPoints(), data->GetNumberOfPoints());
  }
  EXPECT_EQ(output(filter)->GetPointData()->GetArray("AmbientOcclusion"), nullptr);
}
}

int main(int argc, char* argv[])
{
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  vtkMultiProcessController::SetGlobalController(controller);
  testing::InitGoogleTest(&argc, argv);
  const int failed = RUN_ALL_TESTS();
  controller->Finalize();
  return failed;
}
