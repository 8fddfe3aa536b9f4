// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_LeaderSearch_h
#define po_LeaderSearch_h

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace po
{
/// Square of the RMS difference between textures, weighted by the texels' shares in the area of a
/// sphere; or anything above `stopAt` where it is above that.
[[nodiscard]] double squareDifference(
  const std::vector<float>& shares, const float* a, const float* b, double stopAt = 1e300);

/// Finds textures that may stand for others, its leaders.
class LeaderSearch
{
public:
  /// @param shares of the texels in the area of a sphere
  /// @param allowed RMS difference between a texture and its leader
  /// @param mostTried leaders of about the same mean, the latest ones
  LeaderSearch(std::vector<float> shares, double allowed, std::size_t mostTried);

  /// The number of the first leader that is near enough, or -1. Only leaders of nearly the same
  /// mean are looked at, which is necessary.
  [[nodiscard]] std::int32_t find(const float* texture) const;

  void add(std::int32_t number, std::vector<float> texture);

private:
  struct Leader
  {
    std::int32_t number;
    std::vector<float> texture;
  };

  [[nodiscard]] long cellOf(const float* texture) const;
  [[nodiscard]] bool isNear(const float* texture, const Leader& leader) const;

  std::vector<float> shares_;
  double allowed_;
  std::size_t mostTried_;
  std::map<long, std::vector<Leader>> byMean_;
};
}

#endif
