// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_SharedDepth_h
#define po_SharedDepth_h

#include "ProcessGroup.h"
#include "TracedDepth.h"

#include <optional>

namespace po
{
struct SharedTile;
struct SharedTiles;

/// Depths that several processes have traced, the nearest of all in front. Keeps its memory from
/// picture to picture. Only the tiles that have come are there.
class SharedDepth : public SphereDepth
{
public:
  /// @param camera of the picture, the same that all have traced with
  /// @param words of appendTiles(), of all processes one after the other
  /// @param ranges of all tiles, for those that have not come
  /// Throws std::runtime_error for a placement that is singular.
  void assemble(
    const Camera& camera, const ProcessGroup::Words& words, std::vector<DepthRange> ranges);

  /// Is nothing in sight of what has come?
  [[nodiscard]] bool empty() const { return rays_.empty(); }

  /// Window depth of what a pixel shows, 0 at the near and 1 at the far plane, 2: nothing.
  [[nodiscard]] float windowDepth(int pixel) const;

  /// The process whose sphere a pixel shows; 0 where there is none.
  [[nodiscard]] int processOf(int pixel) const;

  [[nodiscard]] int width() const override { return frame_.width; }
  [[nodiscard]] int height() const override { return frame_.height; }
  [[nodiscard]] const std::vector<DepthRange>& ranges() const override { return frame_.tiles; }
  void fill(SampleBlock& block) const override { merged_->fill(block); }

  void fillSpheres(const SampleBlock& block, std::vector<std::uint32_t>& numbers) const override
  {
    merged_->fillSpheres(block, numbers);
  }
  [[nodiscard]] std::size_t layerCount() const override { return rays_.size(); }
  [[nodiscard]] SphereLayer layer(std::size_t index) const override;

private:
  void clear(int width, int height);
  void setTile(const SharedTiles& arrived, const SharedTile* first, const SharedTile* last);
  void addTo(const SharedTiles& arrived, const SharedTile& tile);
  void addRow(const Sphere& sphere, std::uint32_t number, const PrimaryRayFunctions& rays, int x,
    int y, int count);

  TracedFrame frame_;       ///< t, sphere and tiles alone
  std::vector<int> filled_; ///< tiles of it
  std::vector<PrimaryRays> rays_;
  std::vector<std::uint32_t> firstSpheres_;
  std::vector<int> processes_; ///< of the layers
  std::vector<Sphere> spheres_;
  std::optional<TracedDepth> merged_; ///< of the frame, as if all spheres were of one layer
};
}

#endif
