#include "tanglebin/model/axis/links/tube_shapes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/median.hpp"
#include "tanglebin/model/axis/fragments/fragments.hpp"

namespace tanglebin {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::SelfAdjointEigenSolver;
using Eigen::Translation3d;
using Eigen::Vector3d;

// The places on a path at even steps from its first node to at most its last.
CentrePath at_even_steps(const CentrePath& path, double step) {
  const std::vector<double> ways = ways_along(path);
  CentrePath places;
  std::size_t next = 1;
  for (double way = 0; next < path.size(); way += step) {
    while (next < path.size() && ways[next] < way) ++next;
    if (next == path.size()) break;
    const double edge = ways[next] - ways[next - 1];
    const double share = edge > 0 ? (way - ways[next - 1]) / edge : 0;
    places.push_back(path[next - 1] + share * (path[next] - path[next - 1]));
  }
  return places;
}

// The pose in which the matched places of a tube are nearest to those of a part.
Isometry3d pose_of(const CentrePath& tube, const std::vector<int>& matches, const CentrePath& part) {
  const auto size = static_cast<Eigen::Index>(part.size());
  Matrix3Xd from(3, size);
  Matrix3Xd to(3, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto place = static_cast<std::size_t>(i);
    from.col(i) = tube[static_cast<std::size_t>(matches[place])];
    to.col(i) = part[place];
  }
  constexpr bool with_scaling = false;
  return Isometry3d(Eigen::umeyama(from, to, with_scaling));
}

}  // namespace

double path_length(const CentrePath& path) {
  return ways_along(path).back();
}

struct TubeShapes::Sample {
  double length;                // m, of the part
  CentrePath places;            // m
  std::vector<int> steps;       // along the part to each place
  std::vector<float> distance;  // m, of each pair, in the order of its loops

  // Nodes that are seen, since what a link bridges may be bent.
  Sample(const CentrePath& part, double step_length) {
    constexpr std::size_t wanted = 9;
    const std::vector<double> along = ways_along(part);
    length = along.back();
    std::size_t node = 0;
    double last = -1;
    for (std::size_t i = 0; i < wanted; ++i) {
      const double way = length * static_cast<double>(i) / (wanted - 1);
      while (node + 1 < part.size() && std::abs(along[node + 1] - way) <= std::abs(along[node] - way)) ++node;
      if (along[node] <= last) continue;
      last = along[node];
      steps.push_back(static_cast<int>(std::lround(last / step_length)));
      places.push_back(part[node]);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j)
        distance.push_back(static_cast<float>((places[i] - places[j]).norm()));
    }
  }

  // The sum of the squared differences, m², between its distances and those of a tube's places. Ends early
  // where it reaches `enough`.
  float squares(const Distances& tube, const Matches& matches,
                float enough = std::numeric_limits<float>::infinity()) const {
    float sum = 0;
    std::size_t pair = 0;
    for (std::size_t i = 0; i < matches.size() && sum < enough; ++i) {
      for (std::size_t j = 0; j < i; ++j, ++pair) {
        const float difference = distance[pair] - tube(matches[i], matches[j]);
        sum += difference * difference;
      }
    }
    return sum;
  }

  // Whether nothing shows how it is turned about its axis.
  bool is_straight(double radius) const {
    constexpr double spread_max = 0.35;  // radii, square to its axis
    Matrix3Xd columns(3, static_cast<Eigen::Index>(places.size()));
    for (std::size_t i = 0; i < places.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = places[i];
    const Matrix3Xd centred = columns.colwise() - columns.rowwise().mean().eval();
    const Matrix3d covariance = centred * centred.transpose() / static_cast<double>(places.size());
    const Vector3d variances =
        SelfAdjointEigenSolver<Matrix3d>(covariance, Eigen::EigenvaluesOnly).eigenvalues();
    return variances[1] < std::pow(spread_max * radius, 2);
  }

  // The turns that a tube laid on it may have: about a straight part, by any angle.
  std::vector<Isometry3d> turns(double radius) const {
    constexpr int angles = 16;
    if (!is_straight(radius)) return {Isometry3d::Identity()};
    const Vector3d middle = places[places.size() / 2];
    const Vector3d axis = (places.back() - places.front()).normalized();
    std::vector<Isometry3d> turns;
    for (int i = 0; i < angles; ++i) {
      const AngleAxisd turn(i * 360 * degree / angles, axis);
      turns.emplace_back(Translation3d(middle) * turn * Translation3d(-middle));
    }
    return turns;
  }

  // Of a sum of squares, m.
  double root_mean(float sum) const { return std::sqrt(static_cast<double>(sum) / pairs()); }

  // The sum of squares with this root mean, m.
  float sum_with(double root_mean) const { return static_cast<float>(root_mean * root_mean * pairs()); }

  double pairs() const { return static_cast<double>(std::max<std::size_t>(distance.size(), 1)); }
};

