// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_HiddenSpheres_h
#define po_HiddenSpheres_h

#include "CropSettings.h"
#include "MapperInput.h"
#include "ParticleFilter.h"
#include "PointColors.h"

#include "vtkType.h"

#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace po
{
/// What decides which spheres of a mapper are hidden.
struct HidingRules
{
  std::vector<HalfSpace> halfSpaces;
  std::vector<CropRange> ranges;
  const BlockStyles& styles;
  std::uint64_t stylesVersion = 0;     ///< another number for other styles
  const PointColors* colors = nullptr; ///< those without opacity hide; null: none does
};

/// Hides spheres from a renderer; again only when the spheres or the rules change.
class HiddenSpheres
{
public:
  /// @param input that the renderer's spheres were read with, from `points`
  /// @return a warning about a range that cannot be applied, empty if all can
  [[nodiscard]] std::string update(vtkPolyData& points, const MapperInput& input,
    const HidingRules& rules, SphereRenderer& renderer);

  /// None is hidden until the next update.
  void forget() { *this = {}; }

  /// Of the last update.
  [[nodiscard]] vtkIdType count() const { return count_; }

private:
  using Source = std::tuple<MapperInput::Source, std::vector<std::array<double, 4>>,
    std::vector<CropRange>, std::uint64_t, std::uint64_t>;

  Source source_;
  vtkIdType count_ = 0;
};
}

#endif
