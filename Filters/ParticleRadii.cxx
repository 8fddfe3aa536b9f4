// SPDX-License-Identifier: BSD-3-Clause
#include "ParticleRadii.h"

#include "ElementRadii.h"
#include "RadiusEstimate.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <vector>

namespace po
{
namespace
{
using Names = std::vector<const char*>;

const Names& usualNames(RadiusSource source)
{
  static const Names names[] = { { "radius", "Radius", "rad", "r", "diameter" },
    { "diameter", "Diameter", "d" }, { "element", "atom_type", "Atomic Numbers", "atomic_number" },
    { "mass", "Mass", "m" } };
  return names[static_cast<int>(source)];
}

const char* contentOf(RadiusSource source)
{
  constexpr const char* contents[] = { "radii", "diameters", "elements", "masses" };
  return contents[static_cast<int>(source)];
}

bool isDiameter(std::string name)
{
  std::transform(name.begin(), name.end(), name.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name == "diameter";
}

std::string listArrays(vtkPointData& data)
{
  std::string names;
  for (int i = 0; i < data.GetNumberOfArrays(); ++i)
  {
    const char* name = data.GetArrayName(i);
    names += (names.empty() ? "" : ", ") + std::string(name ? name : "(unnamed)");
  }
  return names.empty() ? "The input has no point arrays."
                       : "The point arrays of the input are: " + names + ".";
}

std::string missing(vtkPointData& data, const RadiusSettings& resolved)
{
  std::ostringstream message;
  message << "RadiusArray: there is no point array ";
  if (resolved.array == RadiusSettings::Automatic)
  {
    message << "that is known for " << contentOf(resolved.from) << " (";
    const char* separator = "";
    for (const char* name : usualNames(resolved.from))
    {
      message << separator << name;
      separator = ", ";
    }
    message << "): choose one. ";
  }
  else
  {
    message << "'" << resolved.array << "'. ";
  }
  message << listArrays(data);
  return message.str();
}

/// The array of that name, if radii can be read from it.
vtkAbstractArray* findArray(vtkPointSet& points, const RadiusSettings& resolved, std::string& error)
{
  const std::string& name = resolved.array;
  vtkAbstractArray* found = points.GetPointData()->GetAbstractArray(name.c_str());
  const bool readable = vtkDataArray::SafeDownCast(found) ||
    (resolved.from == RadiusSource::Element && vtkStringArray::SafeDownCast(found));
  std::ostringstream message;
  if (!found)
  {
    message << missing(*points.GetPointData(), resolved);
  }
  else if (!readable)
  {
    message << "RadiusArray: the point array '" << name << "' is not numeric ("
            << found->GetClassName() << "); choose an array of one number a particle.";
  }
  else if (found->GetNumberOfComponents() != 1)
  {
    message << "RadiusArray: the point array '" << name << "' has "
            << found->GetNumberOfComponents()
            << " components; a radius needs exactly one. Choose another array.";
  }
  else if (found->GetNumberOfTuples() != points.GetNumberOfPoints())
  {
    message << "RadiusArray: the point array '" << name << "' has " << found->GetNumberOfTuples()
            << " values for " << points.GetNumberOfPoints()
            << " points; there must be one a point.";
  }
  error = message.str();
  return error.empty() ? found : nullptr;
}

/// Volume of a sphere = mass / density.
RadiusFunction radiiOfMasses(vtkDataArray* masses, double density)
{
  constexpr double Pi = 3.14159265358979323846;
  return [masses, perMass = 3 / (4 * Pi * density)](std::size_t i)
  { return std::cbrt(perMass * masses->GetComponent(static_cast<vtkIdType>(i), 0)); };
}

RadiusFunction scaledValues(vtkDataArray* values, double factor)
{
  return [values, factor](std::size_t i)
  { return factor * values->GetComponent(static_cast<vtkIdType>(i), 0); };
}

RadiusFunction radiiOfElements(vtkAbstractArray* elements)
{
  if (auto* symbols = vtkStringArray::SafeDownCast(elements))
  {
    return [symbols](std::size_t i)
    { return vanDerWaalsRadius(atomicNumberOf(symbols->GetValue(static_cast<vtkIdType>(i)))); };
  }
  return [numbers = vtkDataArray::SafeDownCast(elements)](std::size_t i)
  {
    const double number = numbers->GetComponent(static_cast<vtkIdType>(i), 0);
    const bool isWhole = number >= 1 && number <= 1000 && number == std::floor(number);
    return vanDerWaalsRadius(isWhole ? static_cast<int>(number) : 0);
  };
}

/// The first usual array of one component that no process with points lacks; else nothing.
std::string usualArray(vtkPointSet& points, RadiusSource source, const ProcessGroup& group)
{
  const Names& names = usualNames(source);
  std::uint64_t missing = 0;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    vtkAbstractArray* array = points.GetPointData()->GetAbstractArray(names[i]);
    const bool usable = array && array->GetNumberOfComponents() == 1;
    missing |= std::uint64_t(points.GetNumberOfPoints() > 0 && !usable) << i;
  }
  for (const std::uint64_t missingElsewhere : group.gather({ missing }))
  {
    missing |= missingElsewhere;
  }
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    if ((missing >> i & 1) == 0)
    {
      return names[i];
    }
  }
  return {};
}

void chooseUsualArray(vtkPointSet& points, RadiusSettings& settings, const ProcessGroup& group)
{
  settings.array = usualArray(points, settings.from, group);
  if (settings.array.empty() && settings.from == RadiusSource::Array && settings.constant == 0)
  {
    settings.array = usualArray(points, RadiusSource::Element, group);
    settings.from = settings.array.empty() ? RadiusSource::Array : RadiusSource::Element;
  }
  if (settings.array.empty())
  {
    settings.array =
      settings.from == RadiusSource::Array ? RadiusSettings::NoArray : RadiusSettings::Automatic;
  }
}
}

