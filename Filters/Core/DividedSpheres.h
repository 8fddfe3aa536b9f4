// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_DividedSpheres_h
#define po_DividedSpheres_h

#include "DividedDepth.h"
#include "SharedDepth.h"

namespace po
{
/// Traced frames of spheres that are divided over processes. Which sphere each pixel shows
/// travels, not depths.
class DividedSpheres : public DividedDepth
{
public:
  /// @param own frames that this process has traced, maybe none; all of the camera's size. They are
  /// not copied.
  /// @param process this one
  /// @param room where frames of all processes are put together, kept from picture to picture
  DividedSpheres(
    const std::vector<TracedLayer>& own, const Camera& camera, int process, SharedDepth& room)
    : own_(own)
    , camera_(camera)
    , process_(process)
    , all_(room)
  {
  }

  [[nodiscard]] int width() const override { return camera_.width; }
  [[nodiscard]] int height() const override { return camera_.height; }
  [[nodiscard]] std::vector<DepthRange> ownRanges() const override;
  void appendOwn(const std::vector<int>& tiles, const std::vector<DepthRange>& ranges,
    ProcessGroup::Words& words) const override;
  void assemble(const ProcessGroup::Words& words, std::vector<DepthRange> ranges) override;
  [[nodiscard]] bool empty() const override { return all_.empty(); }
  [[nodiscard]] const std::vector<DepthRange>& ranges() const override { return all_.ranges(); }
  void findLines(const SilhouetteRule& rule, SilhouetteImage& image) const override;
  [[nodiscard]] float windowDepth(int pixel) const override { return all_.windowDepth(pixel); }
  [[nodiscard]] int processOf(int pixel) const override { return all_.processOf(pixel); }

private:
  const std::vector<TracedLayer>& own_;
  const Camera& camera_;
  int process_;
  SharedDepth& all_;
};
}

#endif
