// SPDX-License-Identifier: BSD-3-Clause
#include "EncodedTextureFile.h"

#include "ExrFile.h"
#include "Gamma2.h"
#include "GeometryHash.h"
#include "OcclusionParameters.h"

#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
#include <numeric>
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

std::string EncodedTextureFile::radiusArray() const
{
  const OcclusionParameters& parameters = file_.parameters();
  return parameters.has("radiusArray") ? parameters.get("radiusArray") : "";
}

bool EncodedTextureFile::isSameGeometry(vtkPointSet& points) const
{
  return points.GetNumberOfPoints() == file_.particleCount() &&
    (file_.geometry().empty() || file_.geometry() == hashGeometry(points, radiusArray()));
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
  if (isSameGeometry(points))
  {
    return {};
  }
  return "The textures of \"" + fileName_ +
    "\" were saved for particles of other positions, radii or order: the occlusion shown may be "
    "wrong. Choose the data set and time step that was baked, or bake again.";
}

std::string EncodedTextureFile::readParticles(
  vtkPointSet& points, std::vector<std::int32_t>& rows, std::vector<float>& means) const
{
  const bool isSame = isSameGeometry(points);
  if (!isSame && file_.hasPlaces() && findByPlace(points, rows, means))
  {
    return {};
  }
  std::string warning = isSame ? std::string() : checkParticles(points);
  rows.resize(static_cast<std::size_t>(points.GetNumberOfPoints()));
  means.resize(rows.size());
  file_.readParticles(rows.data(), means.data());
  return warning;
}

/// False if a point is none of the particles.
bool EncodedTextureFile::findByPlace(
  vtkPointSet& points, std::vector<std::int32_t>& rows, std::vector<float>& means) const
{
  const std::vector<PlaceHash> known = file_.readPlaces();
  std::vector<std::uint32_t> order(known.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
    [&](std::uint32_t a, std::uint32_t b) { return known[a] < known[b]; });
  std::vector<std::int32_t> allRows(known.size());
  std::vector<float> allMeans(known.size());
  file_.readParticles(allRows.data(), allMeans.data());
  rows.clear();
  means.clear();
  for (const PlaceHash& place : placeHashes(points, radiusArray()))
  {
    const auto found = std::lower_bound(order.begin(), order.end(), place,
      [&](std::uint32_t particle, const PlaceHash& wanted) { return known[particle] < wanted; });
    if (found == order.end() || known[*found] != place)
    {
      return false;
    }
    rows.push_back(allRows[*found]);
    means.push_back(allMeans[*found]);
  }
  return true;
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
