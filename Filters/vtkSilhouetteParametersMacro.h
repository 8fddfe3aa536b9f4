// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkSilhouetteParametersMacro_h
#define vtkSilhouetteParametersMacro_h

/**
 * Declares, in a subclass of vtkObject, the parameters of silhouettes that the image filter, the
 * render pass and the prop have in common, with their members. po::SilhouetteParameters has the
 * same defaults but for Samples, which the class chooses.
 *
 * Threshold: Laplacian above which a pixel is an edge, >= 0, in world units or mean particle radii
 *   (ThresholdUnit). A straight jump of depth J has the value 3 J. 0 (default): automatic.
 * ThresholdUnit: 0 (default) world units, 1 mean particle radii; also that of JumpFrom and JumpTo.
 * LineDensity: more or fewer lines, 0 none, 0.5 (default) those of the threshold, 1 all.
 * BackgroundDepth: depth of the background in world units, >= 0. 0 (default): behind whatever it
 *   borders on, so that the outline is drawn at any threshold.
 * BackgroundLines: draw lines against the background. Default: on.
 * SlopeTest: take the slopes on both sides off a jump. Default: on.
 * Samples: samples along each side of a pixel, 1 (no antialiasing), 2, 4 or 8.
 * LineWidth: pixels, 1 (default) to 8.
 * WidthByJump: let lines grow to MaximumLineWidth (1 to 8 pixels, default 3) with the jump; default
 *   off.
 * GreyByJump: let lines darken with the jump. Default: off.
 * JumpFrom, JumpTo: the jumps at which grey and width begin and end to grow. 0 (default): half of
 *   and four times the smallest jump that gets a line.
 */
#define vtkSilhouetteParametersMacro(defaultSamples)                                               \
public:                                                                                            \
  vtkSetMacro(Threshold, double);                                                                  \
  vtkGetMacro(Threshold, double);                                                                  \
  vtkSetMacro(ThresholdUnit, int);                                                                 \
  vtkGetMacro(ThresholdUnit, int);                                                                 \
  vtkSetMacro(LineDensity, double);                                                                \
  vtkGetMacro(LineDensity, double);                                                                \
  vtkSetMacro(BackgroundDepth, double);                                                            \
  vtkGetMacro(BackgroundDepth, double);                                                            \
  vtkSetMacro(BackgroundLines, bool);                                                              \
  vtkGetMacro(BackgroundLines, bool);                                                              \
  vtkSetMacro(SlopeTest, bool);                                                                    \
  vtkGetMacro(SlopeTest, bool);                                                                    \
  vtkSetMacro(Samples, int);                                                                       \
  vtkGetMacro(Samples, int);                                                                       \
  vtkSetMacro(LineWidth, double);                                                                  \
  vtkGetMacro(LineWidth, double);                                                                  \
  vtkSetMacro(WidthByJump, bool);                                                                  \
  vtkGetMacro(WidthByJump, bool);                                                                  \
  vtkSetMacro(MaximumLineWidth, double);                                                           \
  vtkGetMacro(MaximumLineWidth, double);                                                           \
  vtkSetMacro(GreyByJump, bool);                                                                   \
  vtkGetMacro(GreyByJump, bool);                                                                   \
  vtkSetMacro(JumpFrom, double);                                                                   \
  vtkGetMacro(JumpFrom, double);                                                                   \
  vtkSetMacro(JumpTo, double);                                                                     \
  vtkGetMacro(JumpTo, double);                                                                     \
                                                                                                   \
protected:                                                                                         \
  double Threshold = 0.0;                                                                          \
  int ThresholdUnit = 0;                                                                           \
  double LineDensity = 0.5;                                                                        \
  double BackgroundDepth = 0.0;                                                                    \
  bool BackgroundLines = true;                                                                     \
  bool SlopeTest = true;                                                                           \
  int Samples = defaultSamples;                                                                    \
  double LineWidth = 1.0;                                                                          \
  bool WidthByJump = false;                                                                        \
  double MaximumLineWidth = 3.0;                                                                   \
  bool GreyByJump = false;                                                                         \
  double JumpFrom = 0.0;                                                                           \
  double JumpTo = 0.0

#endif
