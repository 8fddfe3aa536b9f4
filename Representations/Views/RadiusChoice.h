// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_RadiusChoice_h
#define po_RadiusChoice_h

#include "ParticleRadii.h"

#include "vtkTimeStamp.h"

#include <string>

class vtkPolyData;
class vtkRayTracedSphereMapper;

namespace po
{
/// The radii that the user asks a representation for, and what they come to for all processes.
class RadiusChoice
{
public:
  [[nodiscard]] const RadiusSettings& asked() const { return asked_; }

  /// For changes by the user; the mapper knows of them after the next resolve().
  [[nodiscard]] RadiusSettings& change();

  /// Chooses what is automatic for the particles of all processes, and gives it to the mapper. A
  /// client without particles of its own leaves that to the mapper, which gets those of all.
  void resolve(vtkPolyData& particles, vtkRayTracedSphereMapper& mapper);

  /// When the user last changed them.
  [[nodiscard]] vtkMTimeType changeTime() const { return changed_.GetMTime(); }

  /// Where the radii came from, in words; empty before resolve().
  [[nodiscard]] const std::string& used() const { return used_; }

private:
  RadiusSettings asked_;
  vtkTimeStamp changed_;
  std::string used_;
};
}

#endif
