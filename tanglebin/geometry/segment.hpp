#pragma once

namespace tanglebin {

/// The part of a tube between two of its named nodes, which are its ends and junctions.
struct Segment {
  int from = 1;         ///< named node
  int to = 2;           ///< named node
  double length = 0.5;  ///< m, along the centre line

  bool operator==(const Segment&) const = default;
};

}  // namespace tanglebin
