// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqInformationText_h
#define pqInformationText_h

#include "pqPropertyWidget.h"

class QLabel;

/// The text of an information-only property, kept up to date: read anew whenever the data of the
/// proxy are.
class pqInformationText : public pqPropertyWidget
{
  Q_OBJECT
  typedef pqPropertyWidget Superclass;

public:
  pqInformationText(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

protected Q_SLOTS:
  virtual void refresh();

protected:
  void show(const QString& text);

private:
  QLabel* Label;
};

#endif
