#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace tanglebin {

/// A centre line without branches: its nodes, m.
using CentrePath = std::vector<Eigen::Vector3d>;

/// m
double path_length(const CentrePath& path);

/// What the tubes of a class look like, as far as whole ones are seen: bars are bent alike, and of a hose no
/// place turns more sharply than those that are seen. The shape of a centre line is the distances between
/// places along it; it does not change if the tube is moved, turned or mirrored.
class TubeShapes {
public:
  /// Nothing is known: no part is strange.
  TubeShapes() = default;

  /// The shapes of whole tubes of this radius (m) that have another one like them. If these are fewer than
  /// three, or fewer than half of them, the tubes have no shape in common, and nothing is known.
  TubeShapes(const std::vector<CentrePath>& tubes, double radius);

  bool are_known() const { return !tubes_.empty(); }

  /// How unlike a part is to the most similar part of all known tubes, as a multiple of the median of how
  /// unlike each known tube is to the most similar other one. 0 if nothing is known.
  double strangeness(const CentrePath& part) const;

private:
  /// The distances, m, between places at even steps along a tube.
  struct Distances {
    std::size_t places = 0;
    std::vector<float> between{};  // places x places
  };

  /// Places on a part: how far each is from the first one along the part, and from all others through space,
  /// m.
  struct Sample;

  Distances distances_along(const CentrePath& tube) const;
  double misfit(const Sample& part, const Distances& tube) const;

  double step_ = 0;    // m, between the places along a tube
  double spread_ = 0;  // m, median misfit of the known tubes with each other
  std::vector<Distances> tubes_;
};

}  // namespace tanglebin
