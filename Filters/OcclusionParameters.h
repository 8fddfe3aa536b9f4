// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_OcclusionParameters_h
#define po_OcclusionParameters_h

#include "ParticleOcclusionFiltersModule.h"

#include <string>
#include <utility>
#include <vector>

class vtkFieldData;

namespace po
{
/// Names of the arrays that a baked data set carries.
inline constexpr const char* OcclusionArray = "AmbientOcclusion";
inline constexpr const char* TextureIndexArray = "AmbientOcclusionTexture";
inline constexpr const char* TextureTableArray = "AmbientOcclusionTextures";
inline constexpr const char* TextureBasisArray = "AmbientOcclusionBasis";
inline constexpr const char* ParametersArray = "AmbientOcclusionParameters";

/// Values of the parameter "encoding".
inline constexpr const char* UInt8Gamma2 = "UInt8Gamma2";
inline constexpr const char* Float32Linear = "Float32Linear";

/// Is "1" where the textures hold direct light too, else missing.
inline constexpr const char* BakedLightParameter = "bakeLight";

/// Values of the parameter "storage"; without it the storage is Full.
inline constexpr const char* FullStorage = "Full";
inline constexpr const char* VariableSizeStorage = "VariableSize";
inline constexpr const char* CompressedStorage = "Compressed";
inline constexpr const char* OneValueStorage = "OneValue";

/// What is needed to decode and to reproduce a texture table: keys and values in a fixed order.
///
/// Stored as the field data vtkStringArray "AmbientOcclusionParameters", one "key=value" a tuple,
/// so that people can read it and every VTK file format keeps it. Keys, in this order: version,
/// method, resolution, samplesPerTexel, seed, encoding, gamma, maximum, and whatever else the bake
/// depended on. Numbers are written independently of the locale; doubles with 17 significant
/// digits, which makes them round-trip exactly.
class PARTICLEOCCLUSIONFILTERS_EXPORT OcclusionParameters
{
public:
  using Entry = std::pair<std::string, std::string>;

  /// Replaces the value of the key or appends the key. Throws std::invalid_argument for a key that
  /// is empty or contains '='.
  void set(const std::string& key, const std::string& value);
  void set(const std::string& key, const char* value);
  void set(const std::string& key, double value);
  void set(const std::string& key, long long value);
  void set(const std::string& key, int value);
  void set(const std::string& key, bool value); ///< "1" or "0"

  [[nodiscard]] bool has(const std::string& key) const;

  /// The value; throws a std::runtime_error that names the key when it is missing, not wholly a
  /// number, or out of the type's range.
  [[nodiscard]] const std::string& get(const std::string& key) const;
  [[nodiscard]] double getDouble(const std::string& key) const;
  [[nodiscard]] long long getInteger(const std::string& key) const;

  /// Do the textures hold direct light too? Pictures must not add any then.
  [[nodiscard]] bool hasBakedLight() const;

  [[nodiscard]] const std::vector<Entry>& entries() const { return list_; }

  /// "key=value" strings and back; fromStrings throws a std::runtime_error that quotes a string
  /// without '=' or without a key.
  [[nodiscard]] std::vector<std::string> toStrings() const;
  [[nodiscard]] static OcclusionParameters fromStrings(const std::vector<std::string>& strings);

  /// Adds or replaces the array "AmbientOcclusionParameters".
  void toFieldData(vtkFieldData* fieldData) const;

  /// Throws a std::runtime_error that names the array when it is missing or not of strings.
  [[nodiscard]] static OcclusionParameters fromFieldData(vtkFieldData* fieldData);

private:
  std::vector<Entry> list_;
};
}

#endif
