// SPDX-License-Identifier: BSD-3-Clause
#include "pqBakeEstimate.h"

#include "BakeCost.h"

#include "pqCoreUtilities.h"
#include "vtkCommand.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

namespace
{
constexpr const char* Settings[] = { "TextureResolution", "SamplesPerTexel", "TargetError",
  "Method", "Encoding", "BakeLight" };

int chosen(vtkSMProxy* proxy, const char* name)
{
  return vtkSMUncheckedPropertyHelper(proxy, name).GetAsInt();
}

double told(vtkSMProxy* proxy, const char* name)
{
  proxy->UpdatePropertyInformation(proxy->GetProperty(name));
  return vtkSMPropertyHelper(proxy, name).GetAsDouble();
}
}

pqBakeEstimate::pqBakeEstimate(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
  : Superclass(proxy, property, parent)
{
  for (const char* name : Settings)
  {
    pqCoreUtilities::connect(
      proxy->GetProperty(name), vtkCommand::UncheckedPropertyModifiedEvent, this, SLOT(refresh()));
  }
  this->refresh();
}

std::size_t pqBakeEstimate::particles() const
{
  vtkSMPropertyHelper input(this->proxy(), "Input");
  auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  return source ? static_cast<std::size_t>(
                    source->GetDataInformation(input.GetOutputPort())->GetNumberOfPoints())
                : 0;
}

void pqBakeEstimate::refresh()
{
  po::BakeWork work;
  work.particles = this->particles();
  work.method = chosen(this->proxy(), "Method");
  work.settings.textureResolution = chosen(this->proxy(), "TextureResolution");
  work.settings.samplesPerTexel = chosen(this->proxy(), "SamplesPerTexel");
  work.settings.encoding = static_cast<po::Encoding>(chosen(this->proxy(), "Encoding"));
  if (chosen(this->proxy(), "BakeLight") != 0)
  {
    work.settings.light.emplace();
  }
  work.targetError = vtkSMUncheckedPropertyHelper(this->proxy(), "TargetError").GetAsDouble();
  const std::string text = po::describe(po::estimateCost(work), work.particles,
    static_cast<int>(told(this->proxy(), "NumberOfCores")), told(this->proxy(), "FreeMemory"));
  this->show(QString::fromStdString(text));
}
