// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSphereSilhouettes
 * @brief Prop that draws the silhouettes of actors of ray-traced spheres, in any renderer.
 *
 * Lines are found in the traced frames of vtkRayTracedSphereMapper, so that nothing is traced or
 * read back for them, and drawn as an overlay, after all else, hidden by what is nearer than the
 * spheres in front of them. Other actors have no lines and move none. No render pass is needed, so
 * that whatever else draws or processes the picture goes on as without this prop.
 *
 * Add it to the renderer of the actors. The parameters are those of vtkDepthSilhouettePass; the
 * automatic threshold is derived from the particles of these actors alone.
 *
 * Errors (no lines are drawn): a parameter out of its range, a shader that does not compile.
 */
#ifndef vtkSphereSilhouettes_h
#define vtkSphereSilhouettes_h

#include "ParticleOcclusionRenderingModule.h"
#include "vtkProp.h"
#include "vtkSilhouetteParametersMacro.h"
#include "vtkSilhouetteStyleMacro.h"

#include <memory>
#include <string>

class vtkActor;
class vtkMultiProcessController;
class vtkRenderer;

namespace po
{
struct SilhouetteViewport;
}

class PARTICLEOCCLUSIONRENDERING_EXPORT vtkSphereSilhouettes : public vtkProp
{
public:
  static vtkSphereSilhouettes* New();
  vtkTypeMacro(vtkSphereSilhouettes, vtkProp);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  vtkSilhouetteParametersMacro(4);
  vtkSilhouetteStyleMacro();

public:
  ///@{
  /**
   * Actors whose mapper is a vtkRayTracedSphereMapper, in the renderer that has this prop. Those
   * that are not visible are left out.
   */
  void AddActor(vtkActor* actor);
  void RemoveAllActors();
  ///@}

  ///@{
  /// Controller: the processes that draw parts of the spheres each, in pictures that are composited
  /// afterwards. Lines are those of one process that has all spheres; there are none while frames
  /// are coarser than the picture to be in time. All processes must draw each picture, those
  /// without spheres too. Default: none, the process is alone.
  /// Renderer: that has this prop. While it renders, the prop has bounds that reach far beyond
  /// everything, so that no process is left out because its part cannot be seen. Default: none.
  /// OrderedCompositing: pictures are put one over the other, not composited by depth. Default:
  /// off.
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  void SetRenderer(vtkRenderer* renderer);
  vtkSetMacro(OrderedCompositing, bool);
  vtkGetMacro(OrderedCompositing, bool);
  vtkBooleanMacro(OrderedCompositing, bool);
  ///@}

  double* GetBounds() override;
  vtkTypeBool HasOpaqueGeometry() override { return 0; }
  int RenderOverlay(vtkViewport* viewport) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkSphereSilhouettes();
  ~vtkSphereSilhouettes() override;

private:
  vtkSphereSilhouettes(const vtkSphereSilhouettes&) = delete;
  void operator=(const vtkSphereSilhouettes&) = delete;

  void BeginPicture();
  void EndPicture();
  bool IsShared();
  bool CanDraw(vtkRenderer* renderer);
  bool Find(vtkRenderer* renderer, const po::SilhouetteViewport& place);
  bool FindOwn(const po::SilhouetteViewport& place);
  bool FindTogether(vtkRenderer* renderer, const po::SilhouetteViewport& place);
  bool FindAround(
    vtkRenderer* renderer, const po::SilhouetteViewport& tile, int margin, std::string& error);

  bool OrderedCompositing = false;
  bool IsRendering = false;
  double Bounds[6] = { 0, 0, 0, 0, 0, 0 };

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
