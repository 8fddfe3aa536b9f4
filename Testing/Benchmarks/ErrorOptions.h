// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ErrorOptions_h
#define po_ErrorOptions_h

// The command line of BenchmarkError, and what its options say of a scene and its textures.

#include "BakeSettings.h"

#include <cstddef>
#include <map>
#include <string>

namespace po
{
/// "--name value" pairs of the command line. All throw std::runtime_error that names the option.
class ErrorOptions
{
public:
  /// @param first the first argument that is an option
  ErrorOptions(int argc, char* argv[], int first);

  [[nodiscard]] std::string text(const std::string& name, const std::string& otherwise = {}) const;
  [[nodiscard]] std::string required(const std::string& name) const;

  /// A whole number from 0 to 2^30.
  [[nodiscard]] int number(const std::string& name, int otherwise) const;

private:
  std::map<std::string, std::string> values_;
};

[[nodiscard]] std::size_t texelCount(int resolution);
[[nodiscard]] std::size_t sphereCount(const ErrorOptions& options);
[[nodiscard]] int resolutionOf(const ErrorOptions& options);

/// The base name of a file; other names stay. Unusual conditions come behind it.
[[nodiscard]] std::string shortName(const ErrorOptions& options);

/// @param radius the mean one, in which --distance is counted
[[nodiscard]] BakeSettings settingsOf(const ErrorOptions& options, double radius);
}

#endif
