// SPDX-License-Identifier: BSD-3-Clause
/// What ReuseUnchanged saves from one time step to the next.
///
///   BenchmarkSeries [--distance RADII] [--storage TYPE] [--light] FILE.vtp FILE.vtp
///   BenchmarkSeries [--distance RADII] [--storage TYPE] [--light] FAMILY PARTICLES SHARE...
///
/// Two files are two steps, with an array "radius"; of a synthetic family each SHARE of the
/// particles moves by a tenth of a radius: those that are highest, as in an avalanche, and as many
/// that are drawn. RADII [2] is MaximumDistance in mean radii, TYPE [0] that of
/// vtkSphereAmbientOcclusion::StorageType. Prints rows of a table: CPU seconds of the second step
/// as it is by default, and with ReuseUnchanged of the first and the second, the first over the
/// last of these, and the share of particles whose textures were reused. Ends with an error if
/// reuse changes a bit.

#include "SyntheticSpheres.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereAmbientOcclusion.h"
#include "vtkXMLPolyDataReader.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
using Particles = vtkSmartPointer<vtkPolyData>;

struct Options
{
  double distance = 2; ///< mean radii
  int storage = 0;
  bool light = false;
};

Particles readParticles(const std::string& file)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  if (!reader->GetOutput()->GetPointData()->GetArray("radius"))
  {
    throw std::runtime_error(file + ": there are no particles with an array \"radius\".");
  }
  return reader->GetOutput();
}

Particles makeParticles(const std::string& family, std::size_t count)
{
  const auto known = po::syntheticFamilyFromName(family);
  if (!known)
  {
    throw std::runtime_error(family + ": there is no such family.");
  }
  const po::SyntheticSpheres spheres = po::makeSyntheticSpheres(*known, count, 1);
  auto data = Particles::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> radii;
  radii->SetName("radius");
  for (std::size_t i = 0; i < spheres.radii.size(); ++i)
  {
    points->InsertNextPoint(spheres.centers[i].data());
    radii->InsertNextValue(spheres.radii[i]);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(radii);
  return data;
}

double meanRadius(vtkPolyData* data)
{
  vtkDataArray* radii = data->GetPointData()->GetArray("radius");
  double sum = 0;
  for (vtkIdType i = 0; i < radii->GetNumberOfTuples(); ++i)
  {
    sum += radii->GetComponent(i, 0);
  }
  return sum / static_cast<double>(radii->GetNumberOfTuples());
}

/// The numbers of all particles, those that move first at the front.
std::vector<vtkIdType> orderOfMoving(vtkPolyData* data, bool drawn)
{
  std::vector<vtkIdType> order(static_cast<std::size_t>(data->GetNumberOfPoints()));
  std::iota(order.begin(), order.end(), vtkIdType(0));
  if (drawn)
  {
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
  }
  else
  {
    std::sort(order.begin(), order.end(),
      [&](vtkIdType a, vtkIdType b) { return data->GetPoint(a)[2] > data->GetPoint(b)[2]; });
  }
  return order;
}

Particles moved(vtkPolyData* data, double share, bool drawn)
{
  auto result = Particles::New();
  result->DeepCopy(data);
  const std::vector<vtkIdType> order = orderOfMoving(data, drawn);
  const double shift = 0.1 * meanRadius(data);
  for (std::size_t k = 0; k < share * static_cast<double>(order.size()); ++k)
  {
    double p[3];
    data->GetPoint(order[k], p);
    result->GetPoints()->SetPoint(order[k], p[0] + shift, p[1], p[2]);
  }
  return result;
}

vtkSmartPointer<vtkSphereAmbientOcclusion> makeFilter(const Options& options, double radius)
{
  auto filter = vtkSmartPointer<vtkSphereAmbientOcclusion>::New();
  filter->SetMaximumDistance(options.distance * radius);
  filter->SetStorage(options.storage);
  filter->SetBakeLight(options.light);
  return filter;
}

/// @return CPU seconds
double execute(vtkSphereAmbientOcclusion* filter, vtkPolyData* data)
{
  filter->SetInputData(data);
  const std::clock_t cpu = std::clock();
  filter->Update();
  return static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
}

std::string tableOf(vtkSphereAmbientOcclusion* filter)
{
  vtkDataArray* table =
    filter->GetOutputDataObject(0)->GetFieldData()->GetArray("AmbientOcclusionTextures");
  return { static_cast<const char*>(table->GetVoidPointer(0)),
    static_cast<std::size_t>(table->GetNumberOfValues() * table->GetDataTypeSize()) };
}

void measure(
  const Options& options, const std::string& label, vtkPolyData* first, vtkPolyData* second)
{
  const double radius = meanRadius(first);
  const auto plain = makeFilter(options, radius);
  const double usual = execute(plain, second);
  const auto reusing = makeFilter(options, radius);
  reusing->ReuseUnchangedOn();
  const double full = execute(reusing, first);
  const double changes = execute(reusing, second);
  const auto fresh = makeFilter(options, radius);
  fresh->ReuseUnchangedOn();
  execute(fresh, second);
  if (tableOf(fresh) != tableOf(reusing))
  {
    throw std::runtime_error(label + ": textures that were reused differ from a bake.");
  }
  const auto particles = static_cast<double>(reusing->GetNumberOfParticles());
  std::printf("| %s | %.0f | %s | %.2f | %.2f | %.2f | %.1f | %.4f |\n", label.c_str(),
    options.distance, plain->GetMethodUsed(), usual, full, changes, usual / changes,
    static_cast<double>(reusing->GetNumberOfParticlesReused()) / particles);
  std::fflush(stdout);
}

int run(std::vector<std::string> words)
{
  Options options;
  const auto take = [&]
  {
    const std::string word = words.front();
    words.erase(words.begin());
    return word;
  };
  while (words.size() > 2 && words.front().compare(0, 2, "--") == 0)
  {
    const std::string name = take();
    options.distance = name == "--distance" ? std::stod(take()) : options.distance;
    options.storage = name == "--storage" ? std::stoi(take()) : options.storage;
    options.light = options.light || name == "--light";
  }
  if (words.size() < 2)
  {
    throw std::runtime_error("usage: BenchmarkSeries [--distance RADII] [--storage TYPE] [--light] "
                             "FILE.vtp FILE.vtp | FAMILY PARTICLES SHARE...");
  }
  if (words.size() == 2)
  {
    measure(options, words[1], readParticles(words[0]), readParticles(words[1]));
    return 0;
  }
  const std::string family = take();
  const Particles data = makeParticles(family, std::stoul(take()));
  for (const std::string& share : words)
  {
    for (const bool drawn : { false, true })
    {
      measure(options, family + ", " + share + (drawn ? " drawn" : " highest"), data,
        moved(data, std::stod(share), drawn));
    }
  }
  return 0;
}
}

int main(int argc, char** argv)
{
  try
  {
    return run({ argv + 1, argv + argc });
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
