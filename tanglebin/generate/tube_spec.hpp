#pragma once

#include <string>
#include <vector>

#include "tanglebin/geometry/segment.hpp"
#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// A segment and the run of cylinders that it is drawn as: the input of Algorithms 2 and 3. It starts at an
/// earlier segment's end, or at node 1, and ends at a new node.
struct SegmentSpec : Segment {
  int cylinders_min = 5;              ///< fewest cylinders
  int cylinders_max = 10;             ///< most cylinders
  double cylinder_length_min = 0.02;  ///< m, shortest cylinder
  double bend_min = 0.0;              ///< rad, smallest angle between consecutive cylinders
  double bend_max = 0.0;              ///< rad, largest angle between consecutive cylinders, at most π

  bool operator==(const SegmentSpec&) const = default;
};

/// A piece of a bar: a straight one, or an arc of a circle. Each continues the one before without a kink.
struct Piece {
  double length = 0;       ///< m, of a straight piece; 0 for an arc
  double bend = 0;         ///< rad, by how much an arc turns, at most π; 0 for a straight piece
  double bend_radius = 0;  ///< m, of an arc's centre line, at least the bar's radius
  /// rad, by how much an arc's plane is turned from that of the arc before, about the direction in which it
  /// starts: with 0 it bends to the same side, as in a C, with π to the other, as in an S.
  double twist = 0;

  bool operator==(const Piece&) const = default;
};

/// What tubes are drawn from: every input of Algorithm 1 but their number. One segment makes the paper's
/// chains; several make a tree, as in the published set C. A segment's first cylinder takes any direction.
/// Pieces, which take the place of segments, make a bar: all of one kind have the same shape.
struct TubeSpec {
  double radius = 0.0125;  ///< m
  double mass = 0.5;       ///< kg; 0 with a density
  double density = 0;      ///< kg/m³ of the solid that fills the tube's surface; 0 with a mass
  std::vector<SegmentSpec> segments = std::vector<SegmentSpec>(1);
  std::vector<Piece> pieces{};
  bool flat_ends = false;  ///< cut flat, not round

  bool operator==(const TubeSpec&) const = default;
};

/// The segments of a tube drawn from `spec`. A bar is one, from node 1 to node 2.
std::vector<Segment> segments_of(const TubeSpec& spec);

/// The mass of a tube drawn from `spec`, kg: the spec's, or its density times the volume of the solid that
/// fills the tube's surface.
double mass_of(const Tube& tube, const TubeSpec& spec);

/// Throws InputError if no tube can be made of a spec. Names the field (`where`.radius, or
/// `where`.segment[1].length for the second of several segments) and the reason: cylinders_max ·
/// cylinder_length_min > length, min > max, an angle outside [0, π], a size or mass that is not positive,
/// a mass with which the physics engine does not work, both a mass and a density, more than 1000 cylinders, a
/// segment that starts nowhere or closes a loop, named nodes that are not 1, 2, …, segments + 1; a bar whose
/// bend is narrower than its radius, or that passes through itself; flat ends with less than a radius of
/// straight tube before them.
void validate(const TubeSpec& spec, const std::string& where = "tube");

}  // namespace tanglebin
