#pragma once

#include <cstdint>

#include "tanglebin/base/counter_random.hpp"

namespace tanglebin {

// Internal to the room.

/// What random numbers are drawn for, so that no term's draws depend on another's (CounterRandom). The
/// numbers are part of what makes a seed's scan: new terms get new ones.
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
