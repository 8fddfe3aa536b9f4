// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SilhouetteParametersOf_h
#define po_SilhouetteParametersOf_h

#include "SilhouetteRule.h"

namespace po
{
/// The parameters of an object with vtkSilhouetteParametersMacro as the core takes them.
template <typename Object>
[[nodiscard]] SilhouetteParameters silhouetteParametersOf(Object& object)
{
  SilhouetteParameters p;
  p.threshold = object.GetThreshold();
  p.unit = object.GetThresholdUnit() == 0 ? SilhouetteUnit::World : SilhouetteUnit::Radii;
  p.density = object.GetLineDensity();
  p.backgroundDepth = object.GetBackgroundDepth();
  p.backgroundLines = object.GetBackgroundLines();
  p.slopeTest = object.GetSlopeTest();
  p.samples = object.GetSamples();
  p.width = object.GetLineWidth();
  p.widthByJump = object.GetWidthByJump();
  p.maximumWidth = object.GetMaximumLineWidth();
  p.greyByJump = object.GetGreyByJump();
  p.jumpFrom = object.GetJumpFrom();
  p.jumpTo = object.GetJumpTo();
  return p;
}

/// For PrintSelf().
template <typename Stream, typename Indent>
void print(Stream& os, const Indent& indent, const SilhouetteParameters& p)
{
  os << indent << "Threshold: " << p.threshold << "\n";
  os << indent << "ThresholdUnit: " << static_cast<int>(p.unit) << "\n";
  os << indent << "LineDensity: " << p.density << "\n";
  os << indent << "BackgroundDepth: " << p.backgroundDepth << "\n";
  os << indent << "BackgroundLines: " << p.backgroundLines << "\n";
  os << indent << "SlopeTest: " << p.slopeTest << "\n";
  os << indent << "Samples: " << p.samples << "\n";
  os << indent << "LineWidth: " << p.width << "\n";
  os << indent << "WidthByJump: " << p.widthByJump << "\n";
  os << indent << "MaximumLineWidth: " << p.maximumWidth << "\n";
  os << indent << "GreyByJump: " << p.greyByJump << "\n";
  os << indent << "JumpFrom: " << p.jumpFrom << "\n";
  os << indent << "JumpTo: " << p.jumpTo << "\n";
}
}

#endif
