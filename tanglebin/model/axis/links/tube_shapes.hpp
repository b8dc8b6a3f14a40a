#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
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
  static constexpr double step = 0.5;  ///< radii, between places along a tube

  /// Nothing is known: no part is strange.
  TubeShapes() = default;

  /// The shapes of whole tubes of this radius (m) that have another one like them. They count if they are at
  /// least three, and at least half of all. If not, bent tubes that are very much alike count, which they are
  /// not by chance: two are enough. Otherwise the tubes have no shape in common, and nothing is known.
  TubeShapes(const std::vector<CentrePath>& tubes, double radius);

  bool are_known() const { return !tubes_.empty(); }

  /// Whether a straight tube would be much unlike them. Then their shape tells where on a tube a part is.
  bool are_bent() const { return are_bent_; }

  /// How unlike a part is to the most similar part of all known tubes, as a multiple of the median of how
  /// unlike each known tube is to the most similar other one. 0 if nothing is known. Where a known tube is
  /// found that leaves no more than `ordinary`, it does not look for a more similar one.
  double strangeness(const CentrePath& part, double ordinary = 0) const;

  /// A known tube, laid on a part.
  struct Laid {
    double strangeness;      ///< how unlike the part is to what it lies on
    std::size_t tube;        ///< index of the known tube
    std::size_t first;       ///< places on it, at even steps, that the part covers
    std::size_t last;        ///< the same; included
    Eigen::Isometry3d pose;  ///< of the known tube, in the part's frame
  };

  /// Lays known tubes on a part in the ways that fit best, and visits each way, until the visit returns
  /// false. What a link bridges may be longer than straight ahead. On a straight part, a tube can be turned
  /// about it: these are ways of their own.
  void lay_on(const CentrePath& part, const std::function<bool(const Laid&)>& visit) const;

  /// The places of a laid tube, m, that are farther than this (m, along it) from what the part covers.
  CentrePath rest_of(const Laid& laid, double farther_than) const;

private:
  /// Places at even steps along a tube, m, and the distances between them.
  struct Distances {
    CentrePath places{};
    std::vector<float> between{};  // places x places

    float operator()(int place, int other) const {
      return between[static_cast<std::size_t>(place) * places.size() + static_cast<std::size_t>(other)];
    }
    int last() const { return static_cast<int>(places.size()) - 1; }
  };

  /// For each place of a sample, the place on a tube where it is.
  using Matches = std::vector<int>;

  struct Match;

  /// Places on a part: how far each is from the first one along the part, and from all others through space,
  /// m.
  struct Sample;

  double step_length() const { return step * radius_; }  // m
  Distances distances_along(const CentrePath& tube) const;
  std::vector<double> misfits_with_others(const std::vector<CentrePath>& tubes,
                                          const std::vector<Distances>& all) const;
  void know(const std::vector<Distances>& all, const std::vector<double>& misfits, double misfit_max);
  float least_squares(const Sample& part, const Distances& tube, float least, float enough) const;
  double misfit_with_straight(const Distances& tube) const;
  template <typename Visit>
  void for_each_match(const Sample& part, const Distances& tube, const Visit& visit) const;
  std::vector<Match> best_matches(const Sample& part) const;
  void slide(const Sample& part, Match& match) const;

  double radius_ = 0;  // m
  double spread_ = 0;  // m, median misfit of the known tubes with each other
  std::vector<Distances> tubes_;
  bool are_bent_ = false;
};

}  // namespace tanglebin
