// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkDepthSilhouettePass
 * @brief Render pass that draws silhouettes where the depth jumps.
 *
 * The delegate pass (a vtkCameraPass around what draws the props, or any pass that leaves depth)
 * draws into the frame buffer as if this pass were not there. Then the depth is copied, turned into
 * distance t (world units, along the eye ray in perspective, along the view direction in parallel
 * projection), and the line colour is drawn over the pixels where the Laplacian
 * 8 t(centre) - sum of t(8 neighbours) exceeds Threshold: the convention of vtkDepthSilhouettes,
 * which has the same parameters and defaults and gives the same lines. Colour elsewhere, depth,
 * and the samples of a multisampled frame buffer stay as the delegate left them, so that the pass
 * can be followed by others. Translucent props write no depth and get no lines.
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
 * time for each tile, to know the depth one pixel beyond it, and automatic values are those of the
 * last frame that was not a tile: lines continue across tiles.
 *
 * Errors (the delegate is drawn, lines are not): a negative or non-finite Threshold or
 * BackgroundDepth, a frame buffer without depth, a shader that does not compile.
 */
#ifndef vtkDepthSilhouettePass_h
#define vtkDepthSilhouettePass_h

#include "ParticleOcclusionRenderingModule.h"
#include "vtkImageProcessingPass.h"

#include <memory>
#include <string>

class PARTICLEOCCLUSIONRENDERING_EXPORT vtkDepthSilhouettePass : public vtkImageProcessingPass
{
public:
  static vtkDepthSilhouettePass* New();
  vtkTypeMacro(vtkDepthSilhouettePass, vtkImageProcessingPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Laplacian above which a pixel is an edge, in world units, >= 0. A straight jump of depth J has
   * the value 3 J. 0 (the default) is automatic: 1/100 of the farthest visible depth.
   */
  vtkSetMacro(Threshold, double);
  vtkGetMacro(Threshold, double);
  ///@}

  ///@{
  /**
   * Depth of the background, in world units, >= 0. 0 (the default) is automatic: behind the
   * farthest visible geometry by twice the threshold (the automatic one if that is larger), so that
   * the outline against the background is always drawn.
   */
  vtkSetMacro(BackgroundDepth, double);
  vtkGetMacro(BackgroundDepth, double);
  ///@}

  ///@{
  /**
   * Draw the lines. Off: the delegate alone is drawn and nothing else is computed. Default: on.
   */
  vtkSetMacro(LineVisibility, bool);
  vtkGetMacro(LineVisibility, bool);
  vtkBooleanMacro(LineVisibility, bool);
  ///@}

  ///@{
  /**
   * Colour of the lines, RGB in [0, 1]. Default: black.
   */
  vtkSetVector3Macro(Color, double);
  vtkGetVector3Macro(Color, double);
  ///@}

  ///@{
  /**
   * Opacity of the lines, in [0, 1]. Default: 1.
   */
  vtkSetClampMacro(Opacity, double, 0.0, 1.0);
  vtkGetMacro(Opacity, double);
  ///@}

  ///@{
  /**
   * Draw the delegate a second time for each tile of a larger picture, to know the depth one pixel
   * beyond it. Off: the border of the tile is repeated instead, and a line that falls on a seam can
   * be missing. Needed where the delegate cannot draw a frame larger than the renderer, as with
   * sort-last compositing. Default: on.
   */
  vtkSetMacro(TileMargins, bool);
  vtkGetMacro(TileMargins, bool);
  vtkBooleanMacro(TileMargins, bool);
  ///@}

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkDepthSilhouettePass();
  ~vtkDepthSilhouettePass() override;

  double Threshold = 0.0;
  double BackgroundDepth = 0.0;
  bool LineVisibility = true;
  bool TileMargins = true;
  double Color[3] = { 0.0, 0.0, 0.0 };
  double Opacity = 1.0;

private:
  vtkDepthSilhouettePass(const vtkDepthSilhouettePass&) = delete;
  void operator=(const vtkDepthSilhouettePass&) = delete;

  bool CheckParameters();
  std::string ReadDepth(const vtkRenderState* state, bool whole);
  std::string ReadDepthAroundTile(const vtkRenderState* state);
  void DrawLines(const vtkRenderState* state, int margin);

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
