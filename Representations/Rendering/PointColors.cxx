// SPDX-License-Identifier: BSD-3-Clause
#include "PointColors.h"

#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace po
{
namespace
{
std::uint8_t toByte(double value)
{
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

bool changesColors(const BlockStyles& styles)
{
  return std::any_of(styles.begin(), styles.end(),
    [](const auto& style) { return style.second.color || style.second.opacity; });
}
}

void PointColors::update(vtkPolyData& points, vtkUnsignedCharArray* mapped, vtkProperty& property,
  const BlockStyles& styles, std::uint64_t stylesVersion)
{
  const double* color = property.GetDiffuseColor();
  const Source source{ &points, points.GetMTime(), mapped, mapped ? mapped->GetMTime() : 0,
    stylesVersion, color[0], color[1], color[2], property.GetOpacity() };
  if (source == source_)
  {
    return;
  }
  source_ = source;
  std::vector<std::uint8_t> colors;
  if (changesColors(styles))
  {
    colors = withStyles(points, mapped, property, styles);
  }
  else if (mapped)
  {
    colors.assign(mapped->GetPointer(0), mapped->GetPointer(0) + mapped->GetNumberOfValues());
  }
  // VTK maps scalars again on many occasions; only other colours count.
  if (colors != rgba_)
  {
    rgba_ = std::move(colors);
    ++version_;
  }
}

std::vector<std::uint8_t> PointColors::withStyles(vtkPolyData& points, vtkUnsignedCharArray* mapped,
  vtkProperty& property, const BlockStyles& styles)
{
  const auto count = static_cast<std::size_t>(points.GetNumberOfPoints());
  const double* color = property.GetDiffuseColor();
  const std::array<std::uint8_t, 4> plain{ toByte(color[0]), toByte(color[1]), toByte(color[2]),
    toByte(property.GetOpacity()) };
  std::vector<std::uint8_t> own(4 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    std::copy_n(mapped ? mapped->GetPointer(4 * static_cast<vtkIdType>(i)) : plain.data(), 4,
      own.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  const BlockTable blocks = blockTableOf(points);
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const auto style = styles.find(blocks[b].flatIndex);
    const auto first = static_cast<std::size_t>(blocks[b].firstPoint);
    const std::size_t end =
      b + 1 < blocks.size() ? static_cast<std::size_t>(blocks[b + 1].firstPoint) : count;
    for (std::size_t i = first; style != styles.end() && i < end; ++i)
    {
      if (const auto& c = style->second.color)
      {
        own[4 * i] = toByte(c->x);
        own[4 * i + 1] = toByte(c->y);
        own[4 * i + 2] = toByte(c->z);
      }
      if (style->second.opacity)
      {
        own[4 * i + 3] = toByte(*style->second.opacity);
      }
    }
  }
  return own;
}

void hideInvisible(const std::vector<std::int64_t>& particles, const BlockTable& blocks,
  const BlockStyles& styles, const std::uint8_t* rgba, std::vector<std::uint8_t>& hidden)
{
  const auto isInvisible = [&](std::int64_t point)
  {
    const auto style =
      blocks.empty() ? styles.end() : styles.find(blockOf(blocks, point).flatIndex);
    return (style != styles.end() && !style->second.visible) || (rgba && rgba[4 * point + 3] == 0);
  };
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    if (isInvisible(particles[i]))
    {
      hidden.resize(particles.size());
      hidden[i] = 1;
    }
  }
}
}
