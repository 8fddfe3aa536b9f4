// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_ImageDepth_h
#define po_ImageDepth_h

#include "DepthSource.h"

namespace po
{
/// Row-major image, sample (i, j) at depth[j * width + i].
template <typename T>
struct DepthImage
{
  const T* depth;
  int width;
  int height;
};

/// An image of `samples` x `samples` depths a pixel. Values that are not finite are background.
/// The image is not copied.
template <typename T>
class ImageDepth : public DepthSource
{
public:
  /// Width and height of the image must be multiples of `samples`.
  ImageDepth(const DepthImage<T>& image, int samples);

  [[nodiscard]] int width() const override { return image_.width / samples_; }
  [[nodiscard]] int height() const override { return image_.height / samples_; }
  [[nodiscard]] const std::vector<DepthRange>& ranges() const override { return ranges_; }
  void fill(SampleBlock& block) const override;

  /// The range of one tile, as the image is now.
  [[nodiscard]] DepthRange findRange(int tileX, int tileY) const;

private:
  void fillRow(SampleBlock& block, int j) const;

  DepthImage<T> image_;
  int samples_;
  std::vector<DepthRange> ranges_;
};

extern template class ImageDepth<float>;
extern template class ImageDepth<double>;
}

#endif
