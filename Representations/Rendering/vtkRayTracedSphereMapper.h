// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkRayTracedSphereMapper
 * @brief Draws the points of a vtkPolyData as ray-traced spheres, with baked ambient occlusion.
 *
 * One ray a pixel finds the nearest sphere exactly; the pixel gets the colour of the point (by
 * scalars and lookup table, as in any mapper), light from the renderer's lights with the property's
 * ambient, diffuse and specular terms, optionally hard shadows, and the occlusion that
 * vtkSphereAmbientOcclusion has baked onto the points, if it is there. Depth is written, so that
 * spheres and other props interpenetrate. Points that cannot be spheres (NaN, infinite or negative
 * radius) are left out and reported once. Cells are not used.
 *
 * Points are cropped as wholes, without building anything anew: by ranges of arrays
 * (AddCropRange()) and by the mapper's clipping planes, which keep the points whose centres are in
 * front of them. Shadows are those of what is shown.
 *
 * A frame is kept: it is traced again only when spheres, cropping, camera, window size or placement
 * change, and shadows of a light only when that light moves. Colours, coefficients and lookup
 * tables cost shading alone.
 *
 * With opacities below 1, of the property or of the lookup table, what is behind translucent
 * spheres is traced too, layer by layer. A sphere is seen by its front. Depth peeling sorts the
 * layers among other translucent props (vtkRenderer::UseDepthPeeling); without it they lie over
 * what was drawn before. Translucent spheres cast whole shadows; those of opacity 0 are not there.
 */
#ifndef vtkRayTracedSphereMapper_h
#define vtkRayTracedSphereMapper_h

#include "ParticleOcclusionRenderingModule.h"
#include "vtkPolyDataMapper.h"
#include "vtkSmartPointer.h"

#include <memory>

class vtkImageData;

namespace po
{
class SphereRenderer;
struct MapperMessages;
}

