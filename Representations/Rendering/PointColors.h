// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_PointColors_h
#define po_PointColors_h

#include "BlockTable.h"
#include "Vec3.h"

#include "vtkType.h"

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

class vtkPolyData;
class vtkProperty;
class vtkUnsignedCharArray;

namespace po
{
/// How the points of one block differ from the others.
struct BlockStyle
{
  bool visible = true;
  std::optional<Vec3d> color; ///< in place of the array's and the property's
  std::optional<double> opacity;
};

using BlockStyles = std::map<unsigned, BlockStyle>; ///< by flat index

/// RGBA of each point, from mapped scalars and the colours of blocks.
class PointColors
{
public:
  /// @param mapped RGBA of each point as the lookup table gives it, opacity included, or null
  /// @param stylesVersion another number for other styles
  void update(vtkPolyData& points, vtkUnsignedCharArray* mapped, vtkProperty& property,
    const BlockStyles& styles, std::uint64_t stylesVersion);

  /// Null where all points have the property's colour and opacity.
  [[nodiscard]] const std::uint8_t* rgba() const { return rgba_.empty() ? nullptr : rgba_.data(); }

  /// Another number for other contents.
  [[nodiscard]] std::uint64_t version() const { return version_; }

private:
  using Source = std::tuple<vtkPolyData*, vtkMTimeType, vtkUnsignedCharArray*, vtkMTimeType,
    std::uint64_t, double, double, double, double>;

  static std::vector<std::uint8_t> withStyles(vtkPolyData& points, vtkUnsignedCharArray* mapped,
    vtkProperty& property, const BlockStyles& styles);

  Source source_{};
  std::vector<std::uint8_t> rgba_;
  std::uint64_t version_ = 0;
};

/// Of each sphere 1 if its block is not visible, or its colour has no opacity; added to `hidden`,
/// which may be empty.
/// @param rgba of each point, or null
void hideInvisible(const std::vector<std::int64_t>& particles, const BlockTable& blocks,
  const BlockStyles& styles, const std::uint8_t* rgba, std::vector<std::uint8_t>& hidden);
}

#endif
