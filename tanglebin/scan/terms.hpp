#pragma once

#include <cstdint>

#include "tanglebin/base/counter_random.hpp"

namespace tanglebin {

// Internal to the room.

/// Separate streams of random numbers (CounterRandom), so that no term's numbers depend on another's. A
/// seed's scan depends on these values: give new terms new numbers.
enum class Term : std::uint64_t {
  range_noise = 1,
  dropout = 2,
  disparity = 3,
  trueness = 4,
  albedo = 5,
  gloss = 6,
  kinect_axial = 7,
  kinect_lateral = 8,
};

inline CounterRandom random_of(std::uint64_t seed, Term term) {
  return {seed, static_cast<std::uint64_t>(term)};
}

}  // namespace tanglebin
