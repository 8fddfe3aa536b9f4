// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkRayTracedSphereRepresentation
 * @brief Shows the points of any data set as ray-traced spheres in a render view.
 *
 * The points of all blocks are shown together; textures that were baked onto the blocks stay with
 * their particles. Colour, light, shadows, cropping and opacity are those of
 * vtkRayTracedSphereMapper, which documents the parameters. Whatever is cropped, the bounds are
 * those of all particles, so that the view stays as it is.
 *
 * A still picture is refined while nothing changes (SamplesPerPixel); screenshots wait for all of
 * it.
 */
#ifndef vtkRayTracedSphereRepresentation_h
#define vtkRayTracedSphereRepresentation_h

#include "ParticleOcclusionRepresentationsModule.h"
#include "vtkForwardSilhouettesMacro.h"
#include "vtkNew.h"
#include "vtkPVDataRepresentation.h"
#include "vtkSphereSilhouettes.h"

#include <memory>

class vtkActor;
class vtkImageData;
class vtkRayTracedSphereMapper;
class vtkScalarsToColors;

class PARTICLEOCCLUSIONREPRESENTATIONS_EXPORT vtkRayTracedSphereRepresentation
  : public vtkPVDataRepresentation
{
public:
  static vtkRayTracedSphereRepresentation* New();
  vtkTypeMacro(vtkRayTracedSphereRepresentation, vtkPVDataRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo) override;
  void SetVisibility(bool visible) override;

  ///@{
  /// Forwarded to vtkRayTracedSphereMapper.
  void SetRadiusArray(const char* name);
  void SetRadiusScale(double scale);
  void SetConstantRadius(double radius);
  void SetRadiusFrom(int source);
  void SetDensity(double density);
  void SetShadingMode(int mode);
  void SetOcclusionOnDiffuse(bool on);
  void SetShadows(bool on);
  void SetSamplesPerPixel(int samples);
  void SetInteractiveRate(double framesPerSecond);
  void SetTextureFile(const char* name);
  void SetTextureBudget(double mebibytes);
  void AddCropRange(const char* array, int component, double low, double high);
  void RemoveAllCropRanges();
  void SetLookupTable(vtkScalarsToColors* table);
  vtkImageData* GetLayers();
  vtkIdType GetNumberOfSpheres();
  vtkIdType GetNumberOfShownSpheres();
  vtkIdType GetNumberOfScenes();
  vtkIdType GetNumberOfRays();
  vtkIdType GetNumberOfShadowRays();
  vtkIdType GetNumberOfSkippedTiles();
  vtkIdType GetNumberOfSkippedShadowRays();
  vtkIdType GetNumberOfTracedFrames();
  int GetNumberOfSamples();
  vtkIdType GetNumberOfResidentTextures();
  vtkIdType GetResidentTextureBytes();
  vtkIdType GetNumberOfMissingTextures();
  double GetTraceSeconds();
  double GetShadowSeconds();
  double GetShadeSeconds();
  ///@}

  /// Where the radii came from, in words; of the particles of all processes.
  const char* GetRadiusUsed();

  ///@{
  /// One range for the panel, beside those of AddCropRange: shows only particles whose value of the
  /// array is within it. Without a name (default), or with another association than points, there
  /// is no such range. Component -1 (default) is the magnitude.
  void SetCropArray(int index, int port, int connection, int association, const char* name);
  void SetCropComponent(int component);
  void SetCropRange(double low, double high);
  ///@}

  ///@{
  /// Shows only particles whose centres lie in front of a plane. Default off.
  void SetCropPlane(bool on);
  void SetCropPlaneOrigin(double x, double y, double z);
  void SetCropPlaneNormal(double x, double y, double z); ///< points to what is shown
  ///@}

  ///@{
  /// Shows only particles whose centres lie in a box along the axes. Default off.
  void SetCropBox(bool on);
  void SetCropBoxOrigin(double x, double y, double z); ///< the lower corner
  void SetCropBoxSize(double x, double y, double z);
  ///@}

  ///@{
  /// Blocks of a composite data set by selectors in its hierarchy: those that are shown (default
  /// "/", all), and those with a colour or an opacity of their own. Other assemblies than the
  /// hierarchy are not supported.
  void SetActiveAssembly(const char* name);
  void AddBlockSelector(const char* selector);
  void RemoveAllBlockSelectors();
  void SetBlockColor(const char* selector, double red, double green, double blue);
  void RemoveAllBlockColors();
  void SetBlockOpacity(const char* selector, double opacity);
  void RemoveAllBlockOpacities();
  ///@}

  ///@{
  /// OpenEXR file that WriteLayers() writes. Default: none.
  void SetLayersFile(const char* name);
  const char* GetLayersFile();
  ///@}

  /// Width and height of the layers, up to 65,536. Default 0 0: as large as the last frame that was
  /// drawn.
  void SetLayersResolution(int width, int height);

  /// Writes layers of the view to the LayersFile: RGBA, Z, AO, N and particle id, of this
  /// representation alone, as vtkRenderedLayersWriter describes them; on the process that draws. An
  /// error says what is wrong if there is no file name, nothing has been drawn yet, several
  /// processes draw together, or the file cannot be written.
  void WriteLayers();

  ///@{
  /// Lines where the depth jumps, in whatever render view this is shown; see vtkSphereSilhouettes.
  /// Default: not visible. Where several processes draw the spheres they find the lines together,
  /// but not on a wall of displays.
  vtkForwardSilhouettesMacro(Silhouettes);

  /// What is drawn in the view.
  vtkActor* GetActor() { return this->Actor; }
  ///@}

  /// 1: numbers become colours by the lookup table; 0: arrays of colours are used as they are.
  void SetMapScalars(int map);

  ///@{
  /// Forwarded to the actor.
  void SetOrientation(double x, double y, double z);
  void SetOrigin(double x, double y, double z);
  void SetPickable(int pickable);
  void SetPosition(double x, double y, double z);
  void SetScale(double x, double y, double z);
  ///@}

  ///@{
  /// Forwarded to the actor's property.
  void SetAmbient(double coefficient);
  void SetAmbientColor(double r, double g, double b);
  void SetDiffuse(double coefficient);
  void SetDiffuseColor(double r, double g, double b);
  void SetOpacity(double opacity);
  void SetSpecular(double coefficient);
  void SetSpecularColor(double r, double g, double b);
  void SetSpecularPower(double power);
  ///@}

protected:
  vtkRayTracedSphereRepresentation();
  ~vtkRayTracedSphereRepresentation() override;

  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkRayTracedSphereRepresentation(const vtkRayTracedSphereRepresentation&) = delete;
  void operator=(const vtkRayTracedSphereRepresentation&) = delete;

  void PrepareFrame(vtkInformation* inInfo);
  void ProvideData(vtkInformation* inInfo, vtkInformation* outInfo);
  bool IsTranslucent();
  void ReleaseMemory();
  void ShareExtent();
  void UpdateBounds();
  void UpdateColoring();

  vtkNew<vtkActor> Actor;
  vtkNew<vtkRayTracedSphereMapper> Mapper;
  vtkNew<vtkSphereSilhouettes> Silhouettes;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
