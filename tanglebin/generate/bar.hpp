#pragma once

#include <Eigen/Core>
#include <vector>

#include "tanglebin/generate/tube_spec.hpp"

namespace tanglebin {

/// How far the chords that stand for an arc may be from it, m.
inline constexpr double arc_tolerance = 2e-5;

/// How many chords of equal length an arc has: as few as arc_tolerance allows. A straight piece is one.
double chords_of(const Piece& piece);

/// Length of a piece along its centre line, m.
double length_of(const Piece& piece);

/// The centre line of a bar, m: the ends of its straight pieces and of the chords of its arcs, which are on
/// the arcs. It starts at the origin in the direction of +z, and its first arc without a twist bends towards
/// +x.
std::vector<Eigen::Vector3d> centre_line(const std::vector<Piece>& pieces);

}  // namespace tanglebin
