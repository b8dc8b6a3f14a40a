#include "tanglebin/generate/bar.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace tanglebin {
namespace {

using Eigen::Vector3d;

/// Walks along a centre line: the place reached, the direction there, and the side that arcs bend to.
class Walk {
public:
  std::vector<Vector3d> take_line() { return std::move(line_); }

  void go_straight(double length) { line_.emplace_back(line_.back() + length * direction_); }

  void go_round(const Piece& arc) {
    side_ = Eigen::AngleAxisd(arc.twist, direction_) * side_;
    const Vector3d centre = line_.back() + arc.bend_radius * side_;
    const Vector3d forward = direction_;
    const Vector3d inward = side_;
    const double chords = chords_of(arc);
    for (int i = 1; i <= static_cast<int>(chords); ++i) {
      const double angle = arc.bend * i / chords;
      direction_ = std::cos(angle) * forward + std::sin(angle) * inward;
      side_ = std::cos(angle) * inward - std::sin(angle) * forward;
      line_.emplace_back(centre - arc.bend_radius * side_);
    }
  }

private:
  std::vector<Vector3d> line_{Vector3d::Zero()};
  Vector3d direction_ = Vector3d::UnitZ();
  Vector3d side_ = Vector3d::UnitX();
};

}  // namespace

// A chord that turns by an angle is at most bend_radius (1 − cos(angle / 2)) from its arc.
double chords_of(const Piece& piece) {
  if (piece.bend == 0) return 1;
  const double cosine = 1 - arc_tolerance / piece.bend_radius;
  return std::max(1.0, std::ceil(piece.bend / (2 * std::acos(std::max(cosine, 0.0)))));
}

double length_of(const Piece& piece) {
  return piece.length + piece.bend * piece.bend_radius;
}

std::vector<Vector3d> centre_line(const std::vector<Piece>& pieces) {
  Walk walk;
  for (const Piece& piece : pieces) {
    if (piece.bend == 0) {
      walk.go_straight(piece.length);
    } else {
      walk.go_round(piece);
    }
  }
  return walk.take_line();
}

}  // namespace tanglebin
