#pragma once

#include <limits>

// Internal to the room.
namespace tanglebin {

/// The part of a line from low to high; empty if high < low.
struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

}  // namespace tanglebin
