#include "tanglebin/score/score_tubes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "tanglebin/base/median.hpp"
#include "tanglebin/geometry/axis_parts.hpp"
#include "tanglebin/score/centre_line.hpp"
#include "tanglebin/score/joins.hpp"

namespace tanglebin {
namespace {

constexpr double part_max = 0.001;  // m, of a centre line, treated as a point

// The centre lines of the tubes that have edges.
std::vector<CentreLine> centre_lines(const std::vector<Tube>& tubes) {
  std::vector<CentreLine> lines;
  for (const Tube& tube : tubes) {
    if (!tube.edges.empty()) lines.emplace_back(tube);
  }
  return lines;
}

double distance_to_nearest(const std::vector<CentreLine>& lines, const Eigen::Vector3d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const CentreLine& line : lines) {
    if (!line.is_surely_beyond(least, point)) least = std::min(least, line.nearest(point).distance);
  }
  return least;
}

struct Error {
  double distance;  // m
  double length;    // m, of the part with this distance
};

// For all modelled tubes, ascending.
std::vector<Error> errors(const std::vector<CentreLine>& truth, const std::vector<Tube>& modelled) {
  std::vector<Error> errors;
  for (const Tube& tube : modelled) {
    for (const Capsule& axis : capsules(tube)) {
      for (const auto& [point, length] : axis_parts(axis, part_max)) {
        errors.push_back({distance_to_nearest(truth, point), length});
      }
    }
  }
  std::ranges::sort(errors, {}, &Error::distance);
  return errors;
}

// The smallest distance that this fraction of the length does not exceed; `errors` is sorted.
std::optional<double> quantile(const std::vector<Error>& errors, double share) {
  double total = 0;
  for (const Error& error : errors) total += error.length;
  double length = 0;
  for (const Error& error : errors) {
    length += error.length;
    if (length >= share * total) return error.distance;
  }
  return {};
}

std::vector<Capsule> all_capsules(const std::vector<Tube>& tubes) {
  std::vector<Capsule> all;
  for (const Tube& tube : tubes) std::ranges::copy(capsules(tube), std::back_inserter(all));
  return all;
}

// The capsules whose axes may be within this distance of an axis.
std::vector<Capsule> near(const std::vector<Capsule>& capsules, const Capsule& axis, double distance) {
  const auto box = [](const Capsule& capsule) {
    return Eigen::AlignedBox3d(capsule.a.cwiseMin(capsule.b), capsule.a.cwiseMax(capsule.b));
  };
  Eigen::AlignedBox3d around = box(axis);
  around.min().array() -= distance;
  around.max().array() += distance;
  std::vector<Capsule> near;
  std::ranges::copy_if(capsules, std::back_inserter(near),
                       [&](const Capsule& other) { return around.intersects(box(other)); });
  return near;
}

struct Coverage {
  double covered;  // m
  double length;   // m, of all
};

// How much of a centre line is within its radius of a modelled one.
Coverage covered_part(const CentreLine& line, const std::vector<Capsule>& model) {
  Coverage part{};
  for (const Capsule& axis : line.capsules()) {
    const std::vector<Capsule> candidates = near(model, axis, line.radius());
    for (const AxisPart& sample : axis_parts(axis, part_max)) {
      const bool is_covered = std::ranges::any_of(candidates, [&](const Capsule& candidate) {
        return axis_distance(candidate, sample.middle) <= line.radius();
      });
      part.length += sample.length;
      if (is_covered) part.covered += sample.length;
    }
  }
  return part;
}

double coverage(const std::vector<CentreLine>& truth, const std::vector<Tube>& modelled) {
  const std::vector<Capsule> model = all_capsules(modelled);
  Coverage all{};
  for (const CentreLine& line : truth) {
    const auto [covered, length] = covered_part(line, model);
    all.covered += covered;
    all.length += length;
  }
  if (all.length == 0) throw std::invalid_argument("the true tubes have no centre line");
  return all.covered / all.length;
}

// The relative length error of each true tube that a modelled one covers almost from end to end. If several
// do, such as one that goes on to another tube, it is that of the nearest length.
std::vector<double> length_errors(const std::vector<CentreLine>& truth, const std::vector<Tube>& modelled) {
  constexpr double nearly = 0.95;
  std::vector<std::vector<Capsule>> of_modelled;
  of_modelled.reserve(modelled.size());
  for (const Tube& tube : modelled) of_modelled.push_back(capsules(tube));
  std::vector<double> errors;
  for (const CentreLine& line : truth) {
    std::optional<double> least;
    for (std::size_t i = 0; i < modelled.size(); ++i) {
      const auto [covered, length] = covered_part(line, of_modelled[i]);
      if (covered <= nearly * length) continue;
      const double error = std::abs(total_length(modelled[i]) / length - 1);
      least = std::min(least.value_or(error), error);
    }
    if (least) errors.push_back(*least);
  }
  return errors;
}

struct Junction {
  Eigen::Vector3d position;  // m
  double radius;             // m, of its tube
};

std::vector<Junction> junctions(const std::vector<Tube>& tubes) {
  std::vector<Junction> found;
  for (const Tube& tube : tubes) {
    std::vector<int> edges_at(tube.nodes.size());
    for (const Edge& edge : tube.edges) {
      ++edges_at[edge.from];
      ++edges_at[edge.to];
    }
    for (std::size_t node = 0; node < tube.nodes.size(); ++node) {
      if (edges_at[node] > 2) found.push_back({tube.nodes[node].position, tube.radius});
    }
  }
  return found;
}

std::int64_t count_found(const std::vector<Junction>& truth, const std::vector<Junction>& modelled) {
  return std::ranges::count_if(truth, [&](const Junction& junction) {
    return std::ranges::any_of(modelled, [&](const Junction& other) {
      return (junction.position - other.position).norm() <= 2 * junction.radius;
    });
  });
}

}  // namespace

TubesScore score_tubes(const std::vector<Tube>& truth, const std::vector<Tube>& modelled) {
  validate(truth);
  for (const Tube& tube : modelled) validate_lines(tube);
  const std::vector<CentreLine> lines = centre_lines(truth);
  const double covered = coverage(lines, modelled);
  const std::vector<Error> modelled_errors = errors(lines, modelled);
  const Joins joins = count_joins(lines, modelled);
  std::vector<double> lengths = length_errors(lines, modelled);
  const std::vector<Junction> true_junctions = junctions(truth);
  const std::vector<Junction> modelled_junctions = junctions(modelled);
  return {.centre_line_error = quantile(modelled_errors, 0.5),
          .centre_line_error_p95 = quantile(modelled_errors, 0.95),
          .centre_line_coverage = covered,
          .complete_tubes = std::ssize(lengths),
          .length_error = lengths.empty() ? std::nullopt : std::optional(median(std::move(lengths))),
          .true_joins = joins.in_truth,
          .joins_found = joins.found,
          .joins_made = joins.made,
          .true_junctions = std::ssize(true_junctions),
          .junctions_found = count_found(true_junctions, modelled_junctions),
          .junctions_made = std::ssize(modelled_junctions)};
}

}  // namespace tanglebin
