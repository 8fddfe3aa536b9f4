// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqPresets_h
#define pqPresets_h

#include "pqPropertyWidget.h"

#include <QList>
#include <QPair>
#include <QString>

#include <vector>

class QComboBox;

/// Sets several properties of a proxy at once, by presets that the XML of the property lists:
///
///     <Hints><Preset name="White"><Value property="Color" value="1 1 1"/></Preset></Hints>
///
/// Presets are no state: the properties are. Where they have other values it shows "Custom".
class pqPresets : public pqPropertyWidget
{
  Q_OBJECT
  typedef pqPropertyWidget Superclass;

public:
  pqPresets(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

  /// Of a display only the widget that was changed is applied, so this must apply what it has set.
  void apply() override;

private Q_SLOTS:
  void choose(int index);
  void showMatching();

private:
  struct Preset
  {
    QString Name;
    QList<QPair<QString, std::vector<double>>> Values; ///< numbers of properties
  };

  void read(vtkSMProperty* property);
  bool matches(const Preset& preset) const;

  QList<Preset> Presets;
  QComboBox* Box;
};

#endif
