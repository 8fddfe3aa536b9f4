// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkSphereAmbientOcclusion_h
#define vtkSphereAmbientOcclusion_h

#include "ParticleOcclusionFiltersModule.h"
#include "vtkPassInputTypeAlgorithm.h"
#include "vtkSmartPointer.h"

#include <memory>

class vtkMultiProcessController;

/**
 * @class vtkSphereAmbientOcclusion
 * @brief Bakes ambient occlusion onto every particle.
 *
 * Every point of the input is a sphere. For each the filter finds how much of the background its
 * surface sees past all other spheres, as a texture of T x T values in latitude and longitude, in
 * parallel with Embree. The input is any vtkPointSet (poly data, unstructured grid, ...; only its
 * points count), or a composite data set of them whose blocks occlude each other.
 *
 * The second input, port 1, is optional: a vtkPolyData, or a composite data set of them, that
 * darkens the particles but gets no textures and is not part of the output. Of a block that has
 * polygons or strips these occlude, from both sides; no part of a particle counts as inside a mesh.
 * The points of other blocks are spheres, with radii as on the first input. Sweep knows spheres
 * only: triangles are for the Methods Embree, which Automatic then takes, and Reference. Triangles
 * with a corner that is NaN or infinite are left out with one warning that counts them.
 *
 * The output is a shallow copy of the input plus
 * - point data `AmbientOcclusion`, float32[N]: mean visibility of the particle over the area that
 * is outside other particles, linear, 0 (exactly: no light arrives) to 1 (open; more under a
 * brighter background);
 * - point data `AmbientOcclusionTexture`, int32[N]: row of the particle's texture in the table;
 * - field data `AmbientOcclusionTextures`: one tuple a distinct texture, T*T components, uint8 or
 *   float32. With the storages VariableSize and Compressed textures have different lengths: tuples
 *   are words of 4 bytes, and a particle's row is the first one of its texture; PackedFormat.h says
 *   how they are read, and Compressed adds the field data `AmbientOcclusionBasis`;
 * - field data `AmbientOcclusionParameters`: strings "key=value", all that is needed to decode the
 *   table and to bake it again.
 *
 * A texel is the mean of (1/pi) * integral of V(x, w) L(w) max(0, n.w) dw over the part of its area
 * that is outside all other spheres: V is visibility, L the luminance of the background; with
 * BakeLight direct light is mixed in. Component
 * j*T + i covers polar angles [j pi/T, (j+1) pi/T] from +z and azimuths [2 pi i/T, 2 pi (i+1)/T]
 * from +x towards +y.
 *
 * Particles whose position or radius is NaN, infinite, zero or negative are left out with one
 * warning that counts them: row -1, visibility 0. If a parameter or array is wrong, memory runs
 * out or Embree fails, the filter reports one error that says so, its error code is not
 * vtkErrorCode::NoError, and it passes the input on unchanged: never with part of a table. When
 * aborted, it passes the input on too, without an error.
 *
 * What a bake may need at most is compared with what is free before it begins: of the machine, of
 * the limits of the process, and of the environment variable PARTICLEOCCLUSION_MEMORY_LIMIT, in
 * KiB, for batch jobs and containers whose limit the system does not tell.
 *
 * With UseCache a bake is kept in CacheDirectory, and loaded again, bit by bit, when the same
 * particles are baked with the same parameters: after a change that was undone, in a later session,
 * at a time step that was there before, by another process. What goes wrong with the cache is a
 * warning; entries that are damaged or of other data are noticed and replaced.
 *
 * The processes of Controller bake together: each gets the textures of its own particles, in the
 * light that the particles and occluders of all processes leave. 16 bytes of each sphere travel; of
 * those beyond MaximumDistance nothing does. Textures are the same bits for any number of processes
 * and any distribution of the particles, but for rounding where MaximumDistance is set, and where
 * TargetError asks for sums over processes. Duplicate points of vtkGhostType count once. Numbers
 * about the execution are those of all processes. An error of one process is the one error of all,
 * reported by the first; when one is aborted, so are all, as soon as they are done with their part.
 */
