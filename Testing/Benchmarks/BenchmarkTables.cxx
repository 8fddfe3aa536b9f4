// SPDX-License-Identifier: BSD-3-Clause
/// The tables of Bigler's thesis (2004) for this implementation, as Markdown on standard output:
/// time to generate textures (its table 3.1), memory of textures (3.2), frame rate of direct light
/// without textures, with textures, and of textures alone (3.3), frame rate without and with
/// silhouettes (4.1).
///
///   BenchmarkTables [COUNT] [FILE.vtp ...]
///
/// COUNT spheres [20,000] of each synthetic family, then the files. Pictures have 500 x 500 pixels,
/// one ray a pixel. The camera turns between frames, so that every frame is traced; the median of
/// 15 counts.

#include "SyntheticSpheres.h"

#include "vtkDepthSilhouettePass.h"
#include "vtkRayTracedSphereMapper.h"
#include "vtkSphereAmbientOcclusion.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkXMLPolyDataReader.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

namespace
{
constexpr int Frames = 15;
constexpr double DegreesPerFrame = 3;

struct DataSet
{
  std::string name;
  vtkSmartPointer<vtkPolyData> particles;
};

struct Row
{
  std::string name;
  vtkIdType particles = 0;
  double bakeSeconds = 0;
  double bakeCpuSeconds = 0;
  std::string method;
  int directions = 0;
  vtkIdType textures = 0;
  vtkIdType bytes = 0;
  double direct = 0;       ///< frames per second
  double both = 0;         ///< frames per second
  double texturesOnly = 0; ///< frames per second
  double silhouettes = 0;  ///< frames per second of both, with lines
};

DataSet synthetic(const std::string& family, std::size_t count)
{
  const po::SyntheticSpheres spheres =
    po::makeSyntheticSpheres(*po::syntheticFamilyFromName(family), count, 1);
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> radii;
  radii->SetName("radius");
  for (std::size_t i = 0; i < spheres.radii.size(); ++i)
  {
    points->InsertNextPoint(spheres.centers[i].data());
    radii->InsertNextValue(spheres.radii[i]);
  }
  DataSet data{ family, vtkSmartPointer<vtkPolyData>::New() };
  data.particles->SetPoints(points);
  data.particles->GetPointData()->AddArray(radii);
  return data;
}

DataSet fromFile(const std::string& path)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  const std::size_t slash = path.find_last_of('/');
  return { slash == std::string::npos ? path : path.substr(slash + 1), reader->GetOutput() };
}

/// A window with the baked particles, and what can be switched in it.
struct Scene
{
  explicit Scene(vtkPolyData* baked)
  {
    mapper->SetInputDataObject(baked);
    mapper->ScalarVisibilityOff();
    actor->SetMapper(mapper);
    silhouettes->SetDelegatePass(steps);
    renderer->AddActor(actor);
    renderer->SetPass(silhouettes);
    window->SetOffScreenRendering(true);
    window->SetMultiSamples(0);
    window->SetSize(500, 500);
    window->AddRenderer(renderer);
    renderer->ResetCamera();
  }

  /// Median over frames of a turning camera, in frames per second.
  double frameRate(int shading, bool lines)
  {
    mapper->SetShadingMode(shading);
    silhouettes->SetLineVisibility(lines);
    window->Render(); // nothing is built or allocated in the frames that count
    std::vector<double> seconds;
    for (int frame = 0; frame < Frames; ++frame)
    {
      renderer->GetActiveCamera()->Azimuth(DegreesPerFrame);
      const auto start = std::chrono::steady_clock::now();
      window->Render();
      vtkNew<vtkUnsignedCharArray> pixel;
      window->GetPixelData(0, 0, 0, 0, 0, pixel); // waits for the picture
      seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    std::nth_element(seconds.begin(), seconds.begin() + Frames / 2, seconds.end());
    renderer->GetActiveCamera()->Azimuth(-DegreesPerFrame * Frames);
    return 1 / seconds[Frames / 2];
  }

  vtkNew<vtkRayTracedSphereMapper> mapper;
  vtkNew<vtkActor> actor;
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkDepthSilhouettePass> silhouettes;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;
};

double cpuSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; // of all threads of the process
}

Row measure(const DataSet& data)
{
  Row row;
  row.name = data.name;
  row.particles = data.particles->GetNumberOfPoints();

  vtkNew<vtkSphereAmbientOcclusion> bake;
  bake->SetInputData(data.particles);
  const double before = cpuSeconds();
  bake->Update();
  row.bakeCpuSeconds = cpuSeconds() - before;
  row.bakeSeconds = bake->GetBakeSeconds();
  row.method = bake->GetMethodUsed();
  row.directions = bake->GetNumberOfDirections();
  row.textures = bake->GetNumberOfTextures();
  row.bytes = bake->GetNumberOfTextureBytes();

  Scene scene(vtkPolyData::SafeDownCast(bake->GetOutput()));
  row.direct = scene.frameRate(vtkRayTracedSphereMapper::DIRECT_LIGHT, false);
  row.both = scene.frameRate(vtkRayTracedSphereMapper::BOTH, false);
  row.texturesOnly = scene.frameRate(vtkRayTracedSphereMapper::AMBIENT_OCCLUSION, false);
  row.silhouettes = scene.frameRate(vtkRayTracedSphereMapper::BOTH, true);
  return row;
}

double percentSlower(double rate, double than)
{
  return 100 * (than / rate - 1);
}

void printBakes(const std::vector<Row>& rows)
{
  std::cout << "\nTime to generate and memory of textures (16 x 16 texels, 49 samples a texel)\n\n"
               "| data | particles | method | directions | s | CPU s | textures | MB | bytes a "
               "particle |\n| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const Row& row : rows)
  {
    const auto bytes = static_cast<double>(row.bytes);
    std::cout << "| " << row.name << " | " << row.particles << " | " << row.method << " | "
              << row.directions << " | " << std::setprecision(2) << row.bakeSeconds << " | "
              << row.bakeCpuSeconds << " | " << row.textures << " | " << std::setprecision(1)
              << bytes / 1e6 << " | " << bytes / static_cast<double>(row.particles) << " |\n";
  }
}

void printFrames(const std::vector<Row>& rows)
{
  std::cout
    << "\nFrames per second, 500 x 500\n\n"
       "| data | direct light | with textures | slower by | textures only | with textures and "
       "silhouettes | slower by |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const Row& row : rows)
  {
    std::cout << "| " << row.name << " | " << std::setprecision(1) << row.direct << " | "
              << row.both << " | " << percentSlower(row.both, row.direct) << " % | "
              << row.texturesOnly << " | " << row.silhouettes << " | "
              << percentSlower(row.silhouettes, row.both) << " % |\n";
  }
}
}

int main(int argc, char* argv[])
{
  const std::size_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 20000;
  if (count == 0)
  {
    std::cerr << "Usage: " << argv[0] << " [COUNT] [FILE.vtp ...]\n";
    return EXIT_FAILURE;
  }
  std::vector<Row> rows;
  for (const char* family : { "pack", "overlap", "gas", "shell", "foam" })
  {
    rows.push_back(measure(synthetic(family, count)));
  }
  for (int i = 2; i < argc; ++i)
  {
    rows.push_back(measure(fromFile(argv[i])));
  }
  std::cout << std::fixed;
  printBakes(rows);
  printFrames(rows);
  return EXIT_SUCCESS;
}
