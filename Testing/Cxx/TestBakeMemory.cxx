// SPDX-License-Identifier: BSD-3-Clause
/// Bakes with little memory: what is chosen then, and bakes out of core.

#include "BakeFilterTestSupport.h"
#include "BakeOutcome.h"
#include "MemoryGrowth.h"
#include "TemporaryFolder.h"

#include "vtkCallbackCommand.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

namespace
{
using Filter = vtkSphereAmbientOcclusion;
using Method = Filter::MethodType;

/// What the filter may use, in megabytes above what the process has.
class Budget
{
public:
  explicit Budget(double megabytes)
  {
    const double kibibytes = 1024 * (residentMegabytes() + megabytes);
    setenv(Variable, std::to_string(static_cast<long long>(kibibytes)).c_str(), 1);
  }
  ~Budget() { unsetenv(Variable); }
  Budget(const Budget&) = delete;
  Budget& operator=(const Budget&) = delete;

private:
  static constexpr const char* Variable = "PARTICLEOCCLUSION_MEMORY_LIMIT";
};

TEST(MemoryBudget, AutomaticTakesEmbreeWhereSweepDoesNotFit)
{
  const auto small = lattice(20);
  const auto methodUnder = [&](int method, double megabytes, std::string& error, vtkPolyData* input,
                             int encoding = Filter::UInt8Gamma2)
  {
    const Budget budget(megabytes);
    vtkNew<vtkSphereAmbientOcclusion> filter;
    filter->SetInputData(input);
    filter->SetTextureResolution(64);
    filter->SetEncoding(encoding);
    filter->SetMethod(method);
    // The method is chosen before the first report, so nothing need be baked.
    vtkNew<vtkCallbackCommand> stop;
    stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
      { vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1); });
    filter->AddObserver(vtkCommand::ProgressEvent, stop);
    error = errorOf(filter);
    expectPassedOn(input, filter->GetOutputDataObject(0));
    return std::string(filter->GetMethodUsed());
  };
  std::string error;
  // 8000 * 64 * 64 texels: 190 MiB for Embree, 500 for Sweep in memory, 100 out of core (see
  // bakeMemory).
  EXPECT_EQ(methodUnder(Method::Automatic, 2000, error, small), "Sweep");
  EXPECT_EQ(error, "");
  EXPECT_EQ(methodUnder(Method::Automatic, 150, error, small), "Sweep"); // out of core
  EXPECT_EQ(error, "");
  // As floats, 27,000 * 64 * 64 texels: 850 MiB for Embree, 960 for Sweep out of core.
  EXPECT_EQ(
    methodUnder(Method::Automatic, 905, error, lattice(30), Filter::Float32Linear), "Embree");
  EXPECT_EQ(error, "");
  for (const auto& [method, megabytes] :
    { std::pair(Method::Automatic, 60), std::pair(Method::Sweep, 60),
      std::pair(Method::Embree, 150), std::pair(Method::Reference, 150) })
  {
    methodUnder(method, megabytes, error, small);
    EXPECT_NE(error.find("are free: lower TextureResolution"), std::string::npos) << error;
  }
}

/// While alive, temporary files are in that folder.
class TemporaryFilesIn
{
public:
  explicit TemporaryFilesIn(const std::string& folder)
  {
    const char* before = std::getenv("TMPDIR");
    before_ = before ? std::optional<std::string>(before) : std::nullopt;
    setenv("TMPDIR", folder.c_str(), 1);
  }
  ~TemporaryFilesIn()
  {
    if (before_)
    {
      setenv("TMPDIR", before_->c_str(), 1);
    }
    else
    {
      unsetenv("TMPDIR");
    }
  }
  TemporaryFilesIn(const TemporaryFilesIn&) = delete;
  TemporaryFilesIn& operator=(const TemporaryFilesIn&) = delete;

private:
  std::optional<std::string> before_;
};

/// While alive, no file of this process grows beyond that size: as on a disk that is full.
class FileSizeLimit
{
public:
  explicit FileSizeLimit(rlim_t bytes)
  {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~FileSizeLimit()
  {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST(OutOfCore, GivesTheSameBits)
{
  const TemporaryFolder folder;
  const TemporaryFilesIn here(folder.file(""));
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetInputData(lattice(12));
  filter->SetMethod(Method::Sweep);
  EXPECT_EQ(errorOf(filter), "");
  const std::string inMemory = bitsOf(filter->GetOutputDataObject(0));
  const double error = filter->GetEstimatedError();
  filter->OutOfCoreOn();
  EXPECT_EQ(errorOf(filter), "");
  EXPECT_TRUE(bitsOf(filter->GetOutputDataObject(0)) == inMemory);
  EXPECT_EQ(filter->GetEstimatedError(), error);
  EXPECT_EQ(folder.count(), 0u); // nothing is left
}

TEST(OutOfCore, ALightAndATargetGiveTheSameBits)
{
  for (const bool target : { false, true })
  {
    const TemporaryFolder folder;
    const TemporaryFilesIn here(folder.file(""));
    vtkNew<vtkSphereAmbientOcclusion> filter;
    filter->SetInputData(lattice(8));
    filter->SetMethod(Method::Sweep);
    filter->BakeLightOn();
    filter->SetTargetError(target ? 0.04 : 0);
    EXPECT_EQ(errorOf(filter), "");
    const std::string inMemory = bitsOf(filter->GetOutputDataObject(0));
    filter->OutOfCoreOn();
    EXPECT_EQ(errorOf(filter), "");
    EXPECT_TRUE(bitsOf(filter->GetOutputDataObject(0)) == inMemory) << target;
    EXPECT_EQ(folder.count(), 0u);
  }
}

TEST(OutOfCore, AFolderThatIsNotThereIsOneError)
{
  const TemporaryFolder folder;
  const TemporaryFilesIn nowhere(folder.file("nowhere"));
  vtkNew<vtkSphereAmbientOcclusion> filter;
  const auto input = lattice(4);
  filter->SetInputData(input);
  filter->SetMethod(Method::Sweep);
  filter->OutOfCoreOn();
  const std::string error = errorOf(filter);
  EXPECT_NE(error.find("temporary file"), std::string::npos) << error;
  EXPECT_NE(error.find("TMPDIR"), std::string::npos) << error;
  expectPassedOn(input, filter->GetOutputDataObject(0));
  filter->OutOfCoreOff();
  EXPECT_EQ(errorOf(filter), "");
}

TEST(OutOfCore, AFullDiskIsOneError)
{
  const TemporaryFolder folder;
  const TemporaryFilesIn here(folder.file(""));
  vtkNew<vtkSphereAmbientOcclusion> filter;
  const auto input = lattice(12);
  filter->SetInputData(input);
  filter->SetMethod(Method::Sweep);
  filter->OutOfCoreOn();
  std::string error;
  {
    const FileSizeLimit full(100000);
    error = errorOf(filter);
  }
  EXPECT_NE(error.find("Cannot write the temporary file"), std::string::npos) << error;
  EXPECT_NE(error.find("turn OutOfCore off"), std::string::npos) << error;
  expectPassedOn(input, filter->GetOutputDataObject(0));
  EXPECT_EQ(folder.count(), 0u);
  filter->Modified();
  EXPECT_EQ(errorOf(filter), "");
}
}
