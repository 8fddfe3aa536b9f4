// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BakedTextures_h
#define po_BakedTextures_h

// Baked occlusion of a data set, checked and made ready for the renderer; the names of the arrays
// are in OcclusionParameters.h.

#include "OcclusionTextures.h"
#include "ParticleOcclusionFiltersModule.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkPointSet;

namespace po
{
/// Textures together with the arrays that they refer to.
struct BakedTextures
{
  OcclusionTextures textures;
  vtkSmartPointer<vtkDataArray> table;          ///< uint8 or float32, one tuple a texture
  vtkSmartPointer<vtkDataArray> rows;           ///< int32, one value a point
  vtkSmartPointer<vtkDataArray> means;          ///< float32, one value a point, or null
  std::shared_ptr<const PackedTextures> packed; ///< of textures of different lengths, or null
  bool hasLight = false;                        ///< direct light is in the textures
};

/// Textures of different lengths as rows of a table of T x T texels.
struct ExpandedRows
{
  std::vector<std::size_t> firsts; ///< first word of each row's texture
  std::vector<std::int32_t> rows;  ///< of each point; negative: none
};

/// The textures that points refer to, in the order of their first use; of packed ones only.
[[nodiscard]] ExpandedRows expandRows(const BakedTextures& baked);

/// The baked occlusion of `points`. Data without any of the arrays give empty textures and no
/// warning; with an array that is missing or wrong, `warning` names it and the textures are empty.
[[nodiscard]] PARTICLEOCCLUSIONFILTERS_EXPORT BakedTextures readBakedTextures(
  vtkPointSet& points, std::string& warning);
}

#endif
