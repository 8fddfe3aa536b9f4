// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkDepthSilhouettePass
 * @brief Render pass that draws silhouettes where the depth jumps.
 *
 * The delegate pass (a vtkCameraPass around what draws the props, or any pass that leaves depth)
 * draws into the frame buffer as if this pass were not there. Then lines are found on the processor
 * by what vtkDepthSilhouettes uses, with the same parameters (vtkSilhouetteParametersMacro), and
 * blended over the picture. Colour elsewhere, depth, and the samples of a multisampled frame buffer
 * stay as the delegate left them, so that the pass can be followed by others.
 *
 * Where all that is opaque are spheres of vtkRayTracedSphereMapper, their traced frames are the
 * depth: nothing is read back or drawn again, and lines are antialiased along the spheres' rims.
 * Otherwise the z-buffer is read; with Samples above 1 the delegate draws a second time, into a
 * frame buffer that many times as large. Translucent props write no depth and get no lines, unless
 * they are among the actors of the pass.
 *
 * With AddActor() lines are limited to some actors: these alone are drawn into a depth buffer of
 * their own, translucent ones too, and lines are hidden where something else lies in front.
 *
 * In plain VTK, which otherwise draws a renderer without a pass:
 * @code
 *   vtkNew<vtkRenderStepsPass> steps; // holds its own camera pass
 *   vtkNew<vtkDepthSilhouettePass> silhouettes;
 *   silhouettes->SetDelegatePass(steps);
 *   renderer->SetPass(silhouettes);
 * @endcode
 *
 * Each renderer needs a pass of its own: the pass keeps textures of the renderer's size.
 *
 * Where a picture is put together from tiles (large screenshots), the delegate is drawn a second
 * time for each tile, to know the depth some pixels beyond it, and automatic values are those of
 * the last frame that was not a tile: lines continue across tiles.
 *
 * An automatic threshold is three times the jump of two mean particle radii, or of 1/50 of the
 * diagonal of the particles' bounds, or, among scattered particles, of the jump that one line of
 * sight in six exceeds, whichever is the largest; without particles 1/50 of the spread of the
 * visible depths.
 *
 * Errors (the delegate is drawn, lines are not): a parameter out of its range, ThresholdUnit 1
 * without ray-traced spheres, a frame buffer without depth, a shader that does not compile.
 */
#ifndef vtkDepthSilhouettePass_h
#define vtkDepthSilhouettePass_h

#include "ParticleOcclusionRenderingModule.h"
#include "vtkImageProcessingPass.h"
#include "vtkSilhouetteParametersMacro.h"
#include "vtkSilhouetteStyleMacro.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkActor;
class vtkMultiProcessController;
class vtkProp;

namespace po
{
struct SilhouetteImage;
struct SilhouetteScale;
struct SilhouetteSurroundings;
struct ZBuffer;
}

class PARTICLEOCCLUSIONRENDERING_EXPORT vtkDepthSilhouettePass : public vtkImageProcessingPass
{
public:
  static vtkDepthSilhouettePass* New();
  vtkTypeMacro(vtkDepthSilhouettePass, vtkImageProcessingPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  vtkSilhouetteParametersMacro(4);
  vtkSilhouetteStyleMacro();

public:
  ///@{
  /**
   * Limit lines to these actors. Without any (the default) all opaque surfaces have lines.
   */
  void AddActor(vtkActor* actor);
  void RemoveAllActors();
  ///@}

  ///@{
  /**
   * Draw the delegate a second time for each tile of a larger picture, to know the depth some
   * pixels beyond it, and for samples within pixels. Off: the border of the tile is repeated
   * instead, a line that falls on a seam can be missing, the depth is that of the frame buffer, and
   * there is one sample a pixel. Needed where the delegate cannot draw a frame larger than the
   * renderer, as with sort-last compositing. Default: on.
   */
  vtkSetMacro(TileMargins, bool);
  vtkGetMacro(TileMargins, bool);
  vtkBooleanMacro(TileMargins, bool);
  ///@}

  ///@{
  /// The processes whose pictures the delegate composites at the first of them, each with a part of
  /// the scene. All of them must render together. Default: none, the process is alone.
  ///
  /// Lines are those of one process that has all of it, antialiased as there: around ray-traced
  /// spheres from their frames, beside anything else from the z-buffers of all processes. Only
  /// frames of spheres that are coarser than the picture, to be in time, have lines of whole
  /// pixels, as with one process.
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  ///@{
  /// Pictures of processes are put one over the other and leave no depth. Default: off.
  vtkSetMacro(OrderedCompositing, bool);
  vtkGetMacro(OrderedCompositing, bool);
  vtkBooleanMacro(OrderedCompositing, bool);
  ///@}

  /// Bytes that this process has handed to others for the lines of the last picture.
  vtkGetMacro(SharedBytes, vtkIdType);

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkDepthSilhouettePass();
  ~vtkDepthSilhouettePass() override;

  bool TileMargins = true;
  bool OrderedCompositing = false;
  vtkIdType SharedBytes = 0;

private:
  vtkDepthSilhouettePass(const vtkDepthSilhouettePass&) = delete;
  void operator=(const vtkDepthSilhouettePass&) = delete;

  bool CheckParameters();
  bool IsShared();
  void RenderDelegate(const vtkRenderState* state);
  std::string RenderAlone(const vtkRenderState* state, bool lines);
  std::string RenderShared(const vtkRenderState* state, bool lines);
  bool FindTogether(const vtkRenderState* state, bool lines, std::string& error);
  bool FindInFrames(
    const vtkRenderState* state, const std::vector<vtkProp*>& props, std::string& error);
  bool FindInZBuffers(const vtkRenderState* state, const std::vector<vtkProp*>& props, int samples,
    std::string& error);
  void FindInZBuffer(const po::ZBuffer& own, po::SilhouetteScale scale);
  std::string DrawAside(const vtkRenderState* state, const std::vector<vtkProp*>& props,
    int samples, int margin, const std::function<std::string(const vtkRenderState*)>& use);
  std::string Prepare(const vtkRenderState* state);
  std::string FindInTracedFrames(const vtkRenderState* state, int margin);
  std::string FindInZBuffer(const vtkRenderState* state, int samples, int margin);
  std::string FindAround(const vtkRenderState* state);
  std::string DrawLines(const vtkRenderState* state, const po::SilhouetteImage& lines,
    po::SilhouetteSurroundings surroundings);

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
