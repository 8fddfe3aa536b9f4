// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkPVRenderViewWithSilhouettes
 * @brief ParaView's render view with lines where the depth jumps.
 *
 * Draws everything that the plain render view draws, and vtkDepthSilhouettePass on top. In parallel
 * the pass works on the composited image, without TileMargins. Each property is the pass' parameter
 * of the same name without "Silhouette", with its meaning, range and default.
 */
#ifndef vtkPVRenderViewWithSilhouettes_h
#define vtkPVRenderViewWithSilhouettes_h

#include "ParticleOcclusionRepresentationsModule.h"
#include "vtkNew.h"
#include "vtkPVRenderView.h"

class vtkDepthSilhouettePass;

class PARTICLEOCCLUSIONREPRESENTATIONS_EXPORT vtkPVRenderViewWithSilhouettes
  : public vtkPVRenderView
{
public:
  static vtkPVRenderViewWithSilhouettes* New();
  vtkTypeMacro(vtkPVRenderViewWithSilhouettes, vtkPVRenderView);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Forwarded to the pass; see vtkDepthSilhouettePass.
   */
  void SetSilhouetteVisibility(bool visible);
  bool GetSilhouetteVisibility();
  void SetSilhouetteThreshold(double threshold);
  double GetSilhouetteThreshold();
  void SetSilhouetteBackgroundDepth(double depth);
  double GetSilhouetteBackgroundDepth();
  void SetSilhouetteColor(double red, double green, double blue);
  double* GetSilhouetteColor() VTK_SIZEHINT(3);
  void SetSilhouetteOpacity(double opacity);
  double GetSilhouetteOpacity();
  ///@}

protected:
  vtkPVRenderViewWithSilhouettes();
  ~vtkPVRenderViewWithSilhouettes() override;

private:
  vtkPVRenderViewWithSilhouettes(const vtkPVRenderViewWithSilhouettes&) = delete;
  void operator=(const vtkPVRenderViewWithSilhouettes&) = delete;

  vtkNew<vtkDepthSilhouettePass> Silhouettes;
};

#endif
