// SPDX-License-Identifier: BSD-3-Clause
/// What a bake says before it begins, and while it lasts.

#include "BakeCost.h"
#include "BakeFilterTestSupport.h"

#include "vtkBakeResources.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace
{
using Filter = vtkSphereAmbientOcclusion;

po::BakeWork workOf(std::size_t particles, int method, int resolution = 16, int samples = 49)
{
  po::BakeWork work;
  work.particles = particles;
  work.method = method;
  work.settings.textureResolution = resolution;
  work.settings.samplesPerTexel = samples;
  return work;
}

double secondsOf(const po::BakeWork& work)
{
  return po::estimateCost(work).coreSeconds;
}

TEST(BakeCost, IsWithinAFactorOfThreeOfTheBenchmarks)
{
  // Core seconds of Testing/Benchmarks/README.md at T = 16; the samples are those whose directions
  // are closest to the measured ones.
  struct Measured
  {
    std::size_t particles;
    int method, samples;
    double seconds;
  };
  const Measured sets[] = { { 30000, Filter::Sweep, 28, 0.611 },
    { 30000, Filter::Sweep, 44, 0.806 }, { 6075, Filter::Sweep, 28, 0.197 },
    { 3341, Filter::Sweep, 62, 0.221 }, { 955000, Filter::Sweep, 44, 26.7 },
    { 955000, Filter::Sweep, 41, 14.1 }, { 30000, Filter::Embree, 28, 3.66 },
    { 30000, Filter::Embree, 43, 11.1 }, { 3341, Filter::Embree, 62, 0.552 },
    { 30000, Filter::Reference, 49, 91.9 }, { 30000, Filter::Reference, 49, 136 },
    { 30000, Filter::Reference, 49, 48.5 } };
  for (const Measured& set : sets)
  {
    const double ratio =
      secondsOf(workOf(set.particles, set.method, 16, set.samples)) / set.seconds;
    EXPECT_GT(ratio, 1.0 / 3) << set.particles << " by method " << set.method;
    EXPECT_LT(ratio, 3) << set.particles << " by method " << set.method;
  }
}

TEST(BakeCost, ABakedLightIsWithinAFactorOfThreeOfWhatWasMeasured)
{
  struct Measured
  {
    std::size_t particles;
    double seconds;
  };
  for (const Measured& set :
    { Measured{ 30000, 0.36 }, { 30000, 0.57 }, { 30000, 0.46 }, { 25710, 0.45 }, { 3341, 0.07 } })
  {
    po::BakeWork work = workOf(set.particles, Filter::Sweep);
    const double without = secondsOf(work);
    work.settings.light.emplace();
    const double ratio = (secondsOf(work) - without) / set.seconds;
    EXPECT_GT(ratio, 1.0 / 3) << set.particles << " in " << set.seconds;
    EXPECT_LT(ratio, 3) << set.particles << " in " << set.seconds;
  }
}

TEST(BakeCost, GrowsWithTheWork)
{
  for (const int method : { Filter::Sweep, Filter::Embree, Filter::Reference })
  {
    const double base = secondsOf(workOf(1000, method));
    EXPECT_GT(base, 0);
    EXPECT_NEAR(secondsOf(workOf(5000, method)), 5 * base, 1e-9 * base);
    EXPECT_GT(secondsOf(workOf(1000, method, 32)), 2.5 * base);
    EXPECT_GT(secondsOf(workOf(1000, method, 16, 196)), 3 * base);
  }
  EXPECT_EQ(secondsOf(workOf(1000, Filter::Automatic)), secondsOf(workOf(1000, Filter::Sweep)));
  EXPECT_GT(po::estimateCost(workOf(1000, Filter::Sweep, 32)).bytes,
    3.5 * po::estimateCost(workOf(1000, Filter::Sweep)).bytes);
  po::BakeWork target = workOf(1000, Filter::Sweep);
  target.targetError = 0.01;
  EXPECT_EQ(secondsOf(target), 0);
}

TEST(BakeCost, CountsTheTexturesThatStay)
{
  po::BakeWork work = workOf(1000, Filter::Sweep);
  const po::BakeCost full = po::estimateCost(work);
  EXPECT_EQ(full.textureBytes, 1000 * (256 + 4));
  EXPECT_FALSE(full.texturesPacked);
  work.settings.storage = po::Storage::Compressed;
  EXPECT_TRUE(po::estimateCost(work).texturesPacked);
  EXPECT_EQ(po::estimateCost(work).textureBytes, full.textureBytes);
  work.settings.storage = po::Storage::OneValue;
  EXPECT_EQ(po::estimateCost(work).textureBytes, 1000 * 4);
  EXPECT_LT(po::estimateCost(work).bytes, full.bytes);
  work.settings.storage = po::Storage::Full;
  work.settings.encoding = po::Encoding::Float32Linear;
  EXPECT_EQ(po::estimateCost(work).textureBytes, 1000 * (4 * 256 + 4));
}

TEST(BakeCost, IsSaidInWords)
{
  EXPECT_EQ(po::describe({ 10, 1e9, 1e6, false }, 0, 2, 4e9), "");
  EXPECT_EQ(po::describe({ 24, 0.25e9, 6.7e6, false }, 1000, 2, 4e9),
    "About 12 s on 2 cores\n(4 s to 36 s)\nUses up to 250 MB\n(4.0 GB free)\n"
    "Keeps up to 7 MB");
  EXPECT_EQ(po::describe({ 0.1, 8e9, 1e9, true }, 7, 1, 4e9),
    "A second on 1 core\nUses up to 8.0 GB\n(4.0 GB free: too little)\n"
    "Keeps less than 1.0 GB");
  EXPECT_EQ(
    po::describe({ 0, 1e6, 1e6, false }, 7, 1, 4e9).rfind("Time: by Target Error\n", 0), 0u);
  EXPECT_EQ(po::describe({ 7200 * 4, 1e6, 1e6, false }, 7, 4, 4e9)
              .rfind("About 2 h on 4 cores\n(40 min to 6 h)", 0),
    0u);
}

TEST(BakeCost, OfTheFilterIsThatOfItsInputAndItsStorage)
{
  vtkNew<Filter> filter;
  EXPECT_STREQ(filter->GetBakeEstimate(), "");
  filter->SetInputData(lattice(3));
  EXPECT_NE(std::string(filter->GetBakeEstimate()).find("Keeps up to 1 MB"), std::string::npos);
  filter->SetStorage(static_cast<int>(po::Storage::Compressed));
  filter->SetTextureResolution(64);
  EXPECT_NE(std::string(filter->GetBakeEstimate()).find("Keeps less than 1 MB"), std::string::npos);
}

TEST(BakeCost, TexturesThatAreKeptForTheNextStepCount)
{
  po::BakeWork work = workOf(1000, Filter::Embree);
  const double once = po::estimateCost(work).bytes;
  work.reuseUnchanged = true;
  EXPECT_EQ(po::estimateCost(work).bytes, once) << "without a distance none are";
  work.settings.maximumDistance = 2;
  EXPECT_EQ(po::estimateCost(work).bytes, once + 1000 * 8 * 256);
  work.method = Filter::Automatic;
  EXPECT_EQ(po::estimateCost(work).bytes, once + 1000 * 8 * 256);
}

TEST(BakeCost, IsForTheResourcesOfThisProcess)
{
  vtkNew<vtkBakeResources> resources;
  EXPECT_GE(resources->GetNumberOfCores(), 1);
  EXPECT_GT(resources->GetFreeMemory(), 1e6);
}

/// The texts that a bake reports.
std::set<std::string> phasesOf(int method)
{
  vtkNew<Filter> filter;
  filter->SetInputData(lattice(10));
  filter->SetMethod(method);
  filter->SetTextureResolution(16);
  filter->SetSamplesPerTexel(method == Filter::Reference ? 16 : 1000);
  std::set<std::string> phases;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&phases);
  command->SetCallback(
    [](vtkObject* caller, unsigned long, void* client, void*)
    {
      const char* text = vtkAlgorithm::SafeDownCast(caller)->GetProgressText();
      static_cast<std::set<std::string>*>(client)->insert(text ? text : "");
    });
  filter->AddObserver(vtkCommand::ProgressEvent, command);
  EXPECT_EQ(errorOf(filter), "");
  EXPECT_EQ(filter->GetProgressText(), nullptr); // nothing stays behind
  return phases;
}

TEST(BakeProgress, SaysWhatIsBeingDone)
{
  const std::pair<int, const char*> methods[] = { { Filter::Sweep, "Sweep along 1696 directions" },
    { Filter::Embree, "Rays from 1000 particles" }, { Filter::Reference, "4.1 million rays" } };
  for (const auto& [method, phase] : methods)
  {
    const std::set<std::string> phases = phasesOf(method);
    EXPECT_TRUE(phases.count("Reading particles"));
    EXPECT_TRUE(phases.count("Storing textures"));
    EXPECT_TRUE(phases.count(phase)) << "of " << phases.size() << ", such as " << *phases.rbegin();
  }
}
}