bool checkRange(const RadiusSettings& settings, std::string& error)
{
  std::ostringstream message;
  if (!(settings.scale > 0) || !std::isfinite(settings.scale))
  {
    message << "RadiusScale must be a positive number, but is " << settings.scale << ".";
  }
  else if (!(settings.constant >= 0) || !std::isfinite(settings.constant))
  {
    message << "ConstantRadius must be positive, or 0 for an estimate from the spacing, but is "
            << settings.constant << ".";
  }
  else if (!(settings.density > 0) || !std::isfinite(settings.density))
  {
    message << "Density must be a positive number, but is " << settings.density << ".";
  }
  else if (settings.from < RadiusSource::Array || settings.from > RadiusSource::Mass)
  {
    message << "RadiusFrom must be between 0 and 3, but is " << static_cast<int>(settings.from)
            << ".";
  }
  error = message.str();
  return error.empty();
}

RadiusFunction radiusFunction(
  vtkPointSet& points, const RadiusSettings& resolved, std::string& error)
{
  if (resolved.array == RadiusSettings::NoArray)
  {
    if (!(resolved.constant > 0))
    {
      error = "No radius can be estimated from the spacing, since there are no two distinct finite "
              "points: choose a RadiusArray or set ConstantRadius.";
      return {};
    }
    return [radius = resolved.constant](std::size_t) { return radius; };
  }
  vtkAbstractArray* array = findArray(points, resolved, error);
  if (!array)
  {
    return {};
  }
  auto* numbers = vtkDataArray::SafeDownCast(array);
  switch (resolved.from)
  {
    case RadiusSource::Element:
      return radiiOfElements(array);
    case RadiusSource::Mass:
      return radiiOfMasses(numbers, resolved.density);
    case RadiusSource::Diameter:
      return scaledValues(numbers, 0.5);
    default:
      return scaledValues(numbers, isDiameter(resolved.array) ? 0.5 : 1.0);
  }
}

RadiusSettings resolveRadii(
  vtkPointSet& points, const RadiusSettings& settings, const ProcessGroup& group)
{
  RadiusSettings resolved = settings;
  if (settings.array.empty() || settings.array == RadiusSettings::Automatic)
  {
    chooseUsualArray(points, resolved, group);
  }
  if (resolved.array == RadiusSettings::NoArray && settings.constant == 0)
  {
    resolved.constant = estimateRadius(points, group);
  }
  return resolved;
}

std::string describe(const RadiusSettings& asked, const RadiusSettings& resolved)
{
  std::ostringstream text;
  if (resolved.array == RadiusSettings::NoArray)
  {
    text << resolved.constant * resolved.scale << " for all";
    text << (asked.constant > 0 ? "" : ", estimated from the spacing");
    return text.str();
  }
  const bool halved = resolved.from == RadiusSource::Diameter ||
    (resolved.from == RadiusSource::Array && isDiameter(resolved.array));
  if (resolved.from == RadiusSource::Element)
  {
    text << u8"van der Waals radii in Å of the elements in ";
  }
  else if (resolved.from == RadiusSource::Mass)
  {
    text << "spheres of density " << resolved.density << " with the masses in ";
  }
  text << (halved ? "half of " : "") << "point array " << resolved.array;
  if (resolved.scale != 1)
  {
    text << ", times " << resolved.scale;
  }
  return text.str();
}
}
