// SPDX-License-Identifier: BSD-3-Clause
#include "pqPresets.h"

#include "pqCoreUtilities.h"
#include "vtkCommand.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMUncheckedPropertyHelper.h"

#include <QComboBox>
#include <QVBoxLayout>

#include <algorithm>

namespace
{
/// One by one: the helper sets several doubles of properties of doubles only.
void set(vtkSMPropertyHelper&& helper, const std::vector<double>& values)
{
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    helper.Set(static_cast<unsigned int>(i), values[i]);
  }
}
}

pqPresets::pqPresets(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
  : Superclass(proxy, parent)
  , Box(new QComboBox(this))
{
  this->Box->setObjectName("ComboBox");
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Box);
  this->setProperty(property);
  this->read(property);
  this->Box->addItem("Custom");
  for (const Preset& preset : this->Presets)
  {
    this->Box->addItem(preset.Name);
    for (const auto& value : preset.Values)
    {
      pqCoreUtilities::connect(proxy->GetProperty(value.first.toUtf8().data()),
        vtkCommand::UncheckedPropertyModifiedEvent, this, SLOT(showMatching()));
    }
  }
  this->showMatching();
  // Not what the program does to the box, only what the user does.
  QObject::connect(this->Box, SIGNAL(activated(int)), this, SLOT(choose(int)));
}

void pqPresets::read(vtkSMProperty* property)
{
  vtkPVXMLElement* hints = property->GetHints();
  for (unsigned int i = 0; hints && i < hints->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* element = hints->GetNestedElement(i);
    if (QString(element->GetName()) != "Preset")
    {
      continue;
    }
    Preset preset{ element->GetAttribute("name"), {} };
    for (unsigned int k = 0; k < element->GetNumberOfNestedElements(); ++k)
    {
      vtkPVXMLElement* entry = element->GetNestedElement(k);
      std::vector<double> values;
      for (const QString& number : QString(entry->GetAttribute("value")).split(' '))
      {
        values.push_back(number.toDouble());
      }
      if (this->proxy()->GetProperty(entry->GetAttribute("property")))
      {
        preset.Values.append({ entry->GetAttribute("property"), values });
      }
    }
    this->Presets.append(preset);
  }
}

bool pqPresets::matches(const Preset& preset) const
{
  return std::all_of(preset.Values.begin(), preset.Values.end(),
    [this](const QPair<QString, std::vector<double>>& value)
    {
      return vtkSMUncheckedPropertyHelper(this->proxy(), value.first.toUtf8().data())
               .GetDoubleArray() == value.second;
    });
}

void pqPresets::showMatching()
{
  const auto match = std::find_if(this->Presets.begin(), this->Presets.end(),
    [this](const Preset& preset) { return this->matches(preset); });
  const int index = static_cast<int>(match - this->Presets.begin());
  this->Box->setCurrentIndex(match == this->Presets.end() ? 0 : index + 1);
}

void pqPresets::apply()
{
  this->Superclass::apply();
  const int index = this->Box->currentIndex();
  if (index == 0)
  {
    return; // the widgets of the properties apply them
  }
  for (const auto& value : this->Presets[index - 1].Values)
  {
    set(vtkSMPropertyHelper(this->proxy(), value.first.toUtf8().data()), value.second);
  }
  this->proxy()->UpdateVTKObjects();
}

void pqPresets::choose(int index)
{
  if (index == 0)
  {
    this->showMatching(); // nothing to set
    return;
  }
  const Preset preset = this->Presets[index - 1];
  for (const auto& value : preset.Values)
  {
    set(vtkSMUncheckedPropertyHelper(this->proxy(), value.first.toUtf8().data()), value.second);
  }
  Q_EMIT this->changeAvailable();
}
