// SPDX-License-Identifier: BSD-3-Clause
#include "EncodedTextureFile.h"

#include "ExrFile.h"
#include "Gamma2.h"
#include "GeometryHash.h"
#include "OcclusionParameters.h"

#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace po
{
namespace
{
TexelFormat formatOf(const std::string& fileName, const OcclusionTextureFile& file)
{
  const OcclusionParameters& parameters = file.parameters();
  const long long resolution = parameters.getInteger("resolution");
  if (resolution != file.resolution())
  {
    refuseExr(fileName,
      "its tiles have " + std::to_string(file.resolution()) +
        " texels a side, but its parameters say resolution=" + std::to_string(resolution) +
        "; it is damaged, write it again.");
  }
  const std::string& encoding = parameters.get("encoding");
  if (encoding == Float32Linear)
  {
    return { file.resolution(), false };
  }
  if (encoding != UInt8Gamma2)
  {
    refuseExr(fileName,
      "its textures are encoded as \"" + encoding +
        "\", which this version does not know; use a newer version.");
  }
  const double maximum = parameters.getDouble("maximum");
  if (!(maximum >= 0) || !std::isfinite(maximum))
  {
    refuseExr(fileName, "its parameter maximum is negative or not finite; write it again.");
  }
  return { file.resolution(), true, maximum };
}
}

EncodedTextureFile::EncodedTextureFile(const std::string& fileName)
  : fileName_(fileName)
  , file_(fileName)
{
  withExrReadErrors(fileName, [this] { format_ = formatOf(fileName_, file_); });
  values_.resize(texelIndex(format_.resolution, format_.resolution, 0));
}

std::string EncodedTextureFile::checkParticles(vtkPointSet& points) const
{
  if (points.GetNumberOfPoints() != file_.particleCount())
  {
    throw std::runtime_error("\"" + fileName_ + "\" is for " +
      std::to_string(file_.particleCount()) + " particles, but the input has " +
      std::to_string(points.GetNumberOfPoints()) +
      " points; choose the data set that was baked, before any filter that removes points.");
  }
  const OcclusionParameters& parameters = file_.parameters();
  const std::string radii = parameters.has("radiusArray") ? parameters.get("radiusArray") : "";
  if (file_.geometry().empty() || file_.geometry() == hashGeometry(points, radii))
  {
    return {};
  }
  return "The textures of \"" + fileName_ +
    "\" were saved for particles of other positions, radii or order: the occlusion shown may be "
    "wrong. Choose the data set and time step that was baked, or bake again.";
}

void EncodedTextureFile::read(std::int32_t row, void* texels) const
{
  if (!format_.bytes)
  {
    file_.readTexture(row, static_cast<float*>(texels));
    return;
  }
  file_.readTexture(row, values_.data());
  std::transform(values_.begin(), values_.end(), static_cast<std::uint8_t*>(texels),
    [this](float value) { return encodeGamma2(value, format_.maximum); });
}
}
