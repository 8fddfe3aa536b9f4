// SPDX-License-Identifier: BSD-3-Clause
/// ReuseUnchanged: what is taken over from the execution before has the bits of a bake.

#include "BakeCacheTestSupport.h"
#include "BakeOutcome.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkIdTypeArray.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace bake_cache;

namespace
{
constexpr double Width = 18;
constexpr double Distance = 1.5; // of radii around 0.5
constexpr int Movers = 5;

/// Spheres of many sizes, some of which overlap; the first ones move from step to step, as many as
/// the number of the step says or more. Two that rest at opposite corners hold the frame.
vtkSmartPointer<vtkPolyData> step(int number, bool withIds = false, int count = Particles)
{
  auto data = cloud(3, count);
  auto* points = data->GetPoints();
  for (vtkIdType i = 0; i < count; ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    const double shift = i < Movers ? 0.3 * number : i < 8 * number ? 0.1 : 0;
    points->SetPoint(i, 1.6 * p[0] + shift, 1.6 * p[1], 1.6 * p[2]);
  }
  points->SetPoint(count - 2, 0, 0, 0);
  points->SetPoint(count - 1, Width, Width, Width);
  if (withIds)
  {
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("id");
    for (vtkIdType i = 0; i < count; ++i)
    {
      ids->InsertNextValue(7 * i + 3);
    }
    data->GetPointData()->AddArray(ids);
  }
  return data;
}

/// The same particles in reverse order.
vtkSmartPointer<vtkPolyData> reversed(vtkPolyData* data, vtkIdType leaveOut = 0)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  result->GetPointData()->CopyAllocate(data->GetPointData());
  for (vtkIdType i = data->GetNumberOfPoints() - 1; i >= leaveOut; --i)
  {
    const vtkIdType place = points->InsertNextPoint(data->GetPoint(i));
    result->GetPointData()->CopyData(data->GetPointData(), i, place);
  }
  result->SetPoints(points);
  return result;
}

/// A plate of two triangles below the particles.
vtkSmartPointer<vtkPolyData> plate(double x)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polygons;
  for (int i = 0; i < 4; ++i)
  {
    points->InsertNextPoint(x + 2 * (i % 2), 4 + 2 * (i / 2), 0.1);
  }
  for (const auto& triangle : { std::array<vtkIdType, 3>{ 0, 1, 2 }, { 1, 3, 2 } })
  {
    polygons->InsertNextCell(3, triangle.data());
  }
  data->SetPoints(points);
  data->SetPolys(polygons);
  return data;
}

vtkSmartPointer<Filter> reusingFilter(const Prepare& prepare)
{
  auto filter = vtkSmartPointer<Filter>::New();
  filter->SetController(nullptr);
  filter->SetTextureResolution(8);
  filter->SetSamplesPerTexel(9);
  filter->SetMaximumDistance(Distance);
  filter->ReuseUnchangedOn();
  prepare(filter);
  return filter;
}

vtkPolyData* execute(Filter* filter, vtkPolyData* data)
{
  filter->SetInputData(data);
  filter->Update();
  EXPECT_EQ(filter->GetErrorCode(), 0u);
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
}

/// The bits that a filter gives that has seen nothing before.
std::string freshBits(vtkPolyData* data, const Prepare& prepare)
{
  const auto filter = reusingFilter(prepare);
  const std::string bits = bitsOf(execute(filter, data));
  EXPECT_EQ(filter->GetNumberOfParticlesReused(), 0);
  return bits;
}

void expectReuse(vtkPolyData* before, vtkPolyData* after, const Prepare& prepare)
{
  const auto filter = reusingFilter(prepare);
  execute(filter, before);
  EXPECT_EQ(filter->GetNumberOfParticlesReused(), 0);
  const std::string bits = bitsOf(execute(filter, after));
  EXPECT_FALSE(bits.empty());
  EXPECT_GT(filter->GetNumberOfParticlesReused(), Particles / 2);
  EXPECT_LT(filter->GetNumberOfParticlesReused(), after->GetNumberOfPoints() - Movers);
  EXPECT_TRUE(bits == freshBits(after, prepare));
}

