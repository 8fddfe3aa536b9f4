// SPDX-License-Identifier: BSD-3-Clause
#include "vtkParticleTextReader.h"

#include "ElementRadii.h"
#include "ParticleText.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkParticleTextReader);

namespace
{
/// Columns of whole numbers in dumps.
bool isWhole(const std::string& name)
{
  static const std::set<std::string> names{ "id", "type", "mol", "proc", "procp1", "ix", "iy",
    "iz" };
  return names.count(name) > 0;
}

void setPoints(const po::ParticleFrame& frame, vtkPolyData* output)
{
  const auto count = static_cast<vtkIdType>(frame.positions.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkNew<vtkCellArray> vertices;
  vertices->AllocateExact(count, count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->SetPoint(i, &frame.positions[static_cast<std::size_t>(i)].x);
    vertices->InsertNextCell(1, &i);
  }
  output->SetPoints(points);
  output->SetVerts(vertices);
}

template <typename Array, typename Value>
void addArray(
  const std::string& name, const std::vector<Value>& values, vtkDataSetAttributes* target)
{
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    array->SetValue(static_cast<vtkIdType>(i), static_cast<typename Array::ValueType>(values[i]));
  }
  target->AddArray(array);
}

/// vtkStringArray has no ValueType.
void addWords(const po::TextColumn& column, vtkDataSetAttributes* target)
{
  vtkNew<vtkStringArray> array;
  array->SetName(column.name.c_str());
  array->SetNumberOfValues(static_cast<vtkIdType>(column.words.size()));
  for (std::size_t i = 0; i < column.words.size(); ++i)
  {
    array->SetValue(static_cast<vtkIdType>(i), column.words[i]);
  }
  target->AddArray(array);
  if (column.name == "element")
  {
    std::vector<int> numbers;
    std::transform(column.words.begin(), column.words.end(), std::back_inserter(numbers),
      [](const std::string& symbol) { return po::atomicNumberOf(symbol); });
    addArray<vtkIntArray>("atomic_number", numbers, target);
  }
}

const po::TextColumn* numbersNamed(const po::ParticleFrame& frame, const std::string& name)
{
  const auto found = std::find_if(frame.columns.begin(), frame.columns.end(),
    [&](const po::TextColumn& column) { return column.name == name && !column.isText(); });
  return found == frame.columns.end() ? nullptr : &*found;
}

/// The stem that a column shares with two others, which make a vector; else nothing.
std::string vectorOf(const po::ParticleFrame& frame, const std::string& name)
{
  const std::string stem = name.substr(0, name.empty() ? 0 : name.size() - 1);
  const bool isVector = !stem.empty() && !isWhole(name) && numbersNamed(frame, stem + "x") &&
    numbersNamed(frame, stem + "y") && numbersNamed(frame, stem + "z") &&
    std::string("xyz").find(name.back()) != std::string::npos;
  return isVector ? stem : std::string();
}

void addVector(
  const po::ParticleFrame& frame, const std::string& stem, vtkDataSetAttributes* target)
{
  vtkNew<vtkDoubleArray> array;
  const std::string name = stem.back() == '_' ? stem.substr(0, stem.size() - 1) : stem;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(frame.positions.size()));
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<double>& numbers = numbersNamed(frame, stem + "xyz"[axis])->numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      array->SetComponent(static_cast<vtkIdType>(i), axis, numbers[i]);
    }
  }
  target->AddArray(array);
}

void addColumn(
  const po::ParticleFrame& frame, const po::TextColumn& column, vtkDataSetAttributes* target)
{
  const std::string stem = column.isText() ? std::string() : vectorOf(frame, column.name);
  if (column.isText())
  {
    addWords(column, target);
  }
  else if (!stem.empty())
  {
    if (column.name.back() == 'x')
    {
      addVector(frame, stem, target);
    }
  }
  else if (isWhole(column.name))
  {
    addArray<vtkIdTypeArray>(column.name, column.numbers, target);
  }
  else
  {
    addArray<vtkDoubleArray>(column.name, column.numbers, target);
  }
}
}

struct vtkParticleTextReader::Internals
{
  struct Frame
  {
    std::string File;
    std::int64_t Offset;
    const po::ParticleTextFormat* Format;
  };

  std::vector<std::string> Files;
  std::map<double, Frame> Frames; ///< by time
  bool Found = false;             ///< the frames of all files
};

vtkParticleTextReader::vtkParticleTextReader()
  : Impl(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(0);
}

