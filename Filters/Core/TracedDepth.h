// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TracedDepth_h
#define po_TracedDepth_h

#include "DepthSource.h"
#include "FrameTracer.h"

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
class TracedDepth : public DepthSource
{
public:
  /// All layers must be of the same size. They are not copied.
  explicit TracedDepth(std::vector<TracedLayer> layers);

  [[nodiscard]] const std::vector<TracedLayer>& layers() const { return layers_; }

  [[nodiscard]] int width() const override { return layers_.front().frame.width; }
  [[nodiscard]] int height() const override { return layers_.front().frame.height; }
  [[nodiscard]] const std::vector<DepthRange>& ranges() const override
  {
    return merged_.empty() ? layers_.front().frame.tiles : merged_;
  }
  void fill(SampleBlock& block) const override;

  /// The layer that pixel `pixel` shows.
  [[nodiscard]] const TracedLayer& layerAt(std::size_t pixel) const;

private:
  void fillRow(SampleBlock& block, int j) const;

  std::vector<TracedLayer> layers_;
  std::vector<DepthRange> merged_; ///< of several layers
};
}

#endif