/// As it is in the table.
std::vector<double> textureOf(vtkPolyData* data, vtkIdType point)
{
  vtkDataArray* table = data->GetFieldData()->GetArray("AmbientOcclusionTextures");
  const auto row = static_cast<vtkIdType>(
    data->GetPointData()->GetArray("AmbientOcclusionTexture")->GetComponent(point, 0));
  std::vector<double> texels(static_cast<std::size_t>(table->GetNumberOfComponents()));
  table->GetTuple(row, texels.data());
  return texels;
}

/// Of texels, in linear visibility; the tables are of floats.
double rms(vtkPolyData* a, vtkPolyData* b)
{
  double sum = 0;
  for (vtkIdType i = 0; i < Particles; ++i)
  {
    const std::vector<double> ofA = textureOf(a, i), ofB = textureOf(b, i);
    for (std::size_t k = 0; k < ofA.size(); ++k)
    {
      sum += std::pow(ofA[k] - ofB[k], 2) / static_cast<double>(ofA.size());
    }
  }
  return std::sqrt(sum / Particles);
}
}

TEST(Reuse, GivesTheBitsOfABakeWithEveryMethodThatReuses)
{
  for (const int method : { Filter::Automatic, Filter::Embree, Filter::Reference })
  {
    for (const bool withIds : { false, true })
    {
      expectReuse(step(0, withIds), step(1, withIds), [&](Filter* f) { f->SetMethod(method); });
    }
  }
}

TEST(Reuse, GivesTheBitsOfABakeInEveryStorage)
{
  expectReuse(step(0), step(1), [](Filter* f) { f->SetEncoding(Filter::Float32Linear); });
  for (const int storage : { Filter::VariableSize, Filter::Compressed, Filter::OneValue })
  {
    expectReuse(step(0), step(1), [&](Filter* f) { f->SetStorage(storage); });
  }
}

TEST(Reuse, GivesTheBitsOfABakeWithALightABackgroundAndATarget)
{
  expectReuse(step(0), step(1), [](Filter* f) { f->BakeLightOn(); });
  expectReuse(step(0), step(1), [](Filter* f) { f->SetBackground(Filter::Gradient); });
  expectReuse(step(0), step(1), [](Filter* f) { f->SetTargetError(0.05); });
  expectReuse(step(0), step(1), [](Filter* f) { f->DilateInsideOff(); });
}

TEST(Reuse, ParticlesAreFoundInAnyOrderAndWhenOthersVanishOrAppear)
{
  const Prepare asItIs = [](Filter*) {};
  for (const bool withIds : { false, true })
  {
    const auto all = step(0, withIds);
    const auto few = reversed(all, Movers);
    expectReuse(all, few, asItIs);
    expectReuse(few, all, asItIs);
  }
}

TEST(Reuse, OccludersThatChangeCount)
{
  const auto filter = reusingFilter([](Filter*) {});
  const auto particles = step(0);
  filter->SetInputData(Filter::OccludersPort, plate(2));
  execute(filter, particles);
  const auto other = plate(7);
  filter->SetInputData(Filter::OccludersPort, other);
  const std::string bits = bitsOf(execute(filter, particles));
  EXPECT_GT(filter->GetNumberOfParticlesReused(), Particles / 2);
  EXPECT_LT(filter->GetNumberOfParticlesReused(), Particles);
  EXPECT_TRUE(bits ==
    freshBits(particles, [&](Filter* f) { f->SetInputData(Filter::OccludersPort, other); }));

  filter->SetInputData(Filter::OccludersPort, step(4, false, Particles / 4)); // spheres
  EXPECT_NE(bits, bitsOf(execute(filter, particles)));
  EXPECT_LT(filter->GetNumberOfParticlesReused(), Particles / 2);
}

TEST(Reuse, CropsCount)
{
  const auto particles = step(0);
  const Prepare crop = [](Filter* f)
  {
    f->CropBoxOn();
    f->SetCropBoxOrigin(-1, -1, -1);
    f->SetCropBoxSize(14, 20, 20);
  };
  const auto filter = reusingFilter([](Filter*) {});
  execute(filter, particles);
  crop(filter);
  const std::string bits = bitsOf(execute(filter, particles));
  EXPECT_GT(filter->GetNumberOfParticlesReused(), Particles / 2);
  EXPECT_LT(filter->GetNumberOfParticlesReused(), filter->GetNumberOfParticles());
  EXPECT_TRUE(bits == freshBits(particles, crop));
}