TubeShapes::TubeShapes(const std::vector<CentrePath>& tubes, double radius) : radius_(radius) {
  constexpr double alike = 1;  // radii of misfit
  constexpr double very_much_alike = 0.5;
  constexpr std::size_t enough = 3;
  constexpr std::size_t enough_bent_ones = 2;
  std::vector<Distances> all;
  all.reserve(tubes.size());
  for (const CentrePath& tube : tubes) all.push_back(distances_along(tube));
  const std::vector<double> misfits = misfits_with_others(tubes, all);
  know(all, misfits, alike * radius);
  if (tubes_.size() >= enough && 2 * tubes_.size() >= tubes.size()) return;
  know(all, misfits, very_much_alike * radius);
  if (tubes_.size() < enough_bent_ones || !are_bent_) *this = TubeShapes();
}

double TubeShapes::strangeness(const CentrePath& part, double ordinary) const {
  if (tubes_.empty() || part.size() < 3) return 0;
  const Sample sample(part, step_length());
  const float enough = sample.sum_with(ordinary * spread_);
  float least = std::numeric_limits<float>::infinity();
  for (auto tube = tubes_.begin(); tube != tubes_.end() && least > enough; ++tube)
    least = least_squares(sample, *tube, least, enough);
  return sample.root_mean(least) / spread_;
}

TubeShapes::Distances TubeShapes::distances_along(const CentrePath& tube) const {
  Distances distances{.places = at_even_steps(tube, step_length())};
  for (const Vector3d& place : distances.places) {
    for (const Vector3d& other : distances.places)
      distances.between.push_back(static_cast<float>((place - other).norm()));
  }
  return distances;
}

// Of each tube, with the most similar other one, m.
std::vector<double> TubeShapes::misfits_with_others(const std::vector<CentrePath>& tubes,
                                                    const std::vector<Distances>& all) const {
  std::vector<double> misfits;
  misfits.reserve(tubes.size());
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    const Sample tube(tubes[i], step_length());
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t j = 0; j < tubes.size(); ++j) {
      if (j != i) least = least_squares(tube, all[j], least, 0);
    }
    misfits.push_back(tube.root_mean(least));
  }
  return misfits;
}

// Knows the tubes whose misfit, m, is less than this, and no others.
void TubeShapes::know(const std::vector<Distances>& all, const std::vector<double>& misfits,
                      double misfit_max) {
  constexpr double exact = 0.2;  // radii; no two tubes are known to be more alike
  constexpr double bent = 6;     // spreads, from a straight tube
  tubes_.clear();
  std::vector<double> misfits_of_known;
  std::vector<double> bends;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (misfits[i] >= misfit_max) continue;
    tubes_.push_back(all[i]);
    misfits_of_known.push_back(misfits[i]);
    bends.push_back(misfit_with_straight(all[i]));
  }
  if (tubes_.empty()) return;
  spread_ = std::max(median(std::move(misfits_of_known)), exact * radius_);
  are_bent_ = median(std::move(bends)) > bent * spread_;
}

// Visits the matches of a part and a tube: either way round, from one end of the tube to the other, until the
// visit returns false. A part may be a little longer than what it is part of.
template <typename Visit>
void TubeShapes::for_each_match(const Sample& part, const Distances& tube, const Visit& visit) const {
  constexpr int slack = 4;   // steps, beyond the tube's ends
  constexpr int shifts = 2;  // steps
  const int last = tube.last();
  const int room = std::max(last - static_cast<int>(part.length / step_length()), -2 * slack);
  Matches matches(part.steps.size());
  for (const bool is_reversed : {false, true}) {
    for (int first = -slack; first <= room + slack; first += shifts) {
      for (std::size_t i = 0; i < matches.size(); ++i) {
        const int place = first + part.steps[i];
        matches[i] = std::clamp(is_reversed ? last - place : place, 0, last);
      }
      if (!visit(matches)) return;
    }
  }
}

// Sample::squares() where the part fits best; `least` if it fits no better than that. Any place will do where
// it fits as well as `enough`.
float TubeShapes::least_squares(const Sample& part, const Distances& tube, float least, float enough) const {
  for_each_match(part, tube, [&](const Matches& matches) {
    least = std::min(least, part.squares(tube, matches, least));
    return least > enough;
  });
  return least;
}

