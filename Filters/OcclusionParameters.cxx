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
Number Parse(const std::string& key, const std::string& text)
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

auto Find(const std::vector<OcclusionParameters::Entry>& list, const std::string& key)
{
  return std::find_if(
    list.begin(), list.end(), [&](const auto& entry) { return entry.first == key; });
}

}

void OcclusionParameters::Set(const std::string& key, const std::string& value)
{
  if (key.empty() || key.find('=') != std::string::npos)
  {
    throw std::invalid_argument("\"" + key + "\" cannot be the key of a parameter.");
  }
  const auto found = Find(this->List, key);
  if (found == this->List.end())
  {
    this->List.emplace_back(key, value);
  }
  else
  {
    this->List[found - this->List.begin()].second = value;
  }
}

void OcclusionParameters::Set(const std::string& key, const char* value)
{
  this->Set(key, std::string(value));
}

void OcclusionParameters::Set(const std::string& key, double value)
{
  std::array<char, 32> text;
  const auto result =
    std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 17);
  this->Set(key, std::string(text.data(), result.ptr));
}

void OcclusionParameters::Set(const std::string& key, long long value)
{
  this->Set(key, std::to_string(value));
}

void OcclusionParameters::Set(const std::string& key, int value)
{
  this->Set(key, std::to_string(value));
}

void OcclusionParameters::Set(const std::string& key, bool value)
{
  this->Set(key, value ? "1" : "0");
}

bool OcclusionParameters::Has(const std::string& key) const
{
  return Find(this->List, key) != this->List.end();
}

const std::string& OcclusionParameters::Get(const std::string& key) const
{
  const auto found = Find(this->List, key);
  if (found == this->List.end())
  {
    throw std::runtime_error("The texture table does not say its \"" + key +
      "\": the field data \"" + std::string(ParametersArray) +
      "\" lacks it; bake the textures again.");
  }
  return found->second;
}

double OcclusionParameters::GetDouble(const std::string& key) const
{
  return Parse<double>(key, this->Get(key));
}

long long OcclusionParameters::GetInteger(const std::string& key) const
{
  return Parse<long long>(key, this->Get(key));
}

std::vector<std::string> OcclusionParameters::ToStrings() const
{
  std::vector<std::string> strings;
  for (const Entry& entry : this->List)
  {
    strings.push_back(entry.first + '=' + entry.second);
  }
  return strings;
}

OcclusionParameters OcclusionParameters::FromStrings(const std::vector<std::string>& strings)
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
    parameters.Set(text.substr(0, equals), text.substr(equals + 1));
  }
  return parameters;
}

void OcclusionParameters::ToFieldData(vtkFieldData* fieldData) const
{
  vtkNew<vtkStringArray> array;
  array->SetName(ParametersArray);
  for (const std::string& text : this->ToStrings())
  {
    array->InsertNextValue(text);
  }
  fieldData->AddArray(array);
}

OcclusionParameters OcclusionParameters::FromFieldData(vtkFieldData* fieldData)
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
  return FromStrings(strings);
}

}