vtkParticleTextReader::~vtkParticleTextReader() = default;

void vtkParticleTextReader::AddFileName(const char* name)
{
  if (name && name[0] != '\0')
  {
    this->Impl->Files.emplace_back(name);
    this->Impl->Found = false;
    this->Modified();
  }
}

void vtkParticleTextReader::RemoveAllFileNames()
{
  this->Impl->Files.clear();
  this->Impl->Found = false;
  this->Modified();
}

int vtkParticleTextReader::GetNumberOfFileNames()
{
  return static_cast<int>(this->Impl->Files.size());
}

const char* vtkParticleTextReader::GetFileName(int i)
{
  const bool isOne = i >= 0 && i < this->GetNumberOfFileNames();
  return isOne ? this->Impl->Files[static_cast<std::size_t>(i)].c_str() : nullptr;
}

int vtkParticleTextReader::CanReadFile(const char* name)
{
  try
  {
    po::TextLines lines(name ? name : "");
    return po::formatOf(lines) != nullptr;
  }
  catch (const std::exception&)
  {
    return 0;
  }
}

void vtkParticleTextReader::Fail(const std::string& file, const char* what)
{
  this->SetErrorCode(vtkErrorCode::FileFormatError);
  vtkErrorMacro(<< "The file '" << file << "' " << what << ".");
}

void vtkParticleTextReader::FindFrames()
{
  if (this->Impl->Found)
  {
    return;
  }
  this->Impl->Frames.clear();
  this->Impl->Found = true;
  double next = 0; // of frames that are only counted
  for (const std::string& file : this->Impl->Files)
  {
    std::vector<po::FramePlace> places;
    const po::ParticleTextFormat* format = nullptr;
    try
    {
      po::TextLines lines(file);
      format = po::formatOf(lines);
      if (!format)
      {
        throw std::runtime_error("is neither a LAMMPS text dump nor XYZ: its first line is wrong");
      }
      lines.seek(0);
      format->findFrames(lines, places);
    }
    catch (const std::exception& error)
    {
      if (places.empty())
      {
        this->Fail(file, error.what());
      }
      else
      {
        vtkWarningMacro(<< "The file '" << file << "' " << error.what()
                        << ". The frames before it are read.");
      }
    }
    const bool isCounted = format == &po::xyzFormat();
    for (const po::FramePlace& place : places)
    {
      this->Impl->Frames[isCounted ? next : place.time] = { file, place.offset, format };
      ++next;
    }
  }
}

int vtkParticleTextReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  this->FindFrames();
  vtkInformation* info = outputVector->GetInformationObject(0);
  info->Remove(Pipeline::TIME_STEPS());
  info->Remove(Pipeline::TIME_RANGE());
  std::vector<double> times;
  for (const auto& frame : this->Impl->Frames)
  {
    times.push_back(frame.first);
  }
  if (!times.empty())
  {
    const double range[2] = { times.front(), times.back() };
    info->Set(Pipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    info->Set(Pipeline::TIME_RANGE(), range, 2);
  }
  return 1;
}

int vtkParticleTextReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  this->SetErrorCode(
    this->Impl->Frames.empty() ? vtkErrorCode::FileFormatError : vtkErrorCode::NoError);
  if (this->Impl->Files.empty())
  {
    vtkErrorMacro("There is no file to read: set FileNames.");
    return 1;
  }
  if (this->Impl->Frames.empty())
  {
    return 1; // which was said
  }
  vtkInformation* info = outputVector->GetInformationObject(0);
  auto* const key = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
  auto frame = this->Impl->Frames.begin();
  if (info->Has(key))
  {
    const auto after = this->Impl->Frames.upper_bound(info->Get(key));
    frame = after == frame ? frame : std::prev(after);
  }
  try
  {
    po::TextLines lines(frame->second.File);
    lines.seek(frame->second.Offset);
    const po::ParticleFrame particles = frame->second.Format->readFrame(lines,
      [this](double share)
      {
        this->UpdateProgress(share);
        return !this->CheckAbort();
      });
    if (this->CheckAbort())
    {
      return 1;
    }
    setPoints(particles, output);
    for (const po::TextColumn& column : particles.columns)
    {
      addColumn(particles, column, output->GetPointData());
    }
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), frame->first);
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    this->Fail(frame->second.File, error.what());
  }
  return 1;
}

void vtkParticleTextReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (const std::string& file : this->Impl->Files)
  {
    os << indent << "FileName: " << file << '\n';
  }
}
