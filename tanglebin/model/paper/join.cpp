#include "tanglebin/model/paper/join.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <optional>
#include <tuple>

#include "tanglebin/model/scene/angle.hpp"

namespace tanglebin {
namespace {

double length_of(const Cylinder& cylinder) {
  return (cylinder.ends[1] - cylinder.ends[0]).norm();
}

Eigen::Vector3d outward(const Cylinder& cylinder, std::size_t end) {
  return (cylinder.ends[end] - cylinder.ends[1 - end]).normalized();
}

// All pairs of ends of distinct cylinders below both thresholds, cheapest first.
std::vector<Join> candidates(const std::vector<Cylinder>& cylinders, const JoinSettings& settings) {
  const double metres_for_a_radian = settings.distance_max / settings.angle_max;
  std::vector<Join> joins;
  const auto consider = [&](const CylinderEnd& first, const CylinderEnd& second) {
    const JoinMeasures measures =
        measure_join(cylinders[first.cylinder], first.end, cylinders[second.cylinder], second.end);
    if (measures.distance > settings.distance_max || measures.angle > settings.angle_max) return;
    joins.push_back({{first, second}, measures.distance + metres_for_a_radian * measures.angle});
  };
  for (std::size_t i = 0; i < cylinders.size(); ++i) {
    for (std::size_t j = i + 1; j < cylinders.size(); ++j) {
      for (const std::size_t end : {0U, 1U}) {
        for (const std::size_t other_end : {0U, 1U}) consider({i, end}, {j, other_end});
      }
    }
  }
  std::ranges::stable_sort(joins, {}, &Join::cost);
  return joins;
}

/// Tracks which cylinders are in one tube, and the tube's length.
class TubesInTheMaking {
public:
  explicit TubesInTheMaking(const std::vector<Cylinder>& cylinders) : sets_(cylinders.size()) {
    for (const Cylinder& cylinder : cylinders) lengths_.push_back(length_of(cylinder));
  }

  bool are_one(std::size_t first, std::size_t second) {
    return sets_.find_set(first) == sets_.find_set(second);
  }

  double length_if_joined(std::size_t first, std::size_t second, double gap) {
    return lengths_[sets_.find_set(first)] + gap + lengths_[sets_.find_set(second)];
  }

  void join(std::size_t first, std::size_t second, double gap) {
    const double length = length_if_joined(first, second, gap);
    sets_.union_set(first, second);
    lengths_[sets_.find_set(first)] = length;
  }

private:
  boost::disjoint_sets_with_storage<> sets_;
  std::vector<double> lengths_;  // m, of the tube that each set represents
};

/// For each end of each cylinder, the end that it is joined to.
using Neighbours = std::vector<std::array<std::optional<CylinderEnd>, 2>>;

Neighbours neighbours_of(std::size_t cylinders, const std::vector<Join>& joins) {
  Neighbours neighbours(cylinders);
  for (const auto& [ends, cost] : joins) {
    neighbours[ends[0].cylinder][ends[0].end] = ends[1];
    neighbours[ends[1].cylinder][ends[1].end] = ends[0];
  }
  return neighbours;
}

// The free end at which the chain of this cylinder begins, reached by walking from its end 1.
CylinderEnd start_of_chain(const Neighbours& neighbours, std::size_t cylinder) {
  CylinderEnd end{cylinder, 0};
  while (const auto& next = neighbours[end.cylinder][end.end]) end = {next->cylinder, 1 - next->end};
  return end;
}

// m; closer ends are one node
constexpr double same_place = 1e-6;

void extend(Tube& tube, const Eigen::Vector3d& to) {
  if (!tube.nodes.empty() && (to - tube.nodes.back().position).norm() < same_place) return;
  // Ends are nodes 1 and 2, inner nodes count from 4, as in the published data.
  constexpr int inner_offset = 3;
  const std::size_t added = tube.nodes.size();
  tube.nodes.push_back({static_cast<int>(added) + inner_offset, to});
  if (added > 0) tube.edges.push_back({added - 1, added, static_cast<int>(added)});
}

}  // namespace

JoinMeasures measure_join(const Cylinder& first, std::size_t first_end, const Cylinder& second,
                          std::size_t second_end) {
  const Eigen::Vector3d way = second.ends[second_end] - first.ends[first_end];
  const double distance = way.norm();
  return {distance,
          angle_between(outward(first, first_end), way) + angle_between(-outward(second, second_end), way)};
}

std::vector<Join> join_cylinders(const std::vector<Cylinder>& cylinders, const RangeImage& seen,
                                 double length, const JoinSettings& settings) {
  std::vector<std::array<bool, 2>> taken(cylinders.size());
  const auto is_taken = [&](const CylinderEnd& end) -> bool& { return taken[end.cylinder][end.end]; };
  TubesInTheMaking tubes(cylinders);
  std::vector<Join> joins;
  for (const Join& join : candidates(cylinders, settings)) {
    const auto& [first, second] = join.ends;
    if (is_taken(first) || is_taken(second) || tubes.are_one(first.cylinder, second.cylinder)) continue;
    const Eigen::Vector3d& from = cylinders[first.cylinder].ends[first.end];
    const Eigen::Vector3d& to = cylinders[second.cylinder].ends[second.end];
    const double gap = (to - from).norm();
    const double joined = tubes.length_if_joined(first.cylinder, second.cylinder, gap);
    if (joined > length * (1 + settings.length_tolerance)) continue;
    if (!seen.hides(from, to, settings.hidden_radius)) continue;
    tubes.join(first.cylinder, second.cylinder, gap);
    is_taken(first) = is_taken(second) = true;
    joins.push_back(join);
  }
  return joins;
}

std::vector<JoinedTube> joined_tubes(const std::vector<Cylinder>& cylinders, const std::vector<Join>& joins,
                                     const TubeKind& kind) {
  const Neighbours neighbours = neighbours_of(cylinders.size(), joins);
  std::vector<bool> done(cylinders.size());
  std::vector<JoinedTube> tubes;
  const auto place_of = [&](const CylinderEnd& at) {
    const Cylinder& its = cylinders[at.cylinder];
    const bool is_cut = kind.flat_ends && !neighbours[at.cylinder][at.end];
    return is_cut ? Eigen::Vector3d(its.ends[at.end] + its.trimmed * outward(its, at.end)) : its.ends[at.end];
  };
  for (std::size_t i = 0; i < cylinders.size(); ++i) {
    if (done[i]) continue;
    JoinedTube joined;
    joined.tube.id = static_cast<int>(tubes.size()) + 1;
    joined.tube.radius = kind.radius;
    joined.tube.flat_ends = kind.flat_ends;
    for (std::optional<CylinderEnd> near = start_of_chain(neighbours, i); near;) {
      const auto [cylinder, end] = *near;
      extend(joined.tube, place_of(*near));
      extend(joined.tube, place_of({cylinder, 1 - end}));
      joined.cylinders.push_back(cylinder);
      done[cylinder] = true;
      near = neighbours[cylinder][1 - end];
    }
    joined.tube.nodes.front().id = 1;
    joined.tube.nodes.back().id = 2;
    tubes.push_back(std::move(joined));
  }
  return tubes;
}

}  // namespace tanglebin
