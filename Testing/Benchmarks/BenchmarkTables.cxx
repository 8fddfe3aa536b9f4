// SPDX-License-Identifier: BSD-3-Clause
/// The tables of Bigler's thesis (2004) for this implementation, as Markdown on standard output:
/// time to generate textures (its table 3.1), memory of textures (3.2), frame rate of direct light
/// without textures, with textures, and of textures alone (3.3), frame rate without and with
/// silhouettes (4.1), and what OpenGL takes of a frame.
///
///   BenchmarkTables [COUNT] [FILE.vtp ...]
///
/// COUNT spheres [50,000] of each synthetic family, then the files. Pictures have 500 x 500 pixels,
/// one ray a pixel. The camera turns between frames, so that every frame is traced; all ways to
/// draw take turns at each view, so that load from outside falls on all alike, and the median of 45
/// frames counts.

#include "SyntheticSpheres.h"

#include "vtkDepthSilhouettePass.h"
#include "vtkRayTracedSphereMapper.h"
#include "vtkSphereAmbientOcclusion.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkErrorCode.h"
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
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
constexpr int Frames = 45;
constexpr std::size_t DefaultCount = 50000;
constexpr double DegreesPerFrame = 3;

struct DataSet
{
  std::string name;
  vtkSmartPointer<vtkPolyData> particles;
};

/// Medians over frames.
struct Pace
{
  double frame = 0;  ///< seconds
  double traced = 0; ///< seconds of it to trace and to shade; the rest is OpenGL's and VTK's

  [[nodiscard]] double rate() const { return 1 / frame; }
};

double median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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
  std::vector<Pace> paces; ///< of the ways in turn
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

/// Throws std::runtime_error if there are no particles to be had.
DataSet fromFile(const std::string& path)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  if (reader->GetErrorCode() != vtkErrorCode::NoError ||
    reader->GetOutput()->GetNumberOfPoints() == 0)
  {
    throw std::runtime_error("No particles could be read from " + path + ".");
  }
  const std::size_t slash = path.find_last_of('/');
  return { slash == std::string::npos ? path : path.substr(slash + 1), reader->GetOutput() };
}

/// A way to draw the particles.
struct Way
{
  int shading;
  bool lines;
};

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

  /// Times one frame of the current view, drawn in one way.
  Pace draw(const Way& way)
  {
    // Nothing of the frame before is kept: a hair's breadth is another view.
    renderer->GetActiveCamera()->Azimuth(1e-3);
    mapper->SetShadingMode(way.shading);
    silhouettes->SetLineVisibility(way.lines);
    const auto start = std::chrono::steady_clock::now();
    window->Render();
    vtkNew<vtkUnsignedCharArray> pixel;
    window->GetPixelData(0, 0, 0, 0, 0, pixel); // waits for the picture
    return { std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
      mapper->GetTraceSeconds() + mapper->GetShadeSeconds() };
  }

  [[nodiscard]] std::vector<Pace> paces(const std::vector<Way>& ways)
  {
    std::vector<std::vector<double>> frames(ways.size()), traced(ways.size());
    for (const Way& way : ways)
    {
      draw(way); // nothing is built or allocated in the frames that count
    }
    for (int frame = 0; frame < Frames; ++frame)
    {
      renderer->GetActiveCamera()->Azimuth(DegreesPerFrame);
      for (std::size_t i = 0; i < ways.size(); ++i)
      {
        const Pace pace = draw(ways[i]);
        frames[i].push_back(pace.frame);
        traced[i].push_back(pace.traced);
      }
    }
    std::vector<Pace> medians;
    for (std::size_t i = 0; i < ways.size(); ++i)
    {
      medians.push_back({ median(frames[i]), median(traced[i]) });
    }
    return medians;
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
  row.paces = scene.paces(
    { { vtkRayTracedSphereMapper::DIRECT_LIGHT, false }, { vtkRayTracedSphereMapper::BOTH, false },
      { vtkRayTracedSphereMapper::AMBIENT_OCCLUSION, false },
      { vtkRayTracedSphereMapper::BOTH, true } });
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
    const double direct = row.paces[0].rate(), both = row.paces[1].rate(),
                 texturesOnly = row.paces[2].rate(), lines = row.paces[3].rate();
    std::cout << "| " << row.name << " | " << std::setprecision(1) << direct << " | " << both
              << " | " << percentSlower(both, direct) << " % | " << texturesOnly << " | " << lines
              << " | " << percentSlower(lines, both) << " % |\n";
  }
}

void printShares(const std::vector<Row>& rows)
{
  std::cout << "\nMilliseconds of a frame with textures: to trace and shade; what OpenGL and VTK "
               "add, without and with silhouettes\n\n"
               "| data | trace and shade | OpenGL | OpenGL, with silhouettes |\n"
               "| --- | ---: | ---: | ---: |\n";
  const auto rest = [](const Pace& pace) { return 1e3 * (pace.frame - pace.traced); };
  for (const Row& row : rows)
  {
    std::cout << "| " << row.name << " | " << 1e3 * row.paces[1].traced << " | "
              << rest(row.paces[1]) << " | " << rest(row.paces[3]) << " |\n";
  }
}

/// The argument as a count of spheres; throws std::runtime_error if it is none.
std::size_t parseCount(const std::string& text)
{
  constexpr std::size_t Limit = 100'000'000;
  const bool digits =
    !text.empty() && text.size() <= 9 && text.find_first_not_of("0123456789") == std::string::npos;
  const std::size_t count = digits ? std::stoul(text) : 0;
  if (count < 1 || count > Limit)
  {
    throw std::runtime_error(
      "COUNT must be a whole number from 1 to " + std::to_string(Limit) + ", not '" + text + "'.");
  }
  return count;
}

bool isFileName(const std::string& argument)
{
  const std::string end = ".vtp";
  return argument.size() > end.size() && argument.substr(argument.size() - end.size()) == end;
}

void printTables(const std::vector<std::string>& arguments)
{
  const bool counted = !arguments.empty() && !isFileName(arguments.front());
  const std::size_t count = counted ? parseCount(arguments.front()) : DefaultCount;
  std::vector<DataSet> files; // all are read first: a wrong name is reported at once
  for (std::size_t i = counted ? 1 : 0; i < arguments.size(); ++i)
  {
    files.push_back(fromFile(arguments[i]));
  }
  std::vector<Row> rows;
  for (const char* family : { "pack", "overlap", "gas", "shell", "foam" })
  {
    rows.push_back(measure(synthetic(family, count)));
  }
  for (const DataSet& file : files)
  {
    rows.push_back(measure(file));
  }
  std::cout << std::fixed;
  printBakes(rows);
  printFrames(rows);
  printShares(rows);
}
}

int main(int argc, char* argv[])
{
  try
  {
    printTables({ argv + 1, argv + argc });
  }
  catch (const std::bad_alloc&)
  {
    std::cerr << argv[0] << ": there is not enough memory for so many spheres.\n";
    return EXIT_FAILURE;
  }
  catch (const std::exception& problem)
  {
    std::cerr << argv[0] << ": " << problem.what() << "\nUsage: " << argv[0]
              << " [COUNT] [FILE.vtp ...]\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
