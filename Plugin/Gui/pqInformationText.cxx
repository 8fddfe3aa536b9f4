// SPDX-License-Identifier: BSD-3-Clause
#include "pqInformationText.h"

#include "pqCoreUtilities.h"
#include "vtkCommand.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QLabel>
#include <QVBoxLayout>

pqInformationText::pqInformationText(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
  : Superclass(proxy, parent)
  , Label(new QLabel(this))
{
  this->Label->setObjectName("Text");
  this->Label->setWordWrap(true);
  this->Label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Label);
  this->setProperty(property);
  pqCoreUtilities::connect(proxy, vtkCommand::UpdateDataEvent, this, SLOT(refresh()));
  this->refresh();
}

void pqInformationText::refresh()
{
  this->proxy()->UpdatePropertyInformation(this->property());
  this->show(QString::fromUtf8(vtkSMPropertyHelper(this->property(), true).GetAsString()));
}

void pqInformationText::show(const QString& text)
{
  this->Label->setText(text.isEmpty() ? QString("-") : text);
}
