// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorOptions.h"

#include "BenchmarkScenes.h"

#include <stdexcept>

namespace po
{
ErrorOptions::ErrorOptions(int argc, char* argv[], int first)
{
  for (int i = first; i < argc; i += 2)
  {
    const std::string name = argv[i];
    if (name.compare(0, 2, "--") != 0 || i + 1 == argc)
    {
      throw std::runtime_error("'" + name + "' is no option with a value");
    }
    values_[name.substr(2)] = argv[i + 1];
  }
}

std::string ErrorOptions::text(const std::string& name, const std::string& otherwise) const
{
  const auto found = values_.find(name);
  return found == values_.end() ? otherwise : found->second;
}

std::string ErrorOptions::required(const std::string& name) const
{
  const std::string value = text(name);
  if (value.empty())
  {
    throw std::runtime_error("--" + name + " is missing");
  }
  return value;
}

int ErrorOptions::number(const std::string& name, int otherwise) const
{
  const std::string value = text(name, std::to_string(otherwise));
  const bool digits = !value.empty() && value.size() <= 10 &&
    value.find_first_not_of("0123456789") == std::string::npos;
  if (!digits || std::stoull(value) > 1u << 30)
  {
    throw std::runtime_error("--" + name + " must be a whole number, not '" + value + "'");
  }
  return std::stoi(value);
}

std::size_t texelCount(int resolution)
{
  return static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution);
}

std::size_t sphereCount(const ErrorOptions& options)
{
  return static_cast<std::size_t>(options.number("count", 30000));
}

int resolutionOf(const ErrorOptions& options)
{
  const int resolution = options.number("resolution", 16);
  if (resolution < 1 || resolution > BakeSettings::MaximumTextureResolution)
  {
    throw std::runtime_error("--resolution must be from 1 to 64");
  }
  return resolution;
}

std::string shortName(const ErrorOptions& options)
{
  const std::string scene = options.required("scene");
  const std::size_t slash = scene.find_last_of('/');
  const std::string name = slash == std::string::npos ? scene : scene.substr(slash + 1);
  const std::size_t dot = name.rfind(".vtp");
  std::string result = name.substr(0, dot);
  for (const char* condition : { "background", "distance" })
  {
    const std::string value = options.text(condition);
    result += value.empty() ? "" : "-" + value;
  }
  return result;
}

BakeSettings settingsOf(const ErrorOptions& options, double radius)
{
  BakeSettings settings;
  settings.textureResolution = resolutionOf(options);
  if (!options.text("background").empty())
  {
    settings.background = makeBenchmarkBackground(options.text("background"));
  }
  settings.maximumDistance = options.number("distance", 0) * radius;
  return settings;
}
}
