#pragma once

#include <string>
#include <vector>

namespace tanglebin {

/// A run of cylinders between two named nodes of a tube: the input of Algorithms 2 and 3.
struct Segment {
  int from = 1;            ///< named node it starts at; an earlier segment's end, or 1 for the first
  int to = 2;              ///< named node it ends at, new
  double length = 0.5;     ///< m, along the centre line
  int cylinders_min = 5;   ///< fewest cylinders
  int cylinders_max = 10;  ///< most cylinders
  double cylinder_length_min = 0.02;  ///< m, the shortest cylinder
  double bend_min = 0.0;              ///< rad, least angle between consecutive cylinders
  double bend_max = 0.0;              ///< rad, greatest angle between consecutive cylinders, at most π

  bool operator==(const Segment&) const = default;
};

/// What tubes are drawn from: every input of Algorithm 1 but their number. One segment makes the paper's
/// chains; several make a tree, as in the published set C. A segment's first cylinder takes any direction.
struct TubeSpec {
  double radius = 0.0125;  ///< m
  double mass = 0.5;       ///< kg
  std::vector<Segment> segments = std::vector<Segment>(1);

  bool operator==(const TubeSpec&) const = default;
};

/// Throws InputError for a spec of which no tube can be made: names the field (`where`.radius, and for the
/// second of several segments `where`.segment[1].length) and why: cylinders_max · cylinder_length_min >
/// length, min > max, an angle out of [0, π], a size or mass that is not positive, more than 1000 cylinders,
/// a segment that starts nowhere or closes a loop, named nodes that are not 1, 2, …, segments + 1.
void validate(const TubeSpec& spec, const std::string& where = "tube");

}  // namespace tanglebin
