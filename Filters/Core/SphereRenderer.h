// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SphereRenderer_h
#define po_SphereRenderer_h

#include "SceneCache.h"
#include "Shading.h"
#include "SphereCloud.h"

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
  std::size_t shadowsTraced = 0; ///< masks of single lights
  double buildSeconds = 0, traceSeconds = 0, shadowSeconds = 0, shadeSeconds = 0;
};

/// Spheres from cloud to pixels; each step is repeated only when what it depends on has changed.
///
/// Steps: scene (spheres), frame (view, size, placement), shadows (a light's geometry), colours.
class SphereRenderer
{
public:
  /// @param scenes shared with other renderers
  explicit SphereRenderer(std::shared_ptr<SceneCache> scenes = std::make_shared<SceneCache>())
    : scenes_(std::move(scenes))
  {
  }

  /// New spheres; the scene is built when the first frame asks for it.
  void setCloud(SphereCloud cloud);

  [[nodiscard]] const SphereCloud& cloud() const { return cloud_; }

  /// Traces the view unless the last frame was of the same view and spheres. False if nothing can
  /// be drawn: the window is empty or a matrix singular.
  /// @param modelToWorld the actor's matrix: from the coordinates of the particles to the world's
  /// Throws std::runtime_error or std::bad_alloc when the scene cannot be built.
  bool trace(const Camera& camera, const Matrix4& modelToWorld);

  /// Colours the traced frame. With `castShadows` masks of lights that stay are kept.
  void shade(const Material& material, const OcclusionTextures& textures,
    const std::vector<Light>& lights, bool castShadows);

  /// Do the results below belong together? Not before the first shade, nor after new spheres or a
  /// new view until they are shaded.
  [[nodiscard]] bool isShaded() const { return isShaded_; }

  // Results of the last trace and shade, row by row from the lower left corner.
  [[nodiscard]] const TracedFrame& frame() const { return frame_; }
  [[nodiscard]] const std::vector<std::uint8_t>& rgba() const { return rgba_; }

  /// Only after a trace that succeeded.
  [[nodiscard]] const PrimaryRays& rays() const { return *rays_; }

  [[nodiscard]] const RenderStatistics& statistics() const { return statistics_; }

private:
  void buildScene();
  void castShadows(const std::vector<Light>& lights);

  std::shared_ptr<SceneCache> scenes_;
  SphereCloud cloud_;
  std::shared_ptr<const SphereScene> scene_;
  std::optional<PrimaryRays> rays_;
  Camera camera_{};
  Matrix4 modelToWorld_{};
  bool frameIsCurrent_ = false;
  bool isShaded_ = false;
  TracedFrame frame_;
  std::vector<Light> shadowLights_; ///< of the masks
  ShadowMasks shadows_;
  std::vector<std::uint8_t> rgba_;
  RenderStatistics statistics_;
};
}

#endif
