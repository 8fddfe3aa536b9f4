// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_TextureRecorder_h
#define po_TextureRecorder_h

#include "BenchmarkJudge.h"
#include "OcclusionEstimator.h"

#include <cstddef>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace po
{
/// Gets the raw textures while they are made.
using TextureObserver = std::function<void(const RawTextures&)>;

/// RMS difference from values that an earlier run wrote, weighted like the error of a judge.
class TextureComparison
{
public:
  TextureComparison(const std::string& file, int resolution);

  /// Throws std::runtime_error if the file has no more values.
  void add(const RawTextures& raw);

  [[nodiscard]] double rms() const;

private:
  std::ifstream file_;
  int resolution_;
  double squares_ = 0;
  double area_ = 0;
};

/// Passes on what an estimator finds and keeps the textures of some particles.
class TextureRecorder : public OcclusionEstimator
{
public:
  /// @param positions of the particles to keep, in the list that will be estimated
  /// @param texels of a texture
  TextureRecorder(const OcclusionEstimator& estimator, const std::vector<std::size_t>& positions,
    std::size_t texels, TextureObserver observer = {});

  void estimate(const BakeScene& scene, const std::vector<unsigned>& particles,
    const BakeSettings& settings, Progress& progress, const Sink& sink,
    BakeCounters& counters) const override;

  [[nodiscard]] double bytesPerTexel() const override { return estimator_.bytesPerTexel(); }

  [[nodiscard]] const JudgedTexels& kept() const { return kept_; }

private:
  void keep(const RawTextures& raw) const;

  const OcclusionEstimator& estimator_;
  std::size_t texels_;
  TextureObserver observer_;
  std::map<std::size_t, std::size_t> slots_;
  mutable JudgedTexels kept_;
};
}

#endif
