// SPDX-License-Identifier: BSD-3-Clause
#include "TexturePaging.h"

#include "EncodedTextureFile.h"

#include "vtkPolyData.h"

#include <cstddef>
#include <exception>
#include <sstream>

namespace po
{
namespace
{
constexpr double BytesPerMiB = 1024 * 1024;

std::string tooSmall(double budget, std::size_t textureBytes)
{
  std::ostringstream text;
  text << "TextureBudget: " << budget << " MiB hold no texture of " << textureBytes
       << " bytes, so that all particles show their mean values; set a larger budget.";
  return text.str();
}
}

MapperMessages TexturePaging::update(vtkPolyData& points, const std::string& file, double budget)
{
  const Source source{ &points, points.GetMTime(), file };
  if (source == source_ && (budget == budget_ || file.empty()))
  {
    return {};
  }
  const bool isSameFile = source == source_ && file_;
  source_ = source;
  budget_ = budget;
  textures_ = {};
  ++version_;
  isErrorTaken_ = false;
  MapperMessages messages;
  try
  {
    if (!isSameFile)
    {
      file_.reset();
      open(points, file, messages.warnings);
    }
    if (file_)
    {
      page(budget, messages.warnings);
    }
  }
  catch (const std::exception& error)
  {
    file_.reset();
    messages.error =
      "TextureFile: " + std::string(error.what()) + " Spheres are drawn without ambient occlusion.";
  }
  return messages;
}

void TexturePaging::open(
  vtkPolyData& points, const std::string& file, std::vector<std::string>& warnings)
{
  if (file.empty())
  {
    return;
  }
  const auto opened = std::make_shared<EncodedTextureFile>(file);
  const std::string warning = opened->readParticles(points, rows_, means_);
  file_ = opened;
  if (!warning.empty())
  {
    warnings.push_back("TextureFile: " + warning);
  }
}

void TexturePaging::page(double budget, std::vector<std::string>& warnings)
{
  const std::size_t bytes = file_->format().textureBytes();
  const auto textures = static_cast<std::size_t>(file_->file().textureCount());
  const auto paged = std::make_shared<PagedTextures>(
    file_, textures, bytes, static_cast<std::size_t>(BytesPerMiB * budget));
  textures_ = OcclusionTextures(paged, file_->format(), rows_.data(), means_.data());
  if (paged->capacity() == 0 && textures > 0)
  {
    warnings.push_back(tooSmall(budget, bytes));
  }
}

bool TexturePaging::hasBakedLight() const
{
  return file_ && file_->file().parameters().hasBakedLight();
}

void TexturePaging::forget()
{
  *this = {};
}

std::string TexturePaging::takeError()
{
  if (isErrorTaken_ || !textures_.paged() || textures_.paged()->error().empty())
  {
    return {};
  }
  isErrorTaken_ = true;
  return "TextureFile: " + textures_.paged()->error() +
    " Particles whose textures are not in memory show their mean values; hide and show them to try "
    "again.";
}
}
