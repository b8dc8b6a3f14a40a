#include "tanglebin/model/axis/tube_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/geometry/capsule.hpp"
#include "tanglebin/geometry/nearest_axis.hpp"
#include "tanglebin/model/axis/links/assemble.hpp"
#include "tanglebin/model/axis/links/line_tree.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

// Ramer–Douglas–Peucker: marks the nodes of a path, between its first and last, that are needed to stay
// within the tolerance of all nodes.
void mark_needed(const std::vector<Vector3d>& nodes, const std::vector<std::size_t>& path, std::size_t first,
                 std::size_t last, double tolerance, std::vector<bool>& needed) {
  double farthest = tolerance;
  std::size_t at = no_index;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double distance = axis_distance({nodes[path[first]], nodes[path[last]], 0}, nodes[path[i]]);
    if (distance <= farthest) continue;
    farthest = distance;
    at = i;
  }
  if (at == no_index) return;
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
  std::vector<std::size_t> new_index(line.nodes.size(), no_index);
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

// One for each edge.
std::vector<Capsule> capsules_of(const LineTree& line, double radius) {
  std::vector<Capsule> capsules;
  capsules.reserve(line.edges.size());
  for (const auto& [from, to] : line.edges) capsules.push_back({line.nodes[from], line.nodes[to], radius});
  return capsules;
}

/// What the points are fitted with.
struct Shape {
  double radius;        // m
  double residual_max;  // m
  bool flat_ends;
};

// Around an end that is rounded off, the surface is that of a ball. A face says nothing of the axis.
bool is_on_face(const LineTree& line, const std::vector<Neighbours>& neighbours, const Foot& foot) {
  if (foot.t > 0 && foot.t < 1) return false;
  return neighbours[line.edges[foot.capsule][foot.t > 0 ? 1 : 0]].size() == 1;
}

// One Gauss-Newton step on the distances of the points to the surface. Damped, so that parts without points
// stay in place.
void improve(LineTree& line, const std::vector<Vector3d>& points, const Shape& shape) {
  const std::vector<Neighbours> neighbours = neighbours_in(line);
  const auto size = static_cast<Eigen::Index>(3 * line.nodes.size());
  Eigen::MatrixXd normal_matrix = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right_side = Eigen::VectorXd::Zero(size);
  NearestAxis nearest(capsules_of(line, shape.radius));
  for (const Vector3d& point : points) {
    const Foot foot = nearest.foot_of(point);
    const double distance = foot.way.norm();
    const double residual = distance - shape.radius;
    if (std::abs(residual) > shape.residual_max) continue;
    if (shape.flat_ends && is_on_face(line, neighbours, foot)) continue;
    const Vector3d direction = foot.way / distance;
    const auto a = static_cast<Eigen::Index>(3 * line.edges[foot.capsule][0]);
    const auto b = static_cast<Eigen::Index>(3 * line.edges[foot.capsule][1]);
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

// The nodes from an end to the next end or junction.
std::vector<std::size_t> path_from(std::size_t end, const std::vector<Neighbours>& neighbours) {
  std::vector<std::size_t> path{end, neighbours[end][0]};
  while (neighbours[path.back()].size() == 2) {
    const Neighbours& around = neighbours[path.back()];
    path.push_back(around[0] == path[path.size() - 2] ? around[1] : around[0]);
  }
  return path;
}

// The votes of a face are a disc one radius inside the tube, which draws the end of the centre line aside. So
// the line goes straight on from where it is clear of that. Where it is too short, it stays as it is.
void straighten_end(LineTree& line, const std::vector<std::size_t>& path, double radius) {
  const double clear = 1.6 * radius;
  const double seen_to = 4 * radius;
  std::vector<double> ways{0};
  for (std::size_t i = 1; i < path.size(); ++i)
    ways.push_back(ways.back() + (line.nodes[path[i]] - line.nodes[path[i - 1]]).norm());
  const auto first_beyond = [&](double way) {
    return static_cast<std::size_t>(std::ranges::lower_bound(ways, way) - ways.begin());
  };
  const std::size_t from = first_beyond(clear);
  const std::size_t back = std::min(first_beyond(seen_to), path.size() - 1);
  if (from >= back) return;
  const Vector3d start = line.nodes[path[from]];
  const Vector3d outward = (start - line.nodes[path[back]]).normalized();
  for (std::size_t i = 0; i < from; ++i) line.nodes[path[i]] = start + (ways[from] - ways[i]) * outward;
}

void straighten_ends(LineTree& line, double radius) {
  const std::vector<Neighbours> neighbours = neighbours_in(line);
  for (std::size_t node = 0; node < line.nodes.size(); ++node) {
    if (neighbours[node].size() == 1) straighten_end(line, path_from(node, neighbours), radius);
  }
}

// Moves each end along its last piece to where the points on the side end, except for the outermost as noise.
// Those at the rim of a face have no votes, and so are in no fragment: all points are looked at.
void cut_ends(LineTree& line, const std::vector<Eigen::Vector3f>& points, double radius) {
  const std::vector<Neighbours> neighbours = neighbours_in(line);
  for (std::size_t node = 0; node < line.nodes.size(); ++node) {
    if (neighbours[node].size() != 1) continue;
    const Vector3d end = line.nodes[node];
    const Vector3d piece = end - line.nodes[neighbours[node][0]];
    if (piece.norm() < radius / 2) continue;
    const Vector3d outward = piece.normalized();
    const double back = 2 * radius;
    const double ahead = 0.6 * radius;
    std::vector<double> beyond;
    for (const Eigen::Vector3f& point : points) {
      const Vector3d way = point.cast<double>() - end;
      const double along = way.dot(outward);
      if (!(along > -back && along < ahead)) continue;
      if (std::abs((way - along * outward).norm() - radius) < 0.1 * radius) beyond.push_back(along);
    }
    constexpr std::size_t enough = 8;
    constexpr std::size_t outermost = 50;  // one of so many
    if (beyond.size() < enough) continue;
    const auto last = beyond.begin() + static_cast<std::ptrdiff_t>(beyond.size() / outermost);
    std::ranges::nth_element(beyond, last, std::greater<>());
    line.nodes[node] += std::max(*last, radius / 4 - piece.norm()) * outward;
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
              const std::vector<Eigen::Vector3f>& points, const TubeKind& kind,
              const TubeFitSettings& settings) {
  const double radius = kind.radius;
  LineTree line = assembled_line(fragments, members, links, chosen, radius);
  if (kind.flat_ends) straighten_ends(line, radius);
  line = simplified(line, settings.tolerance * radius);
  const std::vector<Vector3d> fitted_to = some_points(fragments, members, points, settings.points_max);
  const Shape shape{radius, settings.residual_max * radius, kind.flat_ends};
  for (int i = 0; i < settings.iterations; ++i) improve(line, fitted_to, shape);
  if (kind.flat_ends) cut_ends(line, points, radius);
  Tube tube = tube_of(line, radius);
  tube.flat_ends = kind.flat_ends;
  return tube;
}

}  // namespace tanglebin
