#pragma once

#include <algorithm>
#include <cstdint>

namespace tanglebin {

/// SplitMix64's finalizer (Steele, Lea, Flood 2014): spreads every input bit over the whole word.
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

/// The p-quantile of the standard normal distribution, 0 < p < 1. Wichura's AS 241 (1988); relative error
/// about 1e-16.
double normal_quantile(double p);

/// Spreads all 64-bit numbers evenly over (0, 1), both ends excluded.
constexpr double between_0_and_1(std::uint64_t bits) {
  constexpr double largest_below_1 = 1 - 0x1p-53;
  return std::min((static_cast<double>(bits >> 11) + 0.5) * 0x1p-53, largest_below_1);
}

/// Random numbers looked up by a counter. Number i of a stream is SplitMix64's i-th output, so it does not
/// depend on which other numbers are requested, or in which order. Streams with different seeds or terms are
/// unrelated.
class CounterRandom {
public:
  CounterRandom(std::uint64_t seed, std::uint64_t term)
      : key_(mix_bits(mix_bits(seed) + golden * (term + 1))) {}

  std::uint64_t bits(std::uint64_t counter) const { return mix_bits(key_ + golden * (counter + 1)); }

  /// Uniform in (0, 1), both ends excluded.
  double uniform(std::uint64_t counter) const { return between_0_and_1(bits(counter)); }

  /// Standard normal.
  double normal(std::uint64_t counter) const { return normal_quantile(uniform(counter)); }

private:
  static constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U;
  std::uint64_t key_;
};

}  // namespace tanglebin