class PARTICLEOCCLUSIONRENDERING_EXPORT vtkRayTracedSphereMapper : public vtkPolyDataMapper
{
public:
  static vtkRayTracedSphereMapper* New();
  vtkTypeMacro(vtkRayTracedSphereMapper, vtkPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// What gives a sphere its brightness.
  enum ShadingModes
  {
    DIRECT_LIGHT = 0,      ///< light and shadows, without baked occlusion
    AMBIENT_OCCLUSION = 1, ///< occlusion times the point's colour, without light
    BOTH = 2               ///< light scaled by occlusion
  };

  ///@{
  /// RadiusArray: name of the point array that gives the radii, in world units; of an array named
  /// "diameter" half the value. Empty (default): the first of radius, Radius, rad, r, diameter that
  /// exists, otherwise none. "(none)": no array, all radii are ConstantRadius.
  /// RadiusScale: factor on every radius, positive. Default 1.
  /// ConstantRadius: radius of all spheres where no array is used, in world units. 0 (default):
  /// of the elements if the points have them, else half the median distance between nearest
  /// neighbours.
  /// RadiusFrom: what RadiusArray holds, as vtkSphereAmbientOcclusion::RadiusSourceType. Default 0,
  /// radii.
  /// Density: mass per volume, positive, where it holds masses. Default 1.
  vtkSetStringMacro(RadiusArray);
  vtkGetStringMacro(RadiusArray);
  vtkSetMacro(RadiusScale, double);
  vtkGetMacro(RadiusScale, double);
  vtkSetMacro(ConstantRadius, double);
  vtkGetMacro(ConstantRadius, double);
  vtkSetMacro(RadiusFrom, int);
  vtkGetMacro(RadiusFrom, int);
  vtkSetMacro(Density, double);
  vtkGetMacro(Density, double);
  ///@}

  ///@{
  /// ShadingMode: what makes up the brightness of a pixel. Default BOTH. Where direct light is
  /// baked into the textures (vtkSphereAmbientOcclusion::BakeLight), it takes the place of the
  /// renderer's lights in BOTH, so that it does not count twice. OcclusionOnDiffuse: in mode BOTH
  /// occlusion scales the ambient term, and with this the diffuse term too. Default on, since VTK's
  /// ambient coefficient is 0 by default. Shadows: hard shadows of this mapper's spheres on each
  /// other, from each light. Default off.
  vtkSetClampMacro(ShadingMode, int, DIRECT_LIGHT, BOTH);
  vtkGetMacro(ShadingMode, int);
  vtkSetMacro(OcclusionOnDiffuse, bool);
  vtkGetMacro(OcclusionOnDiffuse, bool);
  vtkBooleanMacro(OcclusionOnDiffuse, bool);
  vtkSetMacro(Shadows, bool);
  vtkGetMacro(Shadows, bool);
  vtkBooleanMacro(Shadows, bool);
  ///@}

  ///@{
  /// Shows only points whose value of a point array is from low to high (NaN is not); several
  /// ranges hold together. Component -1 is the magnitude. Default: none, all points are shown.
  void AddCropRange(const char* array, int component, double low, double high);
  void RemoveAllCropRanges();
  ///@}

  ///@{
  /// Looks of single blocks of the composite data set that the points were gathered from, by flat
  /// index. Default: none.
  void SetBlockVisibility(unsigned flatIndex, bool visible);
  void SetBlockColor(unsigned flatIndex, double red, double green, double blue);
  void SetBlockOpacity(unsigned flatIndex, double opacity);
  void RemoveAllBlockStyles();
  ///@}

  ///@{
  /// TextureFile: a file of occlusion textures, as vtkOcclusionTextureWriter writes it for these
  /// very points, whose textures are drawn in place of those that the points carry. Only those of
  /// spheres that are seen are read, by a thread of their own. Without Progressive a picture waits
  /// for them, but never while the user drags; else a particle shows its mean until its texture is
  /// there, and UpdateEvent is invoked. Default: none.
  ///
  /// TextureBudget: MiB that these textures may take, with 16 bytes for each, at least 0. Another 8
  /// bytes a point and 16 a texture are always taken. Those that were seen least recently make room
  /// for others; of a picture that shows more than the budget holds, the textures of fewest pixels
  /// are missing. Default 256.
  vtkSetFilePathMacro(TextureFile);
  vtkGetFilePathMacro(TextureFile);
  vtkSetClampMacro(TextureBudget, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(TextureBudget, double);
  ///@}

  ///@{
  /// SamplesPerPixel: rays a pixel, 1 to 256, each through another place of it, for smooth edges.
  /// Depth stays that of the pixel's centre. The rim of a sphere is mixed with what was drawn
  /// before. Not for translucent spheres. Default 1.
  /// Progressive: each time the same picture is rendered again one ray a pixel is added, in place
  /// of all of them the first time. While there are more to add, UpdateEvent is invoked, and
  /// HasMoreToShow() tells when. Default off.
  /// InteractiveRate: frames a second to reach while the window asks for speed (its
  /// DesiredUpdateRate is at least 1, as while the user drags): frames become as coarse as that
  /// takes. 0: never coarse. Default 15.
  vtkSetClampMacro(SamplesPerPixel, int, 1, 256);
  vtkGetMacro(SamplesPerPixel, int);
  vtkSetMacro(Progressive, bool);
  vtkGetMacro(Progressive, bool);
  vtkBooleanMacro(Progressive, bool);
  vtkSetClampMacro(InteractiveRate, double, 0, 1000);
  vtkGetMacro(InteractiveRate, double);
  ///@}

  /// After an UpdateEvent: would rendering again change the picture now? False while textures are
  /// being read and none has arrived.
  bool HasMoreToShow();

  ///@{
  /// Where several processes draw parts of one set of particles: the number of all of them, their
  /// mean radius, the diagonal of their bounds, and how far a line of sight goes in the mean from
  /// one particle to the next, in the actor's coordinates. Automatic thresholds of silhouettes go
  /// by it. Default 0, 0, 0, 0: this mapper has the whole set.
  vtkSetVector4Macro(WholeSet, double);
  vtkGetVector4Macro(WholeSet, double);
  ///@}

  /// The last frame that was drawn, rows from the bottom, with the point arrays RGBA (uint8), Z
  /// (float32, distance along the eye ray or, in parallel projection, the view direction, in world
  /// units; +infinity on background), AO (float32), N (float32[3], world-space unit normal) and id
  /// (int64, point, -1 on background). An empty image where no frame of the present spheres has
  /// been drawn. The image belongs to the mapper and does not follow later frames.
  vtkImageData* GetLayers();

  /// The same layers of the renderer's view at another size, 1 to 65,536 pixels a side, traced by
  /// themselves: no frame buffer limits the size. Parts of up to 4 million pixels are traced one
  /// after the other; the image takes 32 bytes a pixel. An empty image where there are no spheres.
  vtkSmartPointer<vtkImageData> RenderLayers(
    vtkRenderer* renderer, vtkActor* actor, int width, int height);

  /// Gives back the memory of spheres, scene and frame; the next frame builds them anew.
  void ReleaseSpheres();

  ///@{
  /// What was done: spheres that are there, and those of them that are shown; of the last frame
  /// that was traced the rays (primary and shadow), tiles that were skipped and shadow rays that
  /// were saved; frames traced so far. Seconds are those that each step took the last time it was
  /// done. Scenes are those of spheres in this process: mappers of equal spheres share one.
  vtkIdType GetNumberOfSpheres();
  vtkIdType GetNumberOfShownSpheres();
  vtkIdType GetNumberOfRays();
  vtkIdType GetNumberOfShadowRays();
  vtkIdType GetNumberOfSkippedTiles();
  vtkIdType GetNumberOfSkippedShadowRays();
  vtkIdType GetNumberOfTracedFrames();
  vtkIdType GetNumberOfTracedShadows(); ///< shadow masks of single lights, traced so far
  int GetNumberOfSamples();             ///< rays a pixel in the last frame
  int GetNumberOfLayers();              ///< of spheres, one behind the other, in the last frame
  static vtkIdType GetNumberOfScenes();
  vtkIdType GetNumberOfResidentTextures(); ///< of the TextureFile in memory
  vtkIdType GetResidentTextureBytes();     ///< what they take, and those that are being read
  vtkIdType GetNumberOfMissingTextures();  ///< seen in the last frame, but not in memory
  double GetBuildSeconds();
  double GetTraceSeconds();
  double GetShadowSeconds();
  double GetShadeSeconds();
  ///@}

#ifndef __VTK_WRAP__
  /// The last frame, for what draws over it. Not for other use.
  const po::SphereRenderer& GetSphereRenderer() const;
#endif

  void RenderPiece(vtkRenderer* renderer, vtkActor* actor) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  bool HasOpaqueGeometry() override;
  bool HasTranslucentPolygonalGeometry() override;
  bool GetSupportsSelection() override;

protected:
  vtkRayTracedSphereMapper();
  ~vtkRayTracedSphereMapper() override;

  void ComputeBounds() override;

private:
  vtkRayTracedSphereMapper(const vtkRayTracedSphereMapper&) = delete;
  void operator=(const vtkRayTracedSphereMapper&) = delete;

  void Report(const po::MapperMessages& messages);
  void UpdateSpheres();
  void UpdateTextures();
  bool Prepare(vtkActor* actor);
  void RenderSpheres(vtkRenderer* renderer, vtkActor* actor);
  void Draw(vtkRenderer* renderer, vtkActor* actor);
  void Shade(vtkRenderer* renderer, vtkActor* actor);

  char* RadiusArray = nullptr;
  double RadiusScale = 1;
  double ConstantRadius = 0;
  int RadiusFrom = 0;
  double Density = 1;
  char* TextureFile = nullptr;
  double TextureBudget = 256;
  int ShadingMode = BOTH;
  bool OcclusionOnDiffuse = true;
  bool Shadows = false;
  int SamplesPerPixel = 1;
  bool Progressive = false;
  double InteractiveRate = 15;
  double WholeSet[4] = { 0, 0, 0, 0 };

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
