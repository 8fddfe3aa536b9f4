// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_MapperInput_h
#define po_MapperInput_h

#include "BakedTextures.h"
#include "SphereCloud.h"
#include "SphereInput.h"

#include "vtkType.h"

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

class vtkPolyData;

namespace po
{
class SphereRenderer;

/// What a mapper is to report.
struct MapperMessages
{
  std::string
    error; ///< why nothing could be read; empty on success, and where nothing is asked for
  std::vector<std::string> warnings;
};

/// Reads the spheres that a mapper draws, and their baked textures; again only when the points or
/// the radii change.
class MapperInput
{
public:
  /// What the spheres were read from.
  using Source = std::tuple<vtkPolyData*, vtkMTimeType, RadiusSettings>;

  /// Gives the renderer the spheres of the points, none if they cannot be read.
  /// @param points may be null
  [[nodiscard]] MapperMessages update(
    vtkPolyData* points, const RadiusSettings& radii, SphereRenderer& renderer);

  /// The next update reads the spheres anew.
  void forget();

  [[nodiscard]] const Source& source() const { return source_; }
  [[nodiscard]] const OcclusionTextures& textures() const { return baked_.textures; }
  /// Is direct light in the textures?
  [[nodiscard]] bool hasBakedLight() const { return baked_.hasLight; }

  /// Another number for other textures.
  [[nodiscard]] std::uint64_t texturesVersion() const { return texturesVersion_; }

private:
  Source source_{ nullptr, 0, {} };
  BakedTextures baked_;
  std::uint64_t texturesVersion_ = 0;
};

/// World-parallel bounds of all spheres, in the coordinates of the points; left as they are if
/// there are none.
void boundsOf(const SphereCloud& cloud, double bounds[6]);
}

#endif