class PARTICLEOCCLUSIONFILTERS_EXPORT vtkSphereAmbientOcclusion : public vtkPassInputTypeAlgorithm
{
public:
  static vtkSphereAmbientOcclusion* New();
  vtkTypeMacro(vtkSphereAmbientOcclusion, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Input ports, for SetInputConnection and SetInputData.
  enum InputPort
  {
    ParticlesPort = 0,
    OccludersPort = 1 ///< optional: meshes and spheres that occlude but are not baked
  };

  ///@{
  /**
   * Point array that gives the radii, as RadiusFrom says; one component. Empty (default) or
   * "(automatic)": for radii the first of radius, Radius, rad, r, diameter that exists, else
   * ConstantRadius. "(none)": ConstantRadius. Of an array named diameter half the value is the
   * radius.
   */
  vtkSetStringMacro(RadiusArray);
  vtkGetStringMacro(RadiusArray);
  ///@}

  /// What the values of RadiusArray are.
  enum RadiusSourceType
  {
    RadiiInArray = 0, ///< the values of RadiusArray
    Diameters = 1,    ///< half of them; (automatic): diameter, Diameter, d
    Elements = 2,     ///< van der Waals radii in Å (Bondi 1964) of symbols or atomic numbers;
                      ///< (automatic): element, atom_type, Atomic Numbers, atomic_number
    Masses = 3        ///< of spheres of that mass and the Density; (automatic): mass, Mass, m
  };

  ///@{
  /// What RadiusArray holds [RadiiInArray].
  vtkSetMacro(RadiusFrom, int);
  vtkGetMacro(RadiusFrom, int);
  ///@}

  ///@{
  /// Mass per volume of the particles, positive, in the units of the masses and the points; for
  /// RadiusFrom Masses [1].
  vtkSetMacro(Density, double);
  vtkGetMacro(Density, double);
  ///@}

  ///@{
  /// Factor on every radius, positive [1].
  vtkSetMacro(RadiusScale, double);
  vtkGetMacro(RadiusScale, double);
  ///@}

  ///@{
  /// Radius where no array is used, in the units of the points; 0 [default]: of the elements if the
  /// points have them (RadiusFrom), else half the median distance to the nearest neighbour.
  vtkSetMacro(ConstantRadius, double);
  vtkGetMacro(ConstantRadius, double);
  ///@}

  ///@{
  /// Texels along each side of a texture, 1 to 64 [16]. Time and memory grow with its square.
  vtkSetMacro(TextureResolution, int);
  vtkGetMacro(TextureResolution, int);
  ///@}

  ///@{
  /// Quality: the noise that this many jittered rays a texel leave, 1 to 1,048,576 [49].
  vtkSetMacro(SamplesPerTexel, int);
  vtkGetMacro(SamplesPerTexel, int);
  ///@}

  ///@{
  /**
   * RMS error of linear visibility to reach, area-weighted over the set; 0 [default] = off. When
   * set, it takes the place of SamplesPerTexel: Sweep adds directions until the spread of subsets
   * of them says that it is reached, or leaves the few particles above it to rays; Embree does so
   * for every particle by itself, Reference finds the number of rays by a pilot bake. At most 1.
   */
  vtkSetMacro(TargetError, double);
  vtkGetMacro(TargetError, double);
  ///@}

  /// How visibility is found.
  enum MethodType
  {
    Automatic = 0, ///< Sweep; Embree if a mesh occludes, MaximumDistance is at most two mean radii
                   ///< or goes with ReuseUnchanged, or the memory for Sweep is not there
    Sweep = 1,     ///< exact visibility of all particles along directions that they share, no rays
    Embree = 2,    ///< along such directions too: near particles exactly, by few rays what is far
    Reference = 3  ///< jittered rays from every texel, one occlusion ray a sample
  };

  ///@{
  /// How visibility is found [Automatic].
  vtkSetMacro(Method, int);
  vtkGetMacro(Method, int);
  ///@}

  ///@{
  /// Rays end at this distance, in the units of the points: what is farther does not occlude.
  /// 0 [default] = unbounded.
  vtkSetMacro(MaximumDistance, double);
  vtkGetMacro(MaximumDistance, double);
  ///@}

  /// Where the light comes from that occlusion takes away.
  enum BackgroundType
  {
    Uniform = 0, ///< luminance 1 from everywhere
    Gradient = 1,
    Image = 2
  };

  ///@{
  /// The light that occlusion takes away [Uniform].
  vtkSetMacro(Background, int);
  vtkGetMacro(Background, int);
  ///@}

  ///@{
  /// Gradient background: where it is brightest, any length but zero [0 0 1].
  vtkSetVector3Macro(BackgroundUp, double);
  vtkGetVector3Macro(BackgroundUp, double);
  ///@}

  ///@{
  /// Gradient background: luminance opposite to BackgroundUp, at least 0 [0].
  vtkSetMacro(BackgroundBottom, double);
  vtkGetMacro(BackgroundBottom, double);
  ///@}

  ///@{
  /// Gradient background: luminance at BackgroundUp, at least 0 [1].
  vtkSetMacro(BackgroundTop, double);
  vtkGetMacro(BackgroundTop, double);
  ///@}

  ///@{
  /// Image background: an OpenEXR file in latitude and longitude, first row at +z, first column at
  /// +x, columns towards +y.
  vtkSetFilePathMacro(BackgroundImage);
  vtkGetFilePathMacro(BackgroundImage);
  ///@}

  ///@{
  /**
   * Bake as if only some particles were there, as the crop of vtkRayTracedSphereRepresentation does
   * it: those within CropRange, from low to high, of a point array (CropArray; empty [default] or
   * "(none)": of none; CropComponent -1, the default, is the magnitude of vectors), with CropPlane
   * those whose centres lie in front of a plane, with CropBox those whose centres lie in a box
   * along the axes. The others neither occlude nor get a texture: row -1, visibility 0. They stay
   * in the output, and count as left out, without a warning. Occluders are not cropped.
   */
  vtkSetStringMacro(CropArray);
  vtkGetStringMacro(CropArray);
  vtkSetMacro(CropComponent, int);
  vtkGetMacro(CropComponent, int);
  vtkSetVector2Macro(CropRange, double);
  vtkGetVector2Macro(CropRange, double);
  vtkSetMacro(CropPlane, bool);
  vtkGetMacro(CropPlane, bool);
  vtkBooleanMacro(CropPlane, bool);
  vtkSetVector3Macro(CropPlaneOrigin, double);
  vtkGetVector3Macro(CropPlaneOrigin, double);
  vtkSetVector3Macro(CropPlaneNormal, double);
  vtkGetVector3Macro(CropPlaneNormal, double);
  vtkSetMacro(CropBox, bool);
  vtkGetMacro(CropBox, bool);
  vtkBooleanMacro(CropBox, bool);
  vtkSetVector3Macro(CropBoxOrigin, double);
  vtkGetVector3Macro(CropBoxOrigin, double);
  vtkSetVector3Macro(CropBoxSize, double);
  vtkGetVector3Macro(CropBoxSize, double);
  ///@}

  ///@{
  /**
   * Bake a distant light too, with hard shadows [off]. A texel is then (A + I D) / (1 + I): A its
   * value without, I the LightIntensity, and D the mean of V(x, l) max(0, n.l) over the part of its
   * area that is outside all other spheres, with l the direction towards the light.
   * AmbientOcclusion is the mean of these values. vtkRayTracedSphereMapper then does not light the
   * textures again.
   */
  vtkSetMacro(BakeLight, bool);
  vtkGetMacro(BakeLight, bool);
  vtkBooleanMacro(BakeLight, bool);
  ///@}

  ///@{
  /// Direction in world space along which the baked light shines, -l; any length but zero
  /// [1 -1 -1: from the upper left of a view along -z].
  vtkSetVector3Macro(LightDirection, double);
  vtkGetVector3Macro(LightDirection, double);
  ///@}

  ///@{
  /// What a surface that faces the baked light receives of it, where an open one receives 1 of the
  /// uniform background, at least 0 [1]. Values do not grow with it, since they are divided by
  /// 1 + LightIntensity: at 0 only the background is seen, at large values only the light.
  vtkSetMacro(LightIntensity, double);
  vtkGetMacro(LightIntensity, double);
  ///@}

  ///@{
  /// Fill texels that lie inside other particles from their neighbours, so that interpolation does
  /// not darken the rim of an overlap [on]. When off they are 0.
  vtkSetMacro(DilateInside, bool);
  vtkGetMacro(DilateInside, bool);
  vtkBooleanMacro(DilateInside, bool);
  ///@}

  ///@{
  /// A texel of which less than this share is outside other particles counts as inside, 0 to 1
  /// [0.05].
  vtkSetMacro(InsideThreshold, double);
  vtkGetMacro(InsideThreshold, double);
  ///@}

  /// How the table stores a value.
  enum EncodingType
  {
    UInt8Gamma2 = 0,  ///< byte = round(255 sqrt(value / maximum))
    Float32Linear = 1 ///< the value itself
  };

  ///@{
  /// How the table stores values [UInt8Gamma2].
  vtkSetMacro(Encoding, int);
  vtkGetMacro(Encoding, int);
  ///@}

  /// What the table stores of a texture.
  enum StorageType
  {
    Full = 0,         ///< T x T texels
    VariableSize = 1, ///< each texture at the fewest texels that keep to StorageError
    Compressed = 2,   ///< coefficients in a basis that all textures share; StorageError holds for
                      ///< the set, and no texture is off by more than thrice of what it allows
    OneValue = 3      ///< the particle's mean alone
  };

  ///@{
  /// How much of each texture is stored [Full]. VariableSize and Compressed ask for UInt8Gamma2.
  vtkSetMacro(Storage, int);
  vtkGetMacro(Storage, int);
  ///@}

  ///@{
  /**
   * What the storages VariableSize and Compressed may add to the RMS error of linear visibility,
   * which is the displayed value, 0 to 1 [0.01]. Textures may differ from what was baked, in RMS
   * over the sphere, by sqrt(e^2 + 2 e n), with n a third of the estimated error of the bake: noise
   * of the bake need not be kept.
   */
  vtkSetMacro(StorageError, double);
  vtkGetMacro(StorageError, double);
  ///@}

  ///@{
  /// Seed of all random numbers, at least 0 [1]. The same seed gives the same bits, for any number
  /// of threads.
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * Point array of numbers that name the particles through time. Random numbers are seeded by them,
   * so that what does not move keeps its noise from one step to the next; of Sweep, which needs
   * none, nothing changes. Empty (default) or "(automatic)": the first of id, Id, ID, ParticleId,
   * GlobalNodeId, GlobalPointIds that exists. "(none)", or where there is none: place and radius
   * seed. Particles of the same number have the same random numbers.
   */
  vtkSetStringMacro(IdArray);
  vtkGetStringMacro(IdArray);
  ///@}

  ///@{
  /**
   * Keep the textures of an execution, and at the next one bake only particles that were moved or
   * are new, and those within MaximumDistance of where a sphere or triangle was moved, was added or
   * is gone [off]. The others get the bits that a bake would give. It needs a MaximumDistance, and
   * is for Embree, which Automatic then takes, and for Reference without a TargetError; else it
   * does nothing. Up to 8 bytes a texel are kept in memory, of every particle that is partly lit.
   *
   * The frame of floats, which else is the middle of the set and its mean radius, is rounded to
   * powers of two, so that it mostly stays: when it does not, all are baked. So they are when
   * parameters change, but for those of encoding, storage and dilation.
   */
  vtkSetMacro(ReuseUnchanged, bool);
  vtkGetMacro(ReuseUnchanged, bool);
  vtkBooleanMacro(ReuseUnchanged, bool);
  ///@}

  ///@{
  /**
   * Sweep keeps what it sees of the particles in a temporary file, instead of some KiB of memory a
   * particle [off]. Where memory would not do it does so anyway, and the textures have the same
   * bits. The file is in the folder that TMPDIR names, else /tmp; at the default resolution and
   * quality it takes 0.1 kB a particle (packings) to 1.5 (gases). With TargetError all is kept in
   * memory.
   */
  vtkSetMacro(OutOfCore, bool);
  vtkGetMacro(OutOfCore, bool);
  vtkBooleanMacro(OutOfCore, bool);
  ///@}

  ///@{
  /// Keep bakes in a cache and load from it [off].
  vtkSetMacro(UseCache, bool);
  vtkGetMacro(UseCache, bool);
  vtkBooleanMacro(UseCache, bool);
  ///@}

  ///@{
  /// Folder of the cache, which is made if need be. Empty [default]: ParticleOcclusion in the
  /// user's cache directory, $XDG_CACHE_HOME or ~/.cache. Processes and users may share a folder.
  vtkSetFilePathMacro(CacheDirectory);
  vtkGetFilePathMacro(CacheDirectory);
  ///@}

  ///@{
  /// Size of the folder, in MiB, beyond which the bakes that were used least recently are removed;
  /// 0 = never [4096].
  vtkSetClampMacro(CacheSizeLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(CacheSizeLimit, int);
  ///@}

  ///@{
  /// The processes whose particles make up one set [the global controller]. Null: this one alone.
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  ///@{
  /// What the last execution did and what it could skip, on all processes together.
  vtkIdType GetNumberOfParticles();
  vtkIdType GetNumberOfTexels();
  vtkIdType GetNumberOfRays();
  vtkIdType GetNumberOfSamplesInside();    ///< inside another particle: no ray, no weight
  vtkIdType GetNumberOfTexelsInside();     ///< wholly inside another particle: not sampled
  vtkIdType GetNumberOfParticlesBuried();  ///< inside one other particle: not looked at
  vtkIdType GetNumberOfParticlesDark();    ///< no light reaches them
  vtkIdType GetNumberOfParticlesLeftOut(); ///< no usable position or radius, or cropped
  vtkIdType GetNumberOfTextures();         ///< distinct ones: rows of the table
  vtkIdType GetNumberOfTextureBytes();     ///< size of the table
  vtkIdType GetNumberOfParticlesRefined(); ///< by rays: of Sweep with TargetError
  vtkIdType GetNumberOfParticlesReused();  ///< of the execution before, with ReuseUnchanged
  /// Of Sweep; a visit is one particle in one direction.
  vtkIdType GetNumberOfVisitsClosed();    ///< spared: buried under a particle in front
  vtkIdType GetNumberOfVisitsNeverSeen(); ///< spared: no direction had shown the particle
  vtkIdType GetNumberOfDirectionsBlack(); ///< spared: the background is black there
  vtkIdType GetNumberOfParticlesAlone();  ///< no other within MaximumDistance
  const char* GetMethodUsed();            ///< what Automatic chose
  const char* GetRadiusUsed();            ///< where the radii came from, in words
  int GetNumberOfDirections();   ///< of Sweep or Embree (the most of a particle), 0 otherwise
  int GetNumberOfThreads();      ///< threads that took part
  int GetNumberOfSamplesUsed();  ///< differs from SamplesPerTexel with Reference and TargetError
  double GetStorageDifference(); ///< RMS, over all spheres, of what storing has changed
  double GetEstimatedError();    ///< RMS error of linear visibility, 0 where none was found
  double GetBakeSeconds();       ///< wall time of the whole execution
  /// Whether there was no bake: the other numbers are then those of the bake that was kept.
  bool GetLoadedFromCache();
  ///@}

  /// What an execution would take: time and memory in words, for the particles of this process as
  /// they were last read, and for its cores and free memory; empty where there are none yet.
  const char* GetBakeEstimate();

protected:
  vtkSphereAmbientOcclusion();
  ~vtkSphereAmbientOcclusion() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSphereAmbientOcclusion(const vtkSphereAmbientOcclusion&) = delete;
  void operator=(const vtkSphereAmbientOcclusion&) = delete;

  char* RadiusArray = nullptr;
  double RadiusScale = 1.0;
  double ConstantRadius = 0.0;
  int RadiusFrom = RadiiInArray;
  double Density = 1.0;
  int TextureResolution = 16;
  int SamplesPerTexel = 49;
  double TargetError = 0.0;
  int Method = Automatic;
  double MaximumDistance = 0.0;
  int Background = Uniform;
  double BackgroundUp[3] = { 0, 0, 1 };
  double BackgroundBottom = 0.0;
  double BackgroundTop = 1.0;
  char* BackgroundImage = nullptr;
  char* CropArray = nullptr;
  int CropComponent = -1;
  double CropRange[2] = { -1e300, 1e300 };
  bool CropPlane = false;
  double CropPlaneOrigin[3] = { 0, 0, 0 };
  double CropPlaneNormal[3] = { 0, 0, 1 };
  bool CropBox = false;
  double CropBoxOrigin[3] = { 0, 0, 0 };
  double CropBoxSize[3] = { 1, 1, 1 };
  bool BakeLight = false;
  double LightDirection[3] = { 1, -1, -1 };
  double LightIntensity = 1.0;
  bool DilateInside = true;
  double InsideThreshold = 0.05;
  int Encoding = UInt8Gamma2;
  int Storage = Full;
  double StorageError = 0.01;
  int Seed = 1;
  char* IdArray = nullptr;
  bool ReuseUnchanged = false;
  bool OutOfCore = false;
  bool UseCache = false;
  char* CacheDirectory = nullptr;
  int CacheSizeLimit = 4096;
  vtkSmartPointer<vtkMultiProcessController> Controller;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
