// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereRenderer_h
#define po_SphereRenderer_h

#include "SampleAverage.h"
#include "SceneCache.h"
#include "Shading.h"
#include "SphereCloud.h"
#include "TextureDemand.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace po
{
/// What was done since the renderer exists, and how long the last of each step took, in seconds.
struct RenderStatistics
{
  TraceCounters trace;    ///< of the last traced frame
  ShadowCounters shadows; ///< the last time shadows were traced, over the lights that had moved
  std::size_t framesTraced = 0;
  std::size_t layersTraced = 0; ///< behind frames
  std::size_t samplesAdded = 0; ///< frames for smooth edges
  std::size_t framesShaded = 0;
  std::size_t shadowsTraced = 0; ///< masks of single lights
  double buildSeconds = 0, traceSeconds = 0, shadowSeconds = 0, shadeSeconds = 0;
  std::size_t missingTextures = 0; ///< in the last shaded frame, for which means are shown
  double waitSeconds = 0;          ///< for textures, in all
};

/// How a traced frame is to look. It refers to arrays of the caller.
struct Style
{
  Material material;
  OcclusionTextures textures;
  std::uint64_t texturesVersion = 0; ///< another number for other textures
  std::vector<Light> lights;
  bool waitForTextures = false; ///< of those that are loaded while they are seen; else means show
  bool shadows = false;
  int maximumLayers = 16; ///< of translucent spheres, one behind the other
};

/// One surface a pixel: what is seen, and its colours.
struct FrameLayer
{
  TracedFrame frame;
  std::vector<Light> shadowLights; ///< of the masks
  ShadowMasks shadows;
  std::vector<std::uint8_t> rgba;   ///< see shadeFrame(); zeros where nothing is wanted
  std::vector<std::uint8_t> wanted; ///< of each pixel; empty: all (the first layer)
};

/// Spheres from cloud to pixels; each step is repeated only when what it depends on has changed.
///
/// Steps: scene (spheres), frame (view, size, placement, hidden spheres), shadows (a light's
/// geometry), colours, layers behind translucent spheres, samples for smooth edges.
///
/// Textures that are loaded while they are seen (OcclusionTextures::paged()) are asked for when a
/// frame is shaded, and the frame is shaded again when they have arrived.
class SphereRenderer
{
public:
  /// @param scenes shared with other renderers
  explicit SphereRenderer(std::shared_ptr<SceneCache> scenes = std::make_shared<SceneCache>())
    : scenes_(std::move(scenes))
  {
  }

  /// New spheres, none hidden; the scene is built when the first frame asks for it.
  void setCloud(SphereCloud cloud);

  [[nodiscard]] const SphereCloud& cloud() const { return cloud_; }

  /// meanFreeLength() of the cloud, found when it is first asked for.
  [[nodiscard]] double freeLength() const;

  /// Of each sphere 1 if rays pass it, see hideSpheres(); empty: all are seen. The scene is kept.
  void setHidden(std::vector<std::uint8_t> hidden);

  /// Is the frame at hand of this view, so that trace() would have nothing to do?
  [[nodiscard]] bool isCurrent(const Camera& camera, const Matrix4& modelToWorld) const;

  /// Traces the view unless the last frame was of the same view and spheres. False if nothing can
  /// be drawn: the window is empty or a matrix singular.
  /// @param modelToWorld the actor's matrix: from the coordinates of the particles to the world's
  /// Throws std::runtime_error or std::bad_alloc when the scene cannot be built.
  bool trace(const Camera& camera, const Matrix4& modelToWorld);

  /// Colours the traced frame, and what is seen behind translucent spheres, unless the last time
  /// was in the same style and no texture of it has arrived since. Masks of lights that stay are
  /// kept.
  void shade(const Style& style);

  /// Adds rays through other places of the pixels until each pixel has had `samples` of them, and
  /// averages. Only after shade(), and not for translucent spheres. Depth, normals and ids stay
  /// those of the pixels' centres. Unless the style waits for textures, samples are added only as
  /// far as all of their textures are there.
  void refine(int samples);

  /// Rays a pixel in the averaged colours.
  [[nodiscard]] int samples() const { return samples_; }

  /// Are textures on their way, which the next shade() and refine() will show?
  [[nodiscard]] bool isWaiting() const;

  /// Has any of them come, if there are some on their way?
  [[nodiscard]] bool canGoOn() const;

  /// Do the results below belong together? Not before the first shade, nor after new spheres or a
  /// new view until they are shaded.
  [[nodiscard]] bool isShaded() const { return isShaded_; }

  // Results of the last trace and shade, row by row from the lower left corner.
  [[nodiscard]] const TracedFrame& frame() const { return first_.frame; }
  [[nodiscard]] const std::vector<std::uint8_t>& rgba() const { return first_.rgba; }

  /// Window depth of pixels that show spheres in averaged colours, though not at their centre; 2 on
  /// all others. Empty if there are none.
  [[nodiscard]] const std::vector<float>& rimDepth() const { return rimDepth_; }

  /// What is behind the first layer, front to back; empty unless translucent.
  [[nodiscard]] const std::vector<FrameLayer>& layersBehind() const { return behind_; }

  /// Only after a trace that succeeded.
  [[nodiscard]] const PrimaryRays& rays() const { return *rays_; }

  [[nodiscard]] const RenderStatistics& statistics() const { return statistics_; }

private:
  void buildScene();
  void forgetFrame();
  void beginPicture();
  std::size_t fetchTextures(const TracedFrame& frame);
  void castShadows(FrameLayer& layer);
  void shadeLayer(FrameLayer& layer);
  void shadeBehind();
  bool traceLayer(const FrameLayer& inFront, std::size_t number, std::vector<std::uint8_t> wanted);
  void traceSample();
  void addRims(const TracedFrame& sample);
  [[nodiscard]] FrameSettings settings(SamplePlace place = {}) const;

  std::shared_ptr<SceneCache> scenes_;
  SphereCloud cloud_;
  mutable std::optional<double> freeLength_;
  bool isComplete_ = false; ///< is each sphere's source that of its own number?
  std::vector<std::uint8_t> hidden_;
  std::shared_ptr<const SphereScene> scene_;
  std::optional<PrimaryRays> rays_;
  Camera camera_{};
  Matrix4 modelToWorld_{};
  bool frameIsCurrent_ = false;
  bool isShaded_ = false;
  bool isNewView_ = true;      ///< to the textures that are loaded while they are seen
  bool lacksTextures_ = false; ///< does the shaded frame show means of textures to come?
  TextureDemand demand_;
  Style style_;
  FrameLayer first_;
  std::vector<FrameLayer> behind_;
  FrameLayer sample_;    ///< the last one for smooth edges
  int tracedSample_ = 0; ///< its number; 0: none of this view
  SampleAverage average_;
  std::vector<float> rimDepth_;
  int samples_ = 0;
  RenderStatistics statistics_;
};
}

#endif
