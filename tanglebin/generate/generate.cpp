#include "tanglebin/generate/generate.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/generate/bar.hpp"

namespace tanglebin {
namespace {

constexpr int max_draws = 1000;

// Closest points within this fraction of an edge's end are at its node, and distances within this many metres
// of each other are equal: far above rounding, far below anything that matters to a tube.
constexpr double tie = 1e-9;

Eigen::Vector3d direction(double polar, double azimuth) {
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

std::size_t index_of_node(const Tube& tube, int id) {
  const auto node = std::ranges::find(tube.nodes, id, &Node::id);
  return static_cast<std::size_t>(std::distance(tube.nodes.begin(), node));
}

// Algorithm 1, lines 4-10, from a node that the tube has already. Inner nodes are numbered from next_id on.
void draw_segment(Rng& rng, const SegmentSpec& segment, int& next_id, Tube& tube) {
  const int cylinders = uniform_integer(rng, segment.cylinders_min, segment.cylinders_max);
  const std::vector<double> lengths =
      draw_lengths(rng, cylinders, segment.length, segment.cylinder_length_min);
  const std::vector<Eigen::Vector3d> endpoints =
      draw_endpoints(rng, lengths, segment.bend_min, segment.bend_max);

  std::size_t from = index_of_node(tube, segment.from);
  const Eigen::Vector3d start = tube.nodes[from].position;
  for (int order = 1; order <= cylinders; ++order) {
    const std::size_t to = tube.nodes.size();
    const int id = order < cylinders ? next_id++ : segment.to;
    tube.nodes.push_back({id, start + endpoints[static_cast<std::size_t>(order)]});
    tube.edges.push_back({from, to, order});
    from = to;
  }
}

Tube empty_tube(const TubeSpec& spec, int id) {
  return {.id = id,
          .radius = spec.radius,
          .mass = spec.mass,
          .nodes = {},
          .edges = {},
          .flat_ends = spec.flat_ends};
}

Tube draw_once(Rng& rng, const TubeSpec& spec, int id) {
  Tube tube = empty_tube(spec, id);
  tube.nodes.push_back({1, Eigen::Vector3d::Zero()});
  // The named nodes are one more than the segments, and the published files leave the id after them free.
  int next_id = static_cast<int>(spec.segments.size()) + 3;
  for (const SegmentSpec& segment : spec.segments) draw_segment(rng, segment, next_id, tube);
  return tube;
}

bool share_node(const Edge& a, const Edge& b) {
  return a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to;
}

SegmentPair closest_on_edges(const Tube& tube, const Edge& a, const Edge& b) {
  const auto position = [&](std::size_t node) { return tube.nodes[node].position; };
  return closest_points(position(a.from), position(a.to), position(b.from), position(b.to));
}

// The edges that a point of the centre line belongs to: all that meet at a node where the point is one.
std::vector<Edge> edges_at(const Tube& tube, const Edge& edge, double parameter) {
  if (parameter > tie && parameter < 1 - tie) return {edge};
  const std::size_t node = parameter <= tie ? edge.from : edge.to;
  std::vector<Edge> edges;
  std::ranges::copy_if(tube.edges, std::back_inserter(edges),
                       [&](const Edge& other) { return other.from == node || other.to == node; });
  return edges;
}

// The distance between the points of two segments is convex. So their closest points are a local minimum on
// the whole centre line unless another pair of edges at the same two points comes closer.
bool is_local_minimum(const Tube& tube, const Edge& a, const Edge& b, const SegmentPair& closest) {
  const std::vector<Edge> edges_at_b = edges_at(tube, b, closest.t);
  for (const Edge& edge_a : edges_at(tube, a, closest.s)) {
    for (const Edge& edge_b : edges_at_b) {
      if (closest_on_edges(tube, edge_a, edge_b).distance < closest.distance - tie) return false;
    }
  }
  return true;
}

// In any direction, like the first cylinder of a chain, and turned about it by any angle.
Tube draw_bar(Rng& rng, const TubeSpec& spec, int id) {
  Tube bar = straight_up_bar(spec, id);
  const double phi = uniform_real(rng, 0, 2 * std::numbers::pi);
  const double theta = uniform_real(rng, 0, std::numbers::pi);
  const double roll = uniform_real(rng, 0, 2 * std::numbers::pi);
  transform(bar, Eigen::Isometry3d(rotation_from_z(direction(theta, phi)) *
                                   Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ())));
  bar.mass = mass_of(bar, spec);
  return bar;
}

}  // namespace

std::vector<double> draw_lengths(Rng& rng, int cylinders, double total, double shortest) {
  std::vector<double> lengths;
  double remaining = total;
  for (int i = 0; i < cylinders - 1; ++i) {
    const double longest = remaining - (cylinders - 1 - i) * shortest;
    // Where there is nothing to choose, rounding may leave the longest an ulp below the shortest.
    lengths.push_back(uniform_real(rng, shortest, std::max(shortest, longest)));  // Line 4
    remaining -= lengths.back();
  }
  lengths.push_back(remaining);
  return lengths;
}

std::vector<Eigen::Vector3d> draw_endpoints(Rng& rng, const std::vector<double>& lengths, double bend_min,
                                            double bend_max) {
  constexpr double pi = std::numbers::pi;
  std::vector<Eigen::Vector3d> endpoints{Eigen::Vector3d::Zero()};
  Eigen::Vector3d unit_direction;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double phi = uniform_real(rng, 0, 2 * pi);  // Line 4
    if (i == 0) {
      const double theta = uniform_real(rng, 0, pi);
      unit_direction = direction(theta, phi);
    } else {
      const double theta = uniform_real(rng, bend_min, bend_max);
      unit_direction = (rotation_from_z(unit_direction) * direction(theta, phi)).normalized();  // Line 11
    }
    endpoints.emplace_back(endpoints.back() + lengths[i] * unit_direction);  // Line 12
  }
  return endpoints;
}

Tube straight_up_bar(const TubeSpec& spec, int id) {
  Tube bar = empty_tube(spec, id);
  const std::vector<Eigen::Vector3d> line = centre_line(spec.pieces);
  constexpr int first_inner_id = 4;  // as in the paper's chains
  for (std::size_t i = 0; i < line.size(); ++i) {
    const int order = static_cast<int>(i);
    bar.nodes.push_back({first_inner_id + order - 1, line[i]});
    if (i > 0) bar.edges.push_back({i - 1, i, order});
  }
  bar.nodes.front().id = 1;
  bar.nodes.back().id = 2;
  return bar;
}

Tube draw_tube(Rng& rng, const TubeSpec& spec, int id) {
  if (!spec.pieces.empty()) return draw_bar(rng, spec, id);
  for (int draw = 0; draw < max_draws; ++draw) {
    Tube tube = draw_once(rng, spec, id);
    if (passes_through_itself(tube)) continue;
    tube.mass = mass_of(tube, spec);
    return tube;
  }
  throw InputError({.file = {}, .line = 0, .field = "tube"},
                   "each of " + std::to_string(max_draws) +
                       " tubes drawn passes through itself; allow smaller bends, fewer cylinders or longer "
                       "ones");
}

bool passes_through_itself(const Tube& tube) {
  for (auto a = tube.edges.begin(); a != tube.edges.end(); ++a) {
    for (auto b = std::next(a); b != tube.edges.end(); ++b) {
      if (share_node(*a, *b)) continue;
      const SegmentPair closest = closest_on_edges(tube, *a, *b);
      if (closest.distance < 2 * tube.radius && is_local_minimum(tube, *a, *b, closest)) return true;
    }
  }
  return false;
}

}  // namespace tanglebin
