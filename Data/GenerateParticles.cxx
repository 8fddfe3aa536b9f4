// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Writes synthetic spheres (SyntheticSpheres.h) as VTK PolyData: one vertex cell a point, point
 * data `radius`, inline binary XML with zlib.
 */
#include "SyntheticSpheres.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <system_error>

namespace
{
constexpr const char* Usage = "usage: GenerateParticles FAMILY COUNT FILE.vtp [SEED]\n"
                              "  FAMILY  pack, overlap, gas, shell or foam\n"
                              "  COUNT   number of spheres, at least 1\n"
                              "  FILE    is replaced if it exists\n"
                              "  SEED    whole number, 1 by default; same seed, same spheres\n";

struct Request
{
  po::SyntheticFamily family;
  std::size_t count;
  std::filesystem::path file;
  std::uint64_t seed = 1;
};

std::uint64_t parseNumber(const std::string& text, const char* what)
{
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  if (parsed.ec != std::errc() || parsed.ptr != end)
  {
    throw std::invalid_argument(std::string(what) + " must be a whole number, not '" + text + "'");
  }
  return value;
}

Request parseArguments(int argc, char* argv[])
{
  if (argc != 4 && argc != 5)
  {
    throw std::invalid_argument("three or four arguments are expected");
  }
  const auto family = po::syntheticFamilyFromName(argv[1]);
  if (!family)
  {
    throw std::invalid_argument("there is no family '" + std::string(argv[1]) + "'");
  }
  Request request{ *family, parseNumber(argv[2], "COUNT"), argv[3] };
  if (request.count == 0)
  {
    throw std::invalid_argument("COUNT must be at least 1");
  }
  if (request.file.extension() != ".vtp")
  {
    throw std::invalid_argument("FILE must end in .vtp");
  }
  if (argc == 5)
  {
    request.seed = parseNumber(argv[4], "SEED");
  }
  return request;
}

/// One vertex cell a point, as most readers of particle files make it.
vtkSmartPointer<vtkCellArray> makeVertices(vtkIdType count)
{
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> points;
  offsets->SetNumberOfValues(count + 1);
  points->SetNumberOfValues(count);
  std::iota(offsets->Begin(), offsets->End(), 0);
  std::iota(points->Begin(), points->End(), 0);
  auto vertices = vtkSmartPointer<vtkCellArray>::New();
  vertices->SetData(offsets, points);
  return vertices;
}

vtkSmartPointer<vtkPolyData> makePolyData(const po::SyntheticSpheres& spheres)
{
  const auto count = static_cast<vtkIdType>(spheres.radii.size());
  vtkNew<vtkPoints> points; // single precision, as the spheres
  points->SetNumberOfPoints(count);
  auto* xyz = static_cast<float*>(points->GetVoidPointer(0));
  for (const auto& center : spheres.centers)
  {
    xyz = std::copy(center.begin(), center.end(), xyz);
  }
  vtkNew<vtkFloatArray> radius;
  radius->SetName("radius");
  radius->SetNumberOfValues(count);
  std::copy(spheres.radii.begin(), spheres.radii.end(), radius->Begin());

  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(makeVertices(count));
  data->GetPointData()->AddArray(radius);
  return data;
}

/// Writes beside the file and renames, so that an interrupted run leaves no half file.
void writeFile(vtkPolyData* data, const std::filesystem::path& file)
{
  std::filesystem::path part = file;
  part += ".part";
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(part.c_str());
  writer->SetDataModeToBinary(); // ParaView 5.11 of Debian 12 cannot read appended data
  writer->SetCompressorTypeToZLib();
  std::error_code failed;
  if (writer->Write() == 1)
  {
    std::filesystem::rename(part, file, failed);
    if (!failed)
    {
      return;
    }
  }
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  throw std::runtime_error("cannot write '" + file.string() +
    "': check that its folder exists, may be written to and has space left");
}
}

int main(int argc, char* argv[])
{
  vtkObject::GlobalWarningDisplayOff(); // what fails is reported here, once
  try
  {
    const Request request = parseArguments(argc, argv);
    writeFile(makePolyData(po::makeSyntheticSpheres(request.family, request.count, request.seed)),
      request.file);
    return EXIT_SUCCESS;
  }
  catch (const std::invalid_argument& error)
  {
    std::cerr << "GenerateParticles: " << error.what() << "\n" << Usage;
  }
  catch (const std::bad_alloc&)
  {
    std::cerr << "GenerateParticles: not enough memory for so many spheres\n";
  }
  catch (const std::exception& error)
  {
    std::cerr << "GenerateParticles: " << error.what() << "\n";
  }
  return EXIT_FAILURE;
}
