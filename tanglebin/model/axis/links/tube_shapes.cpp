#include "tanglebin/model/axis/links/tube_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tanglebin {
namespace {

using Eigen::Vector3d;

/// How far each node is from the first one along a path, m.
std::vector<double> ways_along(const CentrePath& path) {
  std::vector<double> ways{0};
  for (std::size_t i = 1; i < path.size(); ++i) ways.push_back(ways.back() + (path[i] - path[i - 1]).norm());
  return ways;
}

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

}  // namespace

double path_length(const CentrePath& path) {
  return ways_along(path).back();
}

struct TubeShapes::Sample {
  double length;                // m, of the part
  std::vector<double> ways;     // m
  std::vector<float> distance;  // m, of each pair, in the order of its loops

  // Nodes that are seen, since what a link bridges may be bent.
  explicit Sample(const CentrePath& part) {
    constexpr std::size_t wanted = 9;
    const std::vector<double> along = ways_along(part);
    length = along.back();
    CentrePath places;
    std::size_t node = 0;
    for (std::size_t i = 0; i < wanted; ++i) {
      const double way = length * static_cast<double>(i) / (wanted - 1);
      while (node + 1 < part.size() && std::abs(along[node + 1] - way) <= std::abs(along[node] - way)) ++node;
      if (!ways.empty() && along[node] <= ways.back()) continue;
      ways.push_back(along[node]);
      places.push_back(part[node]);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j)
        distance.push_back(static_cast<float>((places[i] - places[j]).norm()));
    }
  }
};

TubeShapes::TubeShapes(const std::vector<CentrePath>& tubes, double radius) : step_(radius / 2) {
  constexpr double alike = 1;    // radii of misfit
  constexpr double exact = 0.2;  // radii; no two tubes are known to be more alike
  constexpr std::size_t enough = 3;
  std::vector<Distances> all;
  all.reserve(tubes.size());
  for (const CentrePath& tube : tubes) all.push_back(distances_along(tube));
  std::vector<double> misfits;
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    const Sample tube(tubes[i]);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < tubes.size(); ++j) {
      if (j != i) least = std::min(least, misfit(tube, all[j]));
    }
    if (least >= alike * radius) continue;
    misfits.push_back(least);
    tubes_.push_back(all[i]);
  }
  if (tubes_.size() < enough || 2 * tubes_.size() < tubes.size()) {
    tubes_.clear();
    return;
  }
  std::ranges::sort(misfits);
  spread_ = std::max(misfits[misfits.size() / 2], exact * radius);
}

double TubeShapes::strangeness(const CentrePath& part) const {
  if (tubes_.empty() || part.size() < 3) return 0;
  const Sample sample(part);
  double least = std::numeric_limits<double>::infinity();
  for (const Distances& tube : tubes_) least = std::min(least, misfit(sample, tube));
  return least / spread_;
}

TubeShapes::Distances TubeShapes::distances_along(const CentrePath& tube) const {
  const CentrePath places = at_even_steps(tube, step_);
  Distances distances{.places = places.size()};
  for (const Vector3d& place : places) {
    for (const Vector3d& other : places)
      distances.between.push_back(static_cast<float>((place - other).norm()));
  }
  return distances;
}

// The root mean square difference, m, between the distances of the part's places and those of a tube's, where
// the part fits best: either way round, from one end of the tube to the other. A part may be a little longer
// than what it is part of.
double TubeShapes::misfit(const Sample& part, const Distances& tube) const {
  constexpr int slack = 4;   // steps, beyond the tube's ends
  constexpr int shifts = 2;  // steps
  const int last = static_cast<int>(tube.places) - 1;
  const int room = std::max(last - static_cast<int>(part.length / step_), -2 * slack);
  std::vector<std::size_t> at(part.ways.size());
  float least = std::numeric_limits<float>::infinity();
  for (const bool is_reversed : {false, true}) {
    for (int first = -slack; first <= room + slack; first += shifts) {
      for (std::size_t i = 0; i < at.size(); ++i) {
        const int place = first + static_cast<int>(std::lround(part.ways[i] / step_));
        at[i] = static_cast<std::size_t>(std::clamp(is_reversed ? last - place : place, 0, last));
      }
      float sum = 0;
      std::size_t pair = 0;
      for (std::size_t i = 0; i < at.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j, ++pair) {
          const float difference = part.distance[pair] - tube.between[at[i] * tube.places + at[j]];
          sum += difference * difference;
        }
      }
      least = std::min(least, sum);
    }
  }
  return std::sqrt(static_cast<double>(least) /
                   static_cast<double>(std::max<std::size_t>(part.distance.size(), 1)));
}

}  // namespace tanglebin
