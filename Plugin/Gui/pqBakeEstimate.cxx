// SPDX-License-Identifier: BSD-3-Clause
#include "pqBakeEstimate.h"

#include "BakeCost.h"

#include "pqCoreUtilities.h"
#include "vtkCommand.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

namespace
{
constexpr const char* Settings[] = { "TextureResolution", "SamplesPerTexel", "TargetError",
  "Method", "Encoding", "Storage", "BakeLight", "MaximumDistance", "ReuseUnchanged" };

int chosen(vtkSMProxy* proxy, const char* name)
{
  return vtkSMUncheckedPropertyHelper(proxy, name).GetAsInt();
}

double chosenNumber(vtkSMProxy* proxy, const char* name)
{
  return vtkSMUncheckedPropertyHelper(proxy, name).GetAsDouble();
}

/// Of the server that bakes.
vtkSmartPointer<vtkSMProxy> resourcesFor(vtkSMProxy* filter)
{
  vtkSMSessionProxyManager* proxies = filter->GetSessionProxyManager();
  return vtkSmartPointer<vtkSMProxy>::Take(proxies->NewProxy("misc", "BakeResources"));
}
}

pqBakeEstimate::pqBakeEstimate(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
  : Superclass(proxy, property, parent)
  , Resources(resourcesFor(proxy))
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
  work.settings.storage = static_cast<po::Storage>(chosen(this->proxy(), "Storage"));
  work.targetError = chosenNumber(this->proxy(), "TargetError");
  work.settings.maximumDistance = chosenNumber(this->proxy(), "MaximumDistance");
  work.reuseUnchanged = chosen(this->proxy(), "ReuseUnchanged") != 0;
  this->Resources->UpdatePropertyInformation();
  const std::string text = po::describe(po::estimateCost(work), work.particles,
    vtkSMPropertyHelper(this->Resources, "NumberOfCores").GetAsInt(),
    vtkSMPropertyHelper(this->Resources, "FreeMemory").GetAsDouble());
  this->show(QString::fromStdString(text));
}
