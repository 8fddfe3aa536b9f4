// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkForwardSilhouettesMacro_h
#define vtkForwardSilhouettesMacro_h

/// Declares SetSilhouetteNAME and GetSilhouetteNAME, which forward to SetNAME and GetNAME of
/// `target`.
#define vtkForwardSilhouetteMacro(target, name, type)                                              \
  void SetSilhouette##name(type value)                                                             \
  {                                                                                                \
    this->target->Set##name(value);                                                                \
  }                                                                                                \
  type GetSilhouette##name()                                                                       \
  {                                                                                                \
    return this->target->Get##name();                                                              \
  }

/// The same for all parameters and the style of silhouettes; see vtkSilhouetteParametersMacro and
/// vtkSilhouetteStyleMacro. SilhouetteVisibility is LineVisibility.
#define vtkForwardSilhouettesMacro(target)                                                         \
  void SetSilhouetteVisibility(bool value)                                                         \
  {                                                                                                \
    this->target->SetLineVisibility(value);                                                        \
  }                                                                                                \
  bool GetSilhouetteVisibility()                                                                   \
  {                                                                                                \
    return this->target->GetLineVisibility();                                                      \
  }                                                                                                \
  void SetSilhouetteColor(double red, double green, double blue)                                   \
  {                                                                                                \
    this->target->SetColor(red, green, blue);                                                      \
  }                                                                                                \
  double* GetSilhouetteColor() VTK_SIZEHINT(3)                                                     \
  {                                                                                                \
    return this->target->GetColor();                                                               \
  }                                                                                                \
  vtkForwardSilhouetteMacro(target, Threshold, double);                                            \
  vtkForwardSilhouetteMacro(target, ThresholdUnit, int);                                           \
  vtkForwardSilhouetteMacro(target, LineDensity, double);                                          \
  vtkForwardSilhouetteMacro(target, BackgroundDepth, double);                                      \
  vtkForwardSilhouetteMacro(target, BackgroundLines, bool);                                        \
  vtkForwardSilhouetteMacro(target, SlopeTest, bool);                                              \
  vtkForwardSilhouetteMacro(target, Samples, int);                                                 \
  vtkForwardSilhouetteMacro(target, LineWidth, double);                                            \
  vtkForwardSilhouetteMacro(target, WidthByJump, bool);                                            \
  vtkForwardSilhouetteMacro(target, MaximumLineWidth, double);                                     \
  vtkForwardSilhouetteMacro(target, GreyByJump, bool);                                             \
  vtkForwardSilhouetteMacro(target, JumpFrom, double);                                             \
  vtkForwardSilhouetteMacro(target, JumpTo, double);                                               \
  vtkForwardSilhouetteMacro(target, Opacity, double);                                              \
  vtkForwardSilhouetteMacro(target, Darken, bool)

#endif
