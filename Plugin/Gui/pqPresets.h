// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqPresets_h
#define pqPresets_h

#include "pqPropertyWidget.h"

#include <QList>
#include <QPair>
#include <QString>

class QComboBox;

/// Sets several properties of a proxy at once, by presets that the XML of the property lists:
///
///     <Hints><Preset name="Fast"><Value property="Resolution" value="8"/></Preset></Hints>
///
/// Presets are no state: the properties are. Where they have other values it shows "Custom".
class pqPresets : public pqPropertyWidget
{
  Q_OBJECT
  typedef pqPropertyWidget Superclass;

public:
  pqPresets(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

private Q_SLOTS:
  void choose(int index);
  void showMatching();

private:
  struct Preset
  {
    QString Name;
    QList<QPair<QString, double>> Values; ///< of properties with one number
  };

  void read(vtkSMProperty* property);
  bool matches(const Preset& preset) const;

  QList<Preset> Presets;
  QComboBox* Box;
};

#endif
