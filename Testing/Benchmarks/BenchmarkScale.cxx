// SPDX-License-Identifier: BSD-3-Clause
/// Time and memory of one execution of the filter, from points to the baked data set.
///
///   BenchmarkScale [--out-of-core] FAMILY PARTICLES METHOD [MAXIMUM_DISTANCE] [CACHE_DIRECTORY]
///
/// METHOD is that of vtkSphereAmbientOcclusion::MethodType. Prints one row of a table:
/// the seconds of the bake (CPU and wall), the peak of memory above the input in MB, and what
/// cannot be done without: the spheres and Embree's scene of them, and the output. With a directory
/// the filter is executed twice, the second time from its cache. Linux.

#include "ProcessCost.h"
#include "SphereCloud.h"
#include "SphereScene.h"
#include "SphereSet.h"
#include "SyntheticSpheres.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereAmbientOcclusion.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string>

namespace
{
constexpr double Megabyte = 1e6;

double resident()
{
  return po::statusMegabytes("VmRSS");
}

/// Makes the peak that of what follows.
void resetPeak()
{
  std::ofstream("/proc/self/clear_refs") << "5";
}

vtkSmartPointer<vtkPolyData> makeInput(const std::string& family, std::size_t count)
{
  const po::SyntheticSpheres spheres =
    po::makeSyntheticSpheres(*po::syntheticFamilyFromName(family), count, 1);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> radii;
  radii->SetName("radius");
  const auto size = static_cast<vtkIdType>(spheres.radii.size());
  points->SetNumberOfPoints(size);
  radii->SetNumberOfTuples(size);
  for (vtkIdType i = 0; i < size; ++i)
  {
    const auto& c = spheres.centers[static_cast<std::size_t>(i)];
    points->SetPoint(i, c[0], c[1], c[2]);
    radii->SetValue(i, spheres.radii[static_cast<std::size_t>(i)]);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(radii);
  return data;
}

/// What the spheres and Embree's scene of them take, in MB.
double sceneMegabytes(vtkPolyData& data)
{
  const auto positionAt = [&](std::size_t i)
  {
    po::Vec3d p;
    data.GetPoint(static_cast<vtkIdType>(i), &p.x);
    return p;
  };
  vtkDataArray* radii = data.GetPointData()->GetArray("radius");
  po::SphereCloud cloud = po::makeSphereCloud(static_cast<std::size_t>(data.GetNumberOfPoints()),
    positionAt, [&](std::size_t i) { return radii->GetComponent(static_cast<vtkIdType>(i), 0); });
  cloud.sourceIds = {};
  const double before = resident() - 16 * static_cast<double>(cloud.spheres.size()) / Megabyte;
  const po::SphereScene scene(po::SphereSet(std::move(cloud.spheres)), {});
  return resident() - before;
}

double outputMegabytes(vtkPolyData& data)
{
  const double table =
    static_cast<double>(data.GetFieldData()->GetArray("AmbientOcclusionTextures")->GetDataSize());
  return (table + 8.0 * static_cast<double>(data.GetNumberOfPoints())) / Megabyte;
}

/// Ends the program where the filter has reported an error.
void execute(vtkSphereAmbientOcclusion* filter, const char* label, double scene)
{
  const double before = resident();
  resetPeak();
  const std::clock_t cpu = std::clock();
  const auto wall = std::chrono::steady_clock::now();
  filter->Modified();
  filter->Update();
  if (filter->GetErrorCode() != vtkErrorCode::NoError)
  {
    std::exit(1);
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - wall;
  const double cpuSeconds = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  const double peak = po::statusMegabytes("VmHWM") - before;
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  const double bound = scene + outputMegabytes(*output);
  std::printf("| %s | %lld | %s%s | %.1f | %.1f | %.0f | %.0f | %.0f | %.2f |\n", label,
    static_cast<long long>(filter->GetNumberOfParticles()), filter->GetMethodUsed(),
    filter->GetLoadedFromCache() ? ", loaded" : "", cpuSeconds, seconds.count(), peak, scene,
    bound - scene, peak / bound);
}
}

int main(int argc, char** argv)
{
  const bool outOfCore = argc > 1 && std::string(argv[1]) == "--out-of-core";
  if (outOfCore)
  {
    --argc;
    ++argv;
  }
  if (argc < 4 || !po::syntheticFamilyFromName(argv[1]))
  {
    std::fprintf(stderr,
      "usage: BenchmarkScale [--out-of-core] FAMILY PARTICLES METHOD [MAXIMUM_DISTANCE] "
      "[CACHE_DIRECTORY]\n");
    return 1;
  }
  const auto data = makeInput(argv[1], std::strtoull(argv[2], nullptr, 10));
  const double scene = sceneMegabytes(*data);
  vtkNew<vtkSphereAmbientOcclusion> filter;
  filter->SetInputData(data);
  filter->SetMethod(std::atoi(argv[3]));
  filter->SetOutOfCore(outOfCore);
  filter->SetMaximumDistance(argc > 4 ? std::atof(argv[4]) : 0);
  if (argc > 5)
  {
    filter->UseCacheOn();
    filter->SetCacheDirectory(argv[5]);
  }
  execute(filter, argv[1], scene);
  if (argc > 5)
  {
    filter->GetOutputDataObject(0)->Initialize();
    execute(filter, argv[1], scene);
  }
  return 0;
}