TEST(Reuse, WhatRestsHasNoNoiseFromStepToStep)
{
  for (const int encoding : { Filter::UInt8Gamma2, Filter::Float32Linear })
  {
    const auto filter = reusingFilter([&](Filter* f) { f->SetEncoding(encoding); });
    vtkNew<vtkPolyData> before;
    before->ShallowCopy(execute(filter, step(0)));
    vtkPolyData* after = execute(filter, step(1));
    vtkIdType equal = 0;
    for (vtkIdType i = 0; i < Particles; ++i)
    {
      equal += textureOf(before, i) == textureOf(after, i) ? 1 : 0;
    }
    EXPECT_GE(equal, filter->GetNumberOfParticlesReused());
    EXPECT_LT(equal, Particles);
  }
}

TEST(Reuse, NothingIsBakedWhereNothingHasChanged)
{
  const auto filter = reusingFilter([](Filter*) {});
  const std::string bits = bitsOf(execute(filter, step(0)));
  const double error = filter->GetEstimatedError();
  const int directions = filter->GetNumberOfDirections();
  EXPECT_GT(filter->GetNumberOfRays() + filter->GetNumberOfTexelsInside(), 0);
  EXPECT_EQ(bitsOf(execute(filter, step(0))), bits);
  EXPECT_EQ(filter->GetNumberOfParticlesReused(), Particles);
  EXPECT_EQ(filter->GetNumberOfParticles(), Particles);
  EXPECT_EQ(filter->GetNumberOfTexelsInside(), 0);
  EXPECT_EQ(filter->GetNumberOfDirections(), directions);
  EXPECT_NEAR(filter->GetEstimatedError(), error, 1e-12);
  EXPECT_EQ(parameter(filter->GetOutputDataObject(0)->GetFieldData(), "reusedParticles"), "400");
  // Another storage takes what is there, too.
  filter->SetStorage(Filter::Compressed);
  EXPECT_TRUE(bitsOf(execute(filter, step(0))) ==
    freshBits(step(0), [](Filter* f) { f->SetStorage(Filter::Compressed); }));
  EXPECT_EQ(filter->GetNumberOfParticlesReused(), Particles);
}

TEST(Reuse, ManyStepsThereAndBackLeaveNoTrace)
{
  const auto filter = reusingFilter([](Filter*) {});
  for (const int number : { 0, 1, 2, 7, 3, 2, 0 })
  {
    const auto data = step(number);
    EXPECT_TRUE(bitsOf(execute(filter, data)) == freshBits(data, [](Filter*) {})) << number;
  }
}

TEST(Reuse, TheOutermostParticleMayMove)
{
  const auto other = step(0);
  other->GetPoints()->SetPoint(Particles - 1, Width + 0.7, Width, Width);
  const auto filter = reusingFilter([](Filter*) {});
  execute(filter, step(0));
  EXPECT_TRUE(bitsOf(execute(filter, other)) == freshBits(other, [](Filter*) {}));
  EXPECT_GT(filter->GetNumberOfParticlesReused(), Particles - 20);
}

TEST(Reuse, AFrameThatChangesMeansANewBake)
{
  const auto far = step(0);
  far->GetPoints()->SetPoint(Particles - 1, 4 * Width, 0, 0);
  const auto filter = reusingFilter([](Filter*) {});
  execute(filter, step(0));
  EXPECT_TRUE(bitsOf(execute(filter, far)) == freshBits(far, [](Filter*) {}));
  EXPECT_EQ(filter->GetNumberOfParticlesReused(), 0);
}

