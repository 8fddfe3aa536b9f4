// SPDX-License-Identifier: BSD-3-Clause
#ifndef po_Random_h
#define po_Random_h

#include <cstdint>

namespace po
{
/// Scrambles 64 bits: the finalizer of SplitMix64 (Steele, Lea and Flood 2014).
[[nodiscard]] constexpr std::uint64_t mixBits(std::uint64_t v)
{
  v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9ull;
  v = (v ^ (v >> 27)) * 0x94D049BB133111EBull;
  return v ^ (v >> 31);
}

/// A small random number generator: PCG-XSH-RR 64/32 (O'Neill 2014).
///
/// Every texel of every particle has a generator of its own, seeded by what it is and not by when
/// it is visited, so that results do not depend on the number of threads.
class Random
{
public:
  Random(std::uint64_t seed, std::uint64_t particle, std::uint64_t texel)
    : increment_((mixBits(texel + 0x9E3779B97F4A7C15ull * (particle + 1)) << 1) | 1)
  {
    next();
    state_ += mixBits(seed ^ mixBits(particle));
    next();
  }

  /// 32 random bits.
  std::uint32_t next()
  {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ull + increment_;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    const auto rotation = static_cast<std::uint32_t>(old >> 59);
    return (shifted >> rotation) | (shifted << ((32 - rotation) & 31));
  }

  /// Uniform in [0, 1): a multiple of 2^-32, so that 1 is never reached.
  double uniform() { return next() * 0x1p-32; }

  /// Uniform in 0 ... bound - 1 (Lemire's multiplication; its bias is below bound / 2^32).
  std::uint32_t below(std::uint32_t bound)
  {
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(next()) * bound) >> 32);
  }

private:
  std::uint64_t state_ = 0;
  std::uint64_t increment_;
};
}

#endif
