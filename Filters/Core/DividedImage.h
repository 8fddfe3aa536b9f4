// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_DividedImage_h
#define po_DividedImage_h

#include "DividedDepth.h"
#include "EyeDistance.h"
#include "ImageDepth.h"

namespace po
{
/// A z-buffer as it was read, with `samples` x `samples` depths a pixel.
struct ZBuffer
{
  std::vector<float>& z; ///< row by row from the bottom
  int width, height;     ///< multiples of `samples`
  int samples;
  WindowToEye windowToEye;

  [[nodiscard]] int widthInPixels() const { return width / samples; }
  [[nodiscard]] int heightInPixels() const { return height / samples; }

  /// Samples of a tile of DepthTileSize pixels.
  [[nodiscard]] PixelRange samplesOf(int tile) const;
};

/// Pictures of anything that are divided over processes: their z-buffers. The depths are those of
/// one process that has drawn all into its z-buffer, to the bit.
class DividedImage
  : public DividedDepth
  , public DepthSource
{
public:
  /// @param own what this process has drawn. Where depths of others come they are put into it.
  /// @param distances room for the depths of all samples
  DividedImage(const ZBuffer& own, std::vector<float>& distances);

  [[nodiscard]] int width() const override { return own_.widthInPixels(); }
  [[nodiscard]] int height() const override { return own_.heightInPixels(); }

  [[nodiscard]] std::vector<DepthRange> ownRanges() const override { return depth_.ranges(); }
  void appendOwn(const std::vector<int>& tiles, const std::vector<DepthRange>& ranges,
    ProcessGroup::Words& words) const override;
  void assemble(const ProcessGroup::Words& words, std::vector<DepthRange> ranges) override;
  [[nodiscard]] bool empty() const override { return isEmpty_; }
  void findLines(const SilhouetteRule& rule, SilhouetteImage& image) const override;
  [[nodiscard]] const std::vector<DepthRange>& ranges() const override { return ranges_; }
  [[nodiscard]] float windowDepth(int pixel) const override;
  [[nodiscard]] int processOf(int) const override { return 0; }
  void fill(SampleBlock& block) const override { depth_.fill(block); }

private:
  void takeTile(int tile, const float* z);
  void measureTile(int tile);
  [[nodiscard]] std::size_t samplesIn(int tile) const;

  ZBuffer own_;
  std::vector<float>& distances_;
  ImageDepth<float> depth_;        ///< of distances_
  std::vector<DepthRange> ranges_; ///< of all processes
  bool isEmpty_ = true;
};
}

#endif
