// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TracedDepth_h
#define po_TracedDepth_h

#include "FrameTracer.h"
#include "SphereDepth.h"

namespace po
{
/// A traced frame and what it was traced from.
struct TracedLayer
{
  const TracedFrame& frame;
  const PrimaryRays& rays;
  const std::vector<Sphere>& spheres;
};

/// The depths of traced frames of one window, one sample a pixel, the nearest layer in front.
class TracedDepth : public SphereDepth
{
public:
  /// All layers must be of the same size. They are not copied.
  explicit TracedDepth(std::vector<TracedLayer> layers);

  [[nodiscard]] int width() const override { return layers_.front().frame.width; }
  [[nodiscard]] int height() const override { return layers_.front().frame.height; }
  [[nodiscard]] const std::vector<DepthRange>& ranges() const override
  {
    return merged_.empty() ? layers_.front().frame.tiles : merged_;
  }
  void fill(SampleBlock& block) const override;

  /// The spheres of the layers are counted one after the other.
  void fillSpheres(const SampleBlock& block, std::vector<std::uint32_t>& numbers) const override;
  [[nodiscard]] std::size_t layerCount() const override { return layers_.size(); }
  [[nodiscard]] SphereLayer layer(std::size_t index) const override;

private:
  [[nodiscard]] std::uint32_t numberAt(std::size_t pixel) const;

  std::vector<TracedLayer> layers_;
  std::vector<std::uint32_t> firstSpheres_; ///< number of the first sphere of each layer
  std::vector<DepthRange> merged_;          ///< of several layers
};
}

#endif
