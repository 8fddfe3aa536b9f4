// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkPVRenderViewWithSilhouettes
 * @brief ParaView's render view with lines where the depth jumps.
 *
 * Draws everything that the plain render view draws, and vtkDepthSilhouettePass on top. In parallel
 * the pass finds lines together with those of the other processes; on a wall of displays in the
 * composited image of each, without TileMargins. Each property is the pass' parameter
 * of the same name without "Silhouette", with its meaning, range and default.
 */
#ifndef vtkPVRenderViewWithSilhouettes_h
#define vtkPVRenderViewWithSilhouettes_h

#include "ParticleOcclusionRepresentationsModule.h"
#include "vtkDepthSilhouettePass.h"
#include "vtkForwardSilhouettesMacro.h"
#include "vtkNew.h"
#include "vtkPVRenderView.h"
#include "vtkWeakPointer.h"

#include <vector>

class vtkDataRepresentation;

class PARTICLEOCCLUSIONREPRESENTATIONS_EXPORT vtkPVRenderViewWithSilhouettes
  : public vtkPVRenderView
{
public:
  static vtkPVRenderViewWithSilhouettes* New();
  vtkTypeMacro(vtkPVRenderViewWithSilhouettes, vtkPVRenderView);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  vtkForwardSilhouettesMacro(Silhouettes);

  ///@{
  /// Representations that alone have lines, as far as they are visible, translucent ones too:
  /// surfaces, points and the like, and ray-traced spheres. Default: none, all that is opaque has
  /// lines. On a wall of displays they cannot be limited, which is reported.
  void AddSilhouetteRepresentation(vtkDataRepresentation* representation);
  void RemoveAllSilhouetteRepresentations();
  ///@}

protected:
  vtkPVRenderViewWithSilhouettes();
  ~vtkPVRenderViewWithSilhouettes() override;

  void Render(bool interactive, bool skipRendering) override;

private:
  vtkPVRenderViewWithSilhouettes(const vtkPVRenderViewWithSilhouettes&) = delete;
  void operator=(const vtkPVRenderViewWithSilhouettes&) = delete;

  void CheckSharing();
  void PrepareCompositing();
  bool ChooseActors();

  vtkNew<vtkDepthSilhouettePass> Silhouettes;
  std::vector<vtkWeakPointer<vtkDataRepresentation>> Chosen;
};

#endif
