// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionParameters.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

namespace po
{
namespace
{
template <typename Number>
Number parse(const std::string& key, const std::string& text)
{
  Number number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end)
  {
    throw std::runtime_error(
      "Parameter \"" + key + "\" of the texture table is \"" + text + "\", not a valid number.");
  }
  return number;
}

auto find(const std::vector<OcclusionParameters::Entry>& list, const std::string& key)
{
  return std::find_if(
    list.begin(), list.end(), [&](const auto& entry) { return entry.first == key; });
}
}

void OcclusionParameters::set(const std::string& key, const std::string& value)
{
  if (key.empty() || key.find('=') != std::string::npos)
  {
    throw std::invalid_argument("\"" + key + "\" cannot be the key of a parameter.");
  }
  const auto found = find(list_, key);
  if (found == list_.end())
  {
    list_.emplace_back(key, value);
  }
  else
  {
    list_[found - list_.begin()].second = value;
  }
}

void OcclusionParameters::set(const std::string& key, const char* value)
{
  set(key, std::string(value));
}

void OcclusionParameters::set(const std::string& key, double value)
{
  std::array<char, 32> text;
  const auto result =
    std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 17);
  set(key, std::string(text.data(), result.ptr));
}

void OcclusionParameters::set(const std::string& key, long long value)
{
  set(key, std::to_string(value));
}

void OcclusionParameters::set(const std::string& key, int value)
{
  set(key, std::to_string(value));
}

void OcclusionParameters::set(const std::string& key, bool value)
{
  set(key, value ? "1" : "0");
}

bool OcclusionParameters::has(const std::string& key) const
{
  return find(list_, key) != list_.end();
}

const std::string& OcclusionParameters::get(const std::string& key) const
{
  const auto found = find(list_, key);
  if (found == list_.end())
  {
    throw std::runtime_error("The texture table does not say its \"" + key +
      "\": the field data \"" + std::string(ParametersArray) +
      "\" lacks it; bake the textures again.");
  }
  return found->second;
}

double OcclusionParameters::getDouble(const std::string& key) const
{
  return parse<double>(key, get(key));
}

long long OcclusionParameters::getInteger(const std::string& key) const
{
  return parse<long long>(key, get(key));
}

bool OcclusionParameters::hasBakedLight() const
{
  return has(BakedLightParameter) && getInteger(BakedLightParameter) != 0;
}

std::vector<std::string> OcclusionParameters::toStrings() const
{
  std::vector<std::string> strings;
  for (const Entry& entry : list_)
  {
    strings.push_back(entry.first + '=' + entry.second);
  }
  return strings;
}

OcclusionParameters OcclusionParameters::fromStrings(const std::vector<std::string>& strings)
{
  OcclusionParameters parameters;
  for (const std::string& text : strings)
  {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos)
    {
      throw std::runtime_error(
        "Parameter \"" + text + "\" of the texture table is not of the form key=value.");
    }
    parameters.set(text.substr(0, equals), text.substr(equals + 1));
  }
  return parameters;
}

void OcclusionParameters::toFieldData(vtkFieldData* fieldData) const
{
  vtkNew<vtkStringArray> array;
  array->SetName(ParametersArray);
  for (const std::string& text : toStrings())
  {
    array->InsertNextValue(text);
  }
  fieldData->AddArray(array);
}

OcclusionParameters OcclusionParameters::fromFieldData(vtkFieldData* fieldData)
{
  auto* array = vtkStringArray::SafeDownCast(fieldData->GetAbstractArray(ParametersArray));
  if (!array)
  {
    throw std::runtime_error("The data has no string array \"" + std::string(ParametersArray) +
      "\" in its field data; bake it with Sphere Ambient Occlusion first.");
  }
  std::vector<std::string> strings;
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    strings.push_back(array->GetValue(i));
  }
  return fromStrings(strings);
}
}