TEST(Reuse, OtherParametersMeanANewBake)
{
  const auto data = step(0);
  const std::vector<Prepare> changes = { [](Filter* f) { f->SetSeed(2); },
    [](Filter* f) { f->SetSamplesPerTexel(25); }, [](Filter* f) { f->SetTextureResolution(4); },
    [](Filter* f) { f->SetMaximumDistance(2 * Distance); },
    [](Filter* f) { f->SetRadiusScale(0.5); }, [](Filter* f) { f->BakeLightOn(); } };
  for (const Prepare& change : changes)
  {
    const auto filter = reusingFilter([](Filter*) {});
    execute(filter, data);
    change(filter);
    EXPECT_TRUE(bitsOf(execute(filter, data)) == freshBits(data, change));
    EXPECT_EQ(filter->GetNumberOfParticlesReused(), 0);
  }
}

TEST(Reuse, DoesNothingWithoutADistanceOrByMethodsThatAskForAll)
{
  const std::vector<Prepare> others = { [](Filter* f) { f->SetMaximumDistance(0); },
    [](Filter* f) { f->SetMethod(Filter::Sweep); }, [](Filter* f) { f->ReuseUnchangedOff(); },
    [](Filter* f)
    {
      f->SetMethod(Filter::Reference);
      f->SetTargetError(0.2);
    } };
  for (const Prepare& prepare : others)
  {
    const auto filter = reusingFilter(prepare);
    execute(filter, step(0));
    const std::string bits = bitsOf(execute(filter, step(1)));
    EXPECT_EQ(filter->GetNumberOfParticlesReused(), 0);
    filter->ReuseUnchangedOff(); // the frame is the usual one, too
    EXPECT_TRUE(bits == bitsOf(execute(filter, step(1))));
  }
}

TEST(Reuse, ChangesRoundingOnly)
{
  const Prepare floats = [](Filter* f)
  {
    f->SetEncoding(Filter::Float32Linear);
    f->SetMethod(Filter::Embree);
  };
  const auto on = reusingFilter(floats);
  const auto off = reusingFilter(floats);
  off->ReuseUnchangedOff();
  const auto data = step(0, true);
  const double change = rms(execute(on, data), execute(off, data));
  EXPECT_LT(change, 0.002);
}

TEST(Reuse, WorksWithACache)
{
  TemporaryFolder folder;
  const Prepare cached = [&](Filter* f)
  {
    f->UseCacheOn();
    f->SetCacheDirectory(folder.file("cache").c_str());
  };
  const auto filter = reusingFilter(cached);
  const std::string first = bitsOf(execute(filter, step(0)));
  const std::string second = bitsOf(execute(filter, step(1)));
  EXPECT_FALSE(filter->GetLoadedFromCache());
  const vtkIdType reused = filter->GetNumberOfParticlesReused();
  EXPECT_GT(reused, 0);
  // Time goes back, in this session and another.
  EXPECT_TRUE(bitsOf(execute(filter, step(0))) == first);
  EXPECT_TRUE(filter->GetLoadedFromCache());
  const auto later = reusingFilter(cached);
  EXPECT_TRUE(bitsOf(execute(later, step(1))) == second);
  EXPECT_TRUE(later->GetLoadedFromCache());
  EXPECT_EQ(later->GetNumberOfParticlesReused(), reused);
  // What was kept is of step 1 still.
  EXPECT_TRUE(bitsOf(execute(filter, step(2))) == freshBits(step(2), [](Filter*) {}));
  EXPECT_GT(filter->GetNumberOfParticlesReused(), Particles / 2);
}

TEST(Reuse, AfterAnAbortAllIsBaked)
{
  const Prepare fine = [](Filter* f)
  {
    f->SetTextureResolution(16);
    f->SetSamplesPerTexel(400);
  };
  const auto filter = reusingFilter(fine);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1); });
  bool aborted = false;
  for (int i = 0; i < 10 && !aborted; ++i) // one may come after the last question for it
  {
    execute(filter, step(0));
    const auto tag = filter->AddObserver(vtkCommand::ProgressEvent, abort);
    aborted = bitsOf(execute(filter, step(40))).empty();
    filter->RemoveObserver(tag);
    filter->SetAbortExecute(0);
  }
  EXPECT_TRUE(aborted);
  EXPECT_TRUE(bitsOf(execute(filter, step(1))) == freshBits(step(1), fine));
}
