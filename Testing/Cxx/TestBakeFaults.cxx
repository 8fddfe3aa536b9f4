// SPDX-License-Identifier: BSD-3-Clause
// Whatever fails in a bake: one error, the particles as they came, never part of a table, and the
// next bake has the bits that it always had.
#include "BakeFilterTestSupport.h"
#include "BakeOutcome.h"
#include "FaultInjection.h"

#include "vtkCallbackCommand.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace
{
using Method = vtkSphereAmbientOcclusion::MethodType;

std::string nameOf(int method)
{
  return method == Method::Sweep ? "Sweep" : method == Method::Embree ? "Embree" : "Reference";
}

/// Runs RequestData alone under a fault: what VTK's pipeline allocates around it is not ours.
class BakeUnderFault : public vtkSphereAmbientOcclusion
{
public:
  static BakeUnderFault* New();
  vtkTypeMacro(BakeUnderFault, vtkSphereAmbientOcclusion);

  std::function<void(const std::function<void()>& bake)> fault;

protected:
  int RequestData(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override
  {
    int result = 0;
    const auto bake = [&] { result = this->Superclass::RequestData(request, input, output); };
    this->fault ? this->fault(bake) : bake();
    return result;
  }
};
vtkStandardNewMacro(BakeUnderFault);

vtkSmartPointer<vtkMultiBlockDataSet> twoBlocks()
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  blocks->SetBlock(0, lattice(2));
  blocks->SetBlock(2, lattice(2, "radius", 2)); // block 1 is empty
  return blocks;
}

/// A small bake that can be repeated, with a mesh on the port of occluders where that is possible.
struct SmallBake
{
  vtkNew<BakeUnderFault> filter;
  vtkSmartPointer<vtkDataObject> input;

  explicit SmallBake(int method, vtkSmartPointer<vtkDataObject> data = lattice(2))
    : input(std::move(data))
  {
    filter->SetInputDataObject(input);
    filter->SetMethod(method);
    filter->SetTextureResolution(2);
    filter->SetSamplesPerTexel(4);
    if (method != Method::Sweep)
    {
      vtkNew<vtkPlaneSource> ground;
      ground->SetCenter(0, 0, -1);
      ground->Update();
      filter->SetInputDataObject(vtkSphereAmbientOcclusion::OccludersPort, ground->GetOutput());
    }
  }

  [[nodiscard]] vtkDataObject* output() const { return filter->GetOutputDataObject(0); }

  std::string bits()
  {
    filter->fault = nullptr;
    filter->Modified();
    EXPECT_EQ(errorOf(filter), "");
    EXPECT_EQ(filter->GetErrorCode(), vtkErrorCode::NoError);
    return bitsOf(output());
  }

  /// Bakes under a fault. Either it went well, with the given bits, or there is one error and the
  /// input comes out; then the error is returned.
  std::string errorUnder(
    const std::function<void(const std::function<void()>&)>& fault, const std::string& wholeBits)
  {
    filter->fault = fault;
    filter->Modified();
    ErrorCatcher errors(filter);
    filter->Update();
    EXPECT_LE(errors.count(), 1) << errors.text();
    if (errors.count() == 0)
    {
      EXPECT_TRUE(bitsOf(output()) == wholeBits)
        << "a fault changed the result and nothing was said";
      return {};
    }
    EXPECT_NE(filter->GetErrorCode(), vtkErrorCode::NoError);
    expectPassedOn(input, output());
    EXPECT_EQ(filter->GetNumberOfParticles(), 0) << "counters of a bake that failed";
    return errors.text();
  }
};

class BakeFaults : public testing::TestWithParam<int>
{
};
INSTANTIATE_TEST_SUITE_P(Methods, BakeFaults,
  testing::Values(Method::Sweep, Method::Embree, Method::Reference),
  [](const auto& info) { return nameOf(info.param); });

TEST_P(BakeFaults, EveryAllocationMayFail)
{
  // Of Sweep out of core what belongs to the file may fail too.
  for (const bool composite : { false, true })
  {
    SmallBake bake(GetParam(),
      composite ? vtkSmartPointer<vtkDataObject>(twoBlocks())
                : vtkSmartPointer<vtkDataObject>(lattice(2)));
    bake.filter->SetOutOfCore(composite);
    const std::string whole = bake.bits();
    ASSERT_FALSE(whole.empty());
    std::size_t all = 0;
    bake.errorUnder(
      [&](const auto& run)
      {
        const FailingAllocation none(0);
        run();
        all = FailingAllocation::count();
      },
      whole);
    int failures = 0;
    int faults = 0;
    for (std::size_t n = 1; n <= all; ++n)
    {
      const std::string error = bake.errorUnder(
        [n](const auto& run)
        {
          const FailingAllocation failing(n);
          run();
        },
        whole);
      ++faults;
      failures += !error.empty();
      // Embree does not know the reason of every failure of its own.
      EXPECT_TRUE(error.empty() || error.find("emory") != std::string::npos ||
        error.find("Embree failed") != std::string::npos)
        << error;
      ASSERT_FALSE(testing::Test::HasFailure()) << "allocation " << n << " of " << all;
    }
    std::printf("%d allocations made to fail, of %zu: %d errors\n", faults, all, failures);
    EXPECT_GT(failures, 50);
    EXPECT_TRUE(bake.bits() == whole);
  }
}

TEST_P(BakeFaults, EveryCallOfEmbreeMayFail)
{
  SmallBake bake(GetParam());
  const std::string whole = bake.bits();
  const struct
  {
    RTCError error;
    const char* says;
  } reasons[] = { { RTC_ERROR_OUT_OF_MEMORY, "emory" }, { RTC_ERROR_UNSUPPORTED_CPU, "Embree" },
    { RTC_ERROR_UNKNOWN, "Embree" } };
  int failures = 0;
  for (const EmbreeCall call : { EmbreeCall::NewDevice, EmbreeCall::NewScene,
         EmbreeCall::NewGeometry, EmbreeCall::NewBuffer, EmbreeCall::CommitScene })
  {
    for (const auto& reason : reasons)
    {
      bool hit = true;
      for (int n = 1; hit; ++n)
      {
        const std::string error = bake.errorUnder(
          [&](const auto& run)
          {
            const FailingEmbree failing(call, n, reason.error);
            run();
            hit = FailingEmbree::hit();
          },
          whole);
        EXPECT_EQ(error.empty(), !hit) << "call " << static_cast<int>(call) << ", " << n;
        EXPECT_TRUE(!hit || error.find(reason.says) != std::string::npos ||
          (call == EmbreeCall::NewBuffer && error.find("emory") != std::string::npos))
          << error;
        failures += hit;
      }
    }
  }
  // A device, scene, geometry and commit for the search for overlaps; of others than Sweep, for
  // rays too.
  EXPECT_GE(failures, 3 * (GetParam() == Method::Sweep ? 4 : 8));
  EXPECT_TRUE(bake.bits() == whole);
}

TEST_P(BakeFaults, EmbreeMayRunOutOfMemory)
{
  SmallBake bake(GetParam(), lattice(5));
  const std::string whole = bake.bits();
  int failures = 0;
  for (std::ptrdiff_t bytes = 1; bytes < (std::ptrdiff_t{ 1 } << 30); bytes *= 2)
  {
    const std::string error = bake.errorUnder(
      [&](const auto& run)
      {
        const EmbreeMemoryLimit limit(bytes);
        run();
      },
      whole);
    EXPECT_TRUE(error.empty() || error.find("emory") != std::string::npos) << error;
    failures += !error.empty();
  }
  EXPECT_GT(failures, 5);
  EXPECT_LT(failures, 30);
  EXPECT_TRUE(bake.bits() == whole);
}

#ifndef PARTICLEOCCLUSION_SANITIZED
TEST_P(BakeFaults, NoThreadMayBeStarted)
{
  // In a process of its own, in which none has been started yet. Unless Embree's scene is given up
  // after that, it ends the process.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto bakeWithoutThreads = []
  {
    SmallBake bake(GetParam());
    const std::string error = bake.errorUnder(
      [](const auto& run)
      {
        const NoNewThreads none;
        run();
      },
      {});
    std::fprintf(stderr, "the bake said: %s", error.c_str());
    std::exit(error.empty() || testing::Test::HasFailure() ? 1 : 0);
  };
  EXPECT_EXIT(bakeWithoutThreads(), testing::ExitedWithCode(0), "the bake said: .*thread");
}
#endif

TEST_P(BakeFaults, AbortsLeaveTheInputAndTheNextBakeItsBits)
{
  SmallBake bake(GetParam(), lattice(7));
  bake.filter->SetTextureResolution(GetParam() == Method::Sweep ? 32 : 16);
  bake.filter->SetSamplesPerTexel(GetParam() == Method::Reference ? 49 : 400);
  const std::string whole = bake.bits();
  std::mt19937 random(20261126);
  struct Stop
  {
    int after;
    int reports = 0;
  } stop{};
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&stop);
  command->SetCallback(
    [](vtkObject* caller, unsigned long, void* client, void*)
    {
      auto& at = *static_cast<Stop*>(client);
      if (++at.reports >= at.after)
      {
        vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
      }
    });
  const auto tag = bake.filter->AddObserver(vtkCommand::ProgressEvent, command);
  int aborted = 0;
  for (int i = 0; i < 10; ++i)
  {
    // The first report is always there; how many follow depends on the machine.
    stop = { 1 + static_cast<int>(random() % 3) };
    bake.filter->Modified();
    EXPECT_EQ(errorOf(bake.filter), "");
    bake.filter->SetAbortExecute(0);
    const std::string bits = bitsOf(bake.output());
    if (bits.empty())
    {
      ++aborted;
      expectPassedOn(bake.input, bake.output());
    }
    else
    {
      EXPECT_TRUE(bits == whole); // the abort came after the last question for it
    }
  }
  bake.filter->RemoveObserver(tag);
  EXPECT_GT(aborted, 0);
  EXPECT_TRUE(bake.bits() == whole);
}
}
