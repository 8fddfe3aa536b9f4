// SPDX-License-Identifier: BSD-3-Clause
#ifndef pqBakeEstimate_h
#define pqBakeEstimate_h

#include "pqInformationText.h"

#include "vtkSmartPointer.h"

/// What the bake would take with the settings that the panel shows, before they are applied.
///
/// The number of particles is that of the input as it was last read; cores and free memory are
/// those of the server.
class pqBakeEstimate : public pqInformationText
{
  Q_OBJECT
  typedef pqInformationText Superclass;

public:
  pqBakeEstimate(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

protected Q_SLOTS:
  void refresh() override;

private:
  std::size_t particles() const;

  vtkSmartPointer<vtkSMProxy> Resources;
};

#endif
