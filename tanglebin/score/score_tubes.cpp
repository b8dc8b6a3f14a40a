#include "tanglebin/score/score_tubes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "tanglebin/score/centre_line.hpp"
#include "tanglebin/score/joins.hpp"

namespace tanglebin {
namespace {

// A piece of a centre line, taken for a point.
struct Sample {
  Eigen::Vector3d point;
  double length;  // m
};

// Cuts an axis into parts of 1 mm at most. (A thousand at most, so that tubes whose numbers are millimetres
// take no thousand times as long to score badly.)
std::vector<Sample> samples(const Capsule& axis) {
  const double length = (axis.b - axis.a).norm();
  // A little less, so that rounding does not add a part to a length of whole millimetres.
  const double parts = std::min(std::ceil(length / 0.001 - 1e-6), 1000.0);
  std::vector<Sample> samples;
  for (int part = 0; part < static_cast<int>(parts); ++part) {
    samples.push_back({axis.a + (part + 0.5) / parts * (axis.b - axis.a), length / parts});
  }
  return samples;
}

// The centre lines of the tubes that have one.
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
  double length;    // m, of what is so far off
};

// Of all that is modelled, ascending.
std::vector<Error> errors(const std::vector<CentreLine>& truth, const std::vector<Tube>& modelled) {
  std::vector<Error> errors;
  for (const Tube& tube : modelled) {
    for (const Capsule& axis : capsules(tube)) {
      for (const auto& [point, length] : samples(axis)) {
        errors.push_back({distance_to_nearest(truth, point), length});
      }
    }
  }
  std::ranges::sort(errors, {}, &Error::distance);
  return errors;
}

// The least distance that this share of the length is not beyond; `errors` ascend.
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

// Those whose axes may be within a distance of an axis.
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

double coverage(const std::vector<CentreLine>& truth, const std::vector<Tube>& modelled) {
  const std::vector<Capsule> model = all_capsules(modelled);
  double total = 0;
  double covered = 0;
  for (const CentreLine& line : truth) {
    for (const Capsule& axis : line.capsules()) {
      const std::vector<Capsule> candidates = near(model, axis, line.radius());
      for (const Sample& sample : samples(axis)) {
        const bool is_covered = std::ranges::any_of(candidates, [&](const Capsule& candidate) {
          return axis_distance(candidate, sample.point) <= line.radius();
        });
        total += sample.length;
        if (is_covered) covered += sample.length;
      }
    }
  }
  if (total == 0) throw std::invalid_argument("the true tubes have no centre line");
  return covered / total;
}

}  // namespace

TubesScore score_tubes(const std::vector<Tube>& truth, const std::vector<Tube>& modelled) {
  const std::vector<CentreLine> lines = centre_lines(truth);
  const double covered = coverage(lines, modelled);
  const std::vector<Error> modelled_errors = errors(lines, modelled);
  const Joins joins = count_joins(lines, modelled);
  return {.centre_line_error = quantile(modelled_errors, 0.5),
          .centre_line_error_p95 = quantile(modelled_errors, 0.95),
          .centre_line_coverage = covered,
          .true_joins = joins.in_truth,
          .joins_found = joins.found,
          .joins_made = joins.made};
}

}  // namespace tanglebin
