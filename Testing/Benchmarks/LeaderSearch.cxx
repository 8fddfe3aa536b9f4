// SPDX-License-Identifier: BSD-3-Clause
#include "LeaderSearch.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace po
{
double squareDifference(
  const std::vector<float>& shares, const float* a, const float* b, double stopAt)
{
  double sum = 0;
  for (std::size_t i = 0; i < shares.size() && sum <= stopAt; ++i)
  {
    const double d = static_cast<double>(a[i] - b[i]);
    sum += static_cast<double>(shares[i]) * d * d;
  }
  return sum;
}

LeaderSearch::LeaderSearch(std::vector<float> shares, double allowed, std::size_t mostTried)
  : shares_(std::move(shares))
  , allowed_(allowed)
  , mostTried_(mostTried)
{
}

std::int32_t LeaderSearch::find(const float* texture) const
{
  for (long cell = cellOf(texture) - 1, last = cell + 2; cell <= last; ++cell)
  {
    const auto known = byMean_.find(cell);
    const std::size_t count = known == byMean_.end() ? 0 : known->second.size();
    for (std::size_t i = count > mostTried_ ? count - mostTried_ : 0; i < count; ++i)
    {
      if (isNear(texture, known->second[i]))
      {
        return known->second[i].number;
      }
    }
  }
  return -1;
}

void LeaderSearch::add(std::int32_t number, std::vector<float> texture)
{
  const long cell = cellOf(texture.data());
  byMean_[cell].push_back({ number, std::move(texture) });
}

long LeaderSearch::cellOf(const float* texture) const
{
  return std::lround(std::inner_product(shares_.begin(), shares_.end(), texture, 0.0) / allowed_);
}

bool LeaderSearch::isNear(const float* texture, const Leader& leader) const
{
  const double most = allowed_ * allowed_;
  return squareDifference(shares_, texture, leader.texture.data(), most) <= most;
}
}