// The same for a straight part as long as the tube.
double TubeShapes::misfit_with_straight(const Distances& tube) const {
  double sum = 0;
  for (int i = 0; i <= tube.last(); ++i) {
    for (int j = 0; j < i; ++j) {
      const double difference = (i - j) * step_length() - static_cast<double>(tube(i, j));
      sum += difference * difference;
    }
  }
  const double pairs = tube.last() * (tube.last() + 1) / 2.0;
  return std::sqrt(sum / std::max(pairs, 1.0));
}

/// Where a part is on a known tube.
struct TubeShapes::Match {
  float squares = std::numeric_limits<float>::infinity();  // m², Sample::squares()
  std::size_t tube = 0;
  Matches places{};
};

// For each place along a tube and either way round, the known tube that fits best there; the best of these
// places. A straight part fits at many, but the rest of the tube is elsewhere each time.
std::vector<TubeShapes::Match> TubeShapes::best_matches(const Sample& part) const {
  constexpr std::size_t best = 16;
  std::vector<Match> matches;
  for (std::size_t tube = 0; tube < tubes_.size(); ++tube) {
    std::size_t place = 0;
    for_each_match(part, tubes_[tube], [&](const Matches& places) {
      if (place == matches.size()) matches.emplace_back();
      Match& match = matches[place++];
      const float squares = part.squares(tubes_[tube], places, match.squares);
      if (squares < match.squares) match = {squares, tube, places};
      return true;
    });
  }
  const auto end = matches.begin() + static_cast<std::ptrdiff_t>(std::min(best, matches.size()));
  std::ranges::partial_sort(matches, end, {}, &Match::squares);
  matches.erase(end, matches.end());
  return matches;
}

// Moves the places of a part along the tube to where they are nearest to it, since what a link bridges may be
// longer than straight ahead. A few rounds of iterative closest points.
void TubeShapes::slide(const Sample& part, Match& match) const {
  constexpr int rounds = 3;
  constexpr int reach = 8;  // steps
  const Distances& tube = tubes_[match.tube];
  Match slid = match;
  for (int round = 0; round < rounds; ++round) {
    const Matches before = slid.places;
    const Isometry3d to_tube = pose_of(tube.places, slid.places, part.places).inverse(Eigen::Isometry);
    for (std::size_t i = 0; i < slid.places.size(); ++i) {
      const Vector3d place = to_tube * part.places[i];
      const auto first = tube.places.begin() + std::max(slid.places[i] - reach, 0);
      const auto last = tube.places.begin() + std::min(slid.places[i] + reach, tube.last());
      const auto nearest = std::ranges::min_element(
          first, last + 1, {}, [&](const Vector3d& other) { return (other - place).squaredNorm(); });
      slid.places[i] = static_cast<int>(nearest - tube.places.begin());
    }
    if (slid.places == before) break;
  }
  slid.squares = part.squares(tube, slid.places);
  if (slid.squares < match.squares) match = std::move(slid);
}

void TubeShapes::lay_on(const CentrePath& part, const std::function<bool(const Laid&)>& visit) const {
  const Sample sample(part, step_length());
  const std::vector<Isometry3d> turns = sample.turns(radius_);
  for (Match& match : best_matches(sample)) {
    slide(sample, match);
    const auto [first, last] = std::ranges::minmax(match.places);
    const Isometry3d pose = pose_of(tubes_[match.tube].places, match.places, sample.places);
    Laid laid{.strangeness = sample.root_mean(match.squares) / spread_,
              .tube = match.tube,
              .first = static_cast<std::size_t>(first),
              .last = static_cast<std::size_t>(last),
              .pose = {}};
    for (const Isometry3d& turn : turns) {
      laid.pose = turn * pose;
      if (!visit(laid)) return;
    }
  }
}

CentrePath TubeShapes::rest_of(const Laid& laid, double farther_than) const {
  constexpr std::size_t end = 2;  // places; beside a tube's end, what is behind it is seen
  const CentrePath& places = tubes_[laid.tube].places;
  CentrePath rest;
  for (std::size_t i = end; i + end < places.size(); ++i) {
    const std::size_t before = i < laid.first ? laid.first - i : 0;
    const std::size_t after = i > laid.last ? i - laid.last : 0;
    if (static_cast<double>(before + after) * step_length() > farther_than)
      rest.push_back(laid.pose * places[i]);
  }
  return rest;
}

}  // namespace tanglebin
