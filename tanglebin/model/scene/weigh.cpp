#include "tanglebin/model/scene/weigh.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "tanglebin/base/median.hpp"
#include "tanglebin/geometry/nearest_axis.hpp"
#include "tanglebin/model/scene/confidence.hpp"

namespace tanglebin {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A tube's centre line, in parts about as long as its radius.
class CentreLine {
public:
  explicit CentreLine(const Tube& tube)
      : tube_(tube), nearest_(capsules(tube)), parts_(tube.edges.size()), is_end_(outermost_nodes(tube)) {
    for (std::size_t edge = 0; edge < tube.edges.size(); ++edge) {
      const double parts = std::max(1.0, std::round(length_of(edge) / tube.radius));
      parts_[edge].resize(static_cast<std::size_t>(parts));
    }
  }

  double length_of(std::size_t edge) const { return way_of(edge).norm(); }

  Foot foot_of(const Vector3d& point) { return nearest_.foot_of(point); }

  // Whether a point is on the cap of an end, or on its face, which may be a little inside of the modelled
  // one.
  bool is_on_end(const Foot& foot) const {
    constexpr double face = 0.3;  // radii
    const auto& [from, to, order] = tube_.edges[foot.capsule];
    const double margin = tube_.flat_ends ? face * tube_.radius / length_of(foot.capsule) : 0;
    return (foot.t <= margin && is_end_[from]) || (foot.t >= 1 - margin && is_end_[to]);
  }

  Vector3d direction_at(const Foot& foot) const { return way_of(foot.capsule).normalized(); }

  void see(const Foot& foot) {
    auto& parts = parts_[foot.capsule];
    const auto part = static_cast<std::size_t>(foot.t * static_cast<double>(parts.size()));
    parts[std::min(part, parts.size() - 1)] = 1;
  }

  // m, of the parts that were seen.
  double seen_length() const {
    double length = 0;
    for (std::size_t edge = 0; edge < parts_.size(); ++edge) {
      const auto seen = std::ranges::count(parts_[edge], 1);
      length += length_of(edge) * static_cast<double>(seen) / static_cast<double>(parts_[edge].size());
    }
    return length;
  }

private:
  Vector3d way_of(std::size_t edge) const {
    return tube_.nodes[tube_.edges[edge].to].position - tube_.nodes[tube_.edges[edge].from].position;
  }

  const Tube& tube_;
  NearestAxis nearest_;
  std::vector<std::vector<std::uint8_t>> parts_;  // of each edge: 1 if it was seen
  std::vector<bool> is_end_;                      // of each node
};

/// Finds the radius that fits points around a tube. Seen from one side, a tube that is too thin in the model
/// is moved by the fit until it lies right in the mean; what is left of the error then grows with the angle
/// from the line of sight. So a change of the radius and a move, towards the sensor and sideways, are fitted
/// together by least squares.
class RadiusFit {
public:
  explicit RadiusFit(double radius) : radius_(radius) {}

  void add(const Vector3d& outwards, const Vector3d& along, const Vector3d& to_sensor, double residual) {
    const Vector3d upwards = (to_sensor - to_sensor.dot(along) * along).normalized();
    points_.push_back({{1, outwards.dot(upwards), outwards.dot(along.cross(upwards))}, residual});
  }

  // m; 0 if there are too few points, or all of them on one side.
  double error_with_outliers() const {
    return least_squares(Vector3d::Zero(), infinite).value_or(Vector3d::Zero())(0);
  }

  // The same, but a few points of a neighbour do not matter.
  double error() const {
    constexpr int rounds = 5;
    Vector3d change = Vector3d::Zero();
    double inlier_max = infinite;
    for (int i = 0; i < rounds; ++i) {
      const std::optional<Vector3d> fitted = least_squares(change, inlier_max);
      if (!fitted) return 0;
      change = *fitted;
      inlier_max = largest_inlier(change);
    }
    return change(0);
  }

private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  struct Point {
    Vector3d terms;   // how its residual changes with the radius and the two moves
    double residual;  // m

    double left(const Vector3d& change) const { return std::abs(residual - terms.dot(change)); }
  };

