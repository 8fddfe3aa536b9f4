// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_BenchmarkJudge_h
#define po_BenchmarkJudge_h

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace po
{
/// Texels of some particles: linear visibility, and the shares of their area outside other spheres.
struct JudgedTexels
{
  std::vector<float> values; ///< particles * T * T
  std::vector<float> shares;
};

/// Nearly true visibility of a few particles of a scene, by which all methods are judged.
///
/// A file has lines of text "key value" up to the line "data", then, little-endian: the particles
/// as uint32, the values as uint16 (65535 is 1), the shares as uint8 (255 is 1).
struct Judge
{
  std::string scene;
  std::size_t spheres = 0;    ///< of the scene
  std::uint64_t checksum = 0; ///< of the scene's spheres
  int resolution = 16;
  int samples = 0;             ///< a texel, in two halves with seeds of their own
  std::uint64_t seeds[2] = {}; ///< none is that of what is measured
  double noise = 0;            ///< RMS error of the values, from the difference of the halves
  std::vector<unsigned> particles;
  JudgedTexels texels;
};

/// Mean of two independent estimates of the same texels, and its noise.
void mergeHalves(const JudgedTexels& a, const JudgedTexels& b, Judge& judge);

/// Both throw std::runtime_error if the file cannot be written or is no such file.
void writeJudge(const Judge& judge, const std::string& file);
[[nodiscard]] Judge readJudge(const std::string& file);

/// Of linear visibility, area-weighted over the part of the texels outside other spheres.
struct VisibilityError
{
  double rms = 0;
  double bias = 0;         ///< mean error: above 0 is too bright
  double percentile99 = 0; ///< of the absolute error
};

[[nodiscard]] VisibilityError errorOf(const JudgedTexels& found, const Judge& judge);
}

#endif
