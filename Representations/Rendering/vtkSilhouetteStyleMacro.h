// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkSilhouetteStyleMacro_h
#define vtkSilhouetteStyleMacro_h

/**
 * Declares, in a subclass of vtkObject, how silhouettes are drawn, with the members.
 *
 * LineVisibility: draw the lines; off: nothing is computed for them. Default: on.
 * Color: of the lines, RGB in [0, 1]. Default: black.
 * Opacity: of the lines, in [0, 1]. Default: 1.
 * Darken: take the colour of what is in front of a line, darkened, in place of Color. Default: off.
 */
#define vtkSilhouetteStyleMacro()                                                                  \
public:                                                                                            \
  vtkSetMacro(LineVisibility, bool);                                                               \
  vtkGetMacro(LineVisibility, bool);                                                               \
  vtkBooleanMacro(LineVisibility, bool);                                                           \
  vtkSetVector3Macro(Color, double);                                                               \
  vtkGetVector3Macro(Color, double);                                                               \
  vtkSetClampMacro(Opacity, double, 0.0, 1.0);                                                     \
  vtkGetMacro(Opacity, double);                                                                    \
  vtkSetMacro(Darken, bool);                                                                       \
  vtkGetMacro(Darken, bool);                                                                       \
                                                                                                   \
protected:                                                                                         \
  bool LineVisibility = true;                                                                      \
  double Color[3] = { 0.0, 0.0, 0.0 };                                                             \
  double Opacity = 1.0;                                                                            \
  bool Darken = false

#endif
