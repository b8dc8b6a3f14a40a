#include "tanglebin/model/axis/tube_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "tanglebin/geometry/capsule.hpp"
#include "tanglebin/model/axis/assemble.hpp"
#include "tanglebin/model/axis/line_tree.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

// Ramer–Douglas–Peucker: marks the nodes of a path, between its first and last, that are needed to stay
// within the tolerance of all nodes.
void mark_needed(const std::vector<Vector3d>& nodes, const std::vector<std::size_t>& path, std::size_t first,
                 std::size_t last, double tolerance, std::vector<bool>& needed) {
  double farthest = tolerance;
  std::size_t at = none;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double distance = axis_distance({nodes[path[first]], nodes[path[last]], 0}, nodes[path[i]]);
    if (distance <= farthest) continue;
    farthest = distance;
    at = i;
  }
  if (at == none) return;
  needed[path[at]] = true;
  mark_needed(nodes, path, first, at, tolerance, needed);
  mark_needed(nodes, path, at, last, tolerance, needed);
}

// The needed nodes of a path, without those that nearly coincide.
std::vector<std::size_t> needed_nodes(const LineTree& line, const std::vector<std::size_t>& path,
                                      double tolerance) {
  std::vector<bool> needed(line.nodes.size());
  mark_needed(line.nodes, path, 0, path.size() - 1, tolerance, needed);
  std::vector<std::size_t> kept{path.front()};
  for (const std::size_t node : path) {
    if (needed[node] && (line.nodes[node] - line.nodes[kept.back()]).norm() >= tolerance)
      kept.push_back(node);
  }
  kept.push_back(path.back());
  return kept;
}

// Keeps the ends and junctions, which come first, and the bends between them.
LineTree simplified(const LineTree& line, double tolerance) {
  const Paths paths(line);
  LineTree result;
  std::vector<std::size_t> new_index(line.nodes.size(), none);
  const auto add = [&](std::size_t node) {
    new_index[node] = result.nodes.size();
    result.nodes.push_back(line.nodes[node]);
  };
  for (std::size_t node = 0; node < line.nodes.size(); ++node) {
    if (paths.is_named(node)) add(node);
  }
  for (const std::vector<std::size_t>& path : paths.all()) {
    const std::vector<std::size_t> kept = needed_nodes(line, path, tolerance);
    for (std::size_t i = 1; i < kept.size(); ++i) {
      if (i + 1 < kept.size()) add(kept[i]);
      result.edges.push_back({new_index[kept[i - 1]], new_index[kept[i]]});
    }
  }
  return result;
}

/// The point of the centre line nearest to a point, with its edge.
struct Foot {
  std::size_t edge;
  double t;
  Vector3d way;  // m, from the axis to the point
};

Foot foot_of(const LineTree& line, const Vector3d& point) {
  Foot foot{none, 0, {}};
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t edge = 0; edge < line.edges.size(); ++edge) {
    const Vector3d& a = line.nodes[line.edges[edge][0]];
    const Vector3d& b = line.nodes[line.edges[edge][1]];
    const double t = nearest_on_axis({a, b, 0}, point);
    const Vector3d way = point - (a + t * (b - a));
    if (way.squaredNorm() >= nearest) continue;
    nearest = way.squaredNorm();
    foot = {edge, t, way};
  }
  return foot;
}

// One Gauss-Newton step on the distances of the points to the surface. Damped, so that parts without points
// stay in place.
void improve(LineTree& line, const std::vector<Vector3d>& points, double radius, double residual_max) {
  const auto size = static_cast<Eigen::Index>(3 * line.nodes.size());
  Eigen::MatrixXd normal_matrix = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right_side = Eigen::VectorXd::Zero(size);
  for (const Vector3d& point : points) {
    const Foot foot = foot_of(line, point);
    const double distance = foot.way.norm();
    const double residual = distance - radius;
    if (std::abs(residual) > residual_max) continue;
    const Vector3d direction = foot.way / distance;
    const auto a = static_cast<Eigen::Index>(3 * line.edges[foot.edge][0]);
    const auto b = static_cast<Eigen::Index>(3 * line.edges[foot.edge][1]);
    const Eigen::Matrix3d product = direction * direction.transpose();
    const double s = 1 - foot.t;
    normal_matrix.block<3, 3>(a, a) += s * s * product;
    normal_matrix.block<3, 3>(a, b) += s * foot.t * product;
    normal_matrix.block<3, 3>(b, a) += s * foot.t * product;
    normal_matrix.block<3, 3>(b, b) += foot.t * foot.t * product;
    right_side.segment<3>(a) += s * residual * direction;
    right_side.segment<3>(b) += foot.t * residual * direction;
  }
  constexpr double damping = 0.01;  // relative to the node's share of the points
  normal_matrix.diagonal().array() +=
      damping * static_cast<double>(points.size() + 1) / static_cast<double>(line.nodes.size());
  const Eigen::VectorXd step = normal_matrix.ldlt().solve(right_side);
  for (std::size_t node = 0; node < line.nodes.size(); ++node) {
    line.nodes[node] += step.segment<3>(static_cast<Eigen::Index>(3 * node));
  }
}

std::vector<Vector3d> some_points(const std::vector<Fragment>& fragments,
                                  const std::vector<std::size_t>& members,
                                  const std::vector<Eigen::Vector3f>& points, std::size_t points_max) {
  std::vector<std::size_t> all;
  for (const std::size_t member : members) {
    all.insert(all.end(), fragments[member].points.begin(), fragments[member].points.end());
  }
  const std::size_t stride = all.size() / points_max + 1;
  std::vector<Vector3d> some;
  some.reserve(points_max);
  for (std::size_t i = 0; i < all.size(); i += stride) some.emplace_back(points[all[i]].cast<double>());
  return some;
}

// Named nodes are 1, 2, …; inner nodes follow after a gap, as in the published data.
Tube tube_of(const LineTree& line, double radius) {
  const auto neighbours = neighbours_in(line);
  const auto named = std::ranges::count_if(neighbours, [](const auto& around) { return around.size() != 2; });
  Tube tube;
  tube.radius = radius;
  constexpr int gap = 2;
  for (std::size_t node = 0; node < line.nodes.size(); ++node) {
    const int number = static_cast<int>(node) + 1;
    tube.nodes.push_back({number <= named ? number : number + gap - 1, line.nodes[node]});
  }
  for (const auto& [from, to] : line.edges) {
    const bool starts_segment = static_cast<std::ptrdiff_t>(from) < named;
    const int order = starts_segment ? 1 : tube.edges.back().order + 1;
    tube.edges.push_back({from, to, order});
  }
  return tube;
}

}  // namespace

Tube fit_tube(const std::vector<Fragment>& fragments, const std::vector<std::size_t>& members,
              const std::vector<Link>& links, const std::vector<std::size_t>& chosen,
              const std::vector<Eigen::Vector3f>& points, double radius, const TubeFitSettings& settings) {
  LineTree line =
      simplified(assembled_line(fragments, members, links, chosen, radius), settings.tolerance * radius);
  const std::vector<Vector3d> fitted_to = some_points(fragments, members, points, settings.points_max);
  for (int i = 0; i < settings.iterations; ++i)
    improve(line, fitted_to, radius, settings.residual_max * radius);
  return tube_of(line, radius);
}

}  // namespace tanglebin