  // Over the points of which at most so much is left after a change.
  std::optional<Vector3d> least_squares(const Vector3d& change, double left_max) const {
    Matrix3d products = Matrix3d::Zero();
    Vector3d right_side = Vector3d::Zero();
    int points = 0;
    for (const Point& point : points_) {
      if (point.left(change) > left_max) continue;
      products += point.terms * point.terms.transpose();
      right_side += point.terms * point.residual;
      ++points;
    }
    constexpr int points_min = 30;
    if (points < points_min) return std::nullopt;
    const double independent = 1 / products.inverse()(0, 0) / points;  // of the mean square of the row's 1
    constexpr double independent_min = 1e-4;
    if (!(independent > independent_min)) return std::nullopt;
    return products.ldlt().solve(right_side);
  }

  // Three standard deviations, from the median, and 2 % of the radius at least.
  double largest_inlier(const Vector3d& change) const {
    std::vector<double> left;
    left.reserve(points_.size());
    for (const Point& point : points_) left.push_back(point.left(change));
    constexpr double deviations = 3 * deviation_of_median;
    constexpr double least = 0.02;
    return std::max(deviations * median(std::move(left)), least * radius_);
  }

  double radius_;
  std::vector<Point> points_;
};

LengthFit length_fit(double length, const TubeKind& kind) {
  constexpr double tolerance = 0.05;
  if (length > kind.length() * (1 + tolerance)) return LengthFit::too_long;
  if (kind.length_min == 0) return LengthFit::unknown;
  return length < kind.length_min * (1 - tolerance) ? LengthFit::too_short : LengthFit::complete;
}

void weigh(TubeEvidence& evidence, const Tube& tube, const std::vector<Vector3d>& points,
           const KnownScene& known) {
  CentreLine line(tube);
  RadiusFit radius(tube.radius);
  const Vector3d camera = known.camera.pose.translation();
  double squares = 0;
  std::size_t beside = 0;
  for (const Vector3d& point : points) {
    const Foot foot = line.foot_of(point);
    line.see(foot);
    const double distance = foot.way.norm();
    if (line.is_on_end(foot) || distance == 0) continue;
    const double residual = distance - tube.radius;
    const Vector3d outwards = foot.way / distance;
    const Vector3d to_sensor = (camera - point).normalized();
    squares += residual * residual;
    ++beside;
    radius.add(outwards, line.direction_at(foot), to_sensor, residual);
  }
  if (beside > 0) evidence.residual = std::sqrt(squares / static_cast<double>(beside));
  evidence.radius_error = radius.error();
  evidence.unevenness = radius.error_with_outliers();
  evidence.length = total_length(tube);
  evidence.visible_length = line.seen_length();
  evidence.length_fit = length_fit(evidence.length, known.kinds.at(evidence.kind));
  evidence.confidence = confidence(features_of(evidence, known));
}

// Enough to meet each part of a centre line that is seen.
std::size_t points_wanted(const Tube& tube) {
  constexpr double least = 300;
  constexpr double for_each_part = 6;
  return static_cast<std::size_t>(std::max(least, for_each_part * total_length(tube) / tube.radius));
}

// Of each tube, evenly chosen points with its label. Counts all of them.
std::vector<std::vector<Vector3d>> some_points(Model& model, const PointCloud& cloud) {
  std::vector<std::size_t> left(model.tubes.size() + 1);
  for (const std::int32_t label : model.labels) {
    if (label > 0) ++left[static_cast<std::size_t>(label)];
  }
  std::vector<std::size_t> strides(left.size());
  for (std::size_t tube = 0; tube < model.tubes.size(); ++tube) {
    strides[tube + 1] = left[tube + 1] / points_wanted(model.tubes[tube]) + 1;
    model.evidence[tube].points = left[tube + 1];
  }
  std::vector<std::vector<Vector3d>> points(model.tubes.size());
  for (std::size_t i = 0; i < model.labels.size(); ++i) {
    if (model.labels[i] <= 0) continue;
    const auto label = static_cast<std::size_t>(model.labels[i]);
    if (--left[label] % strides[label] == 0) points[label - 1].push_back(cloud.points[i].cast<double>());
  }
  return points;
}

}  // namespace

void weigh(Model& model, const PointCloud& cloud, const KnownScene& known) {
  const std::vector<std::vector<Vector3d>> points = some_points(model, cloud);
  for (std::size_t tube = 0; tube < model.tubes.size(); ++tube)
    weigh(model.evidence[tube], model.tubes[tube], points[tube], known);
}

}  // namespace tanglebin
