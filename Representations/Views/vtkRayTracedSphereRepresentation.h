// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkRayTracedSphereRepresentation
 * @brief Shows the points of any data set as ray-traced spheres in a render view.
 *
 * The points of all blocks are shown together; textures that were baked onto the blocks stay with
 * their particles. Colour, light and shadows are those of vtkRayTracedSphereMapper, which documents
 * the parameters. Spheres are opaque: opacity is not used.
 */
#ifndef vtkRayTracedSphereRepresentation_h
#define vtkRayTracedSphereRepresentation_h

#include "ParticleOcclusionRepresentationsModule.h"
#include "vtkNew.h"
#include "vtkPVDataRepresentation.h"
#include "vtkSmartPointer.h"
#include "vtkTimeStamp.h"
#include "vtkWeakPointer.h"

#include <memory>
#include <string>

class vtkActor;
class vtkDataObject;
class vtkImageData;
class vtkPVRenderView;
class vtkPolyData;
class vtkRayTracedSphereMapper;
class vtkScalarsToColors;

namespace po
{
class DeliveredParticles;
}

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
  void SetShadingMode(int mode);
  void SetOcclusionOnDiffuse(bool on);
  void SetShadows(bool on);
  void SetLookupTable(vtkScalarsToColors* table);
  vtkImageData* GetLayers();
  vtkIdType GetNumberOfSpheres();
  vtkIdType GetNumberOfScenes();
  vtkIdType GetNumberOfRays();
  vtkIdType GetNumberOfShadowRays();
  vtkIdType GetNumberOfSkippedTiles();
  vtkIdType GetNumberOfSkippedShadowRays();
  double GetTraceSeconds();
  double GetShadowSeconds();
  double GetShadeSeconds();
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

  [[nodiscard]] bool DrawsHere();
  vtkSmartPointer<vtkImageData> MakeLayers();
  void ProvideData(vtkInformation* inInfo);
  void ResolveRadii();
  void UpdateBounds();
  void UpdateColoring();

  vtkNew<vtkActor> Actor;
  vtkNew<vtkRayTracedSphereMapper> Mapper;
  vtkSmartPointer<vtkPolyData> Particles;
  vtkSmartPointer<vtkDataObject> Piece; ///< the particles as they are delivered
  std::unique_ptr<po::DeliveredParticles> Delivered;
  std::string RadiusArray;
  double ConstantRadius = 0;
  double Bounds[6]; ///< of the spheres, radii included, before the actor's matrix
  vtkTimeStamp BoundsTime;
  vtkTimeStamp RadiusTime; ///< when a parameter of the radii was last set
  std::string LayersFile;
  int LayersResolution[2] = { 0, 0 };
  vtkWeakPointer<vtkPVRenderView> View;
};

#endif
