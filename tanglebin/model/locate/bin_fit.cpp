#include "tanglebin/model/locate/bin_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "tanglebin/base/median.hpp"
#include "tanglebin/model/locate/rim_edges.hpp"

namespace tanglebin {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// The unknowns: translation (m) and rotation (rad) in the bin's frame, the bin's four sizes (m), and by how
// much the seen rim ends before its true edge (pixels).
constexpr int unknowns = 11;
constexpr int of_length = 6;
constexpr int of_width = 7;
constexpr int of_height = 8;
constexpr int of_wall = 9;
constexpr int of_gap = 10;
using Row = Eigen::Matrix<double, unknowns, 1>;
using Square = Eigen::Matrix<double, unknowns, unknowns>;

// What is observed: points on each part, pixels at the inner and at the outer edge of each wall's rim.
constexpr std::size_t inner_edges = part_count;
constexpr std::size_t outer_edges = part_count + 4;
constexpr std::size_t kinds = part_count + 8;

constexpr double likely_gap = 0.6;  // pixels: half of one, and mixed pixels at the edge

/// A bin that is being fitted.
struct State {
  Isometry3d pose;  // bin frame → camera frame
  Bin bin;
  double gap;  // pixels
};

/// A distance that should be zero.
struct Observation {
  std::size_t kind;
  Vector3d place;   // m, bin frame
  double residual;  // m
  Row gradient;
  double variance = 1;  // m²
  double trust = 1;     // 0 for an outlier
};

using Gates = std::array<double, kinds>;  // m, for each kind: what is farther is not an observation

int unknown_of_half(int axis) {
  return axis == 0 ? of_length : of_width;
}

double half_size(const Bin& bin, int axis) {
  return (axis == 0 ? bin.length : bin.width) / 2;
}

// The gradient of normal · place over the pose.
Row gradient_of(const Vector3d& normal, const Vector3d& place) {
  Row gradient = Row::Zero();
  gradient.head<3>() = -normal;
  gradient.segment<3>(3) = -place.cross(normal);
  return gradient;
}

bool faces_camera(const State& state, const PartPlane& plane) {
  const Vector3d camera = state.pose.inverse(Eigen::Isometry).translation();
  return plane.normal.dot(camera) > plane.offset;
}

// Whether a point on a part's plane is on the part, at least `inset` (m, may be negative) away from its
// borders.
bool is_on_part(const Bin& bin, std::size_t part, const Vector3d& place, double inset) {
  const PartKind kind = kind_of_part(part);
  const double x = std::abs(place.x()) - bin.length / 2;
  const double y = std::abs(place.y()) - bin.width / 2;
  if (kind == PartKind::floor) return x < -inset && y < -inset;
  const int axis = axis_of_wall(wall_of_part(part));
  if (kind == PartKind::rim) {
    const double rim_inset = std::min(inset, 0.0);
    const double across = axis == 0 ? x : y;
    const double along = axis == 0 ? y : x;
    const bool on_this_side = place[axis] * side_of_wall(wall_of_part(part)) > 0;
    return on_this_side && across > rim_inset && across < bin.wall - rim_inset && along < bin.wall - inset;
  }
  const double along = axis == 0 ? y : x;
  const double overlap = kind == PartKind::outer ? bin.wall : 0.0;
  return along < overlap - inset && place.z() > inset && place.z() < bin.height - inset;
}

Observation observation_on_part(const Bin& bin, std::size_t part, const Vector3d& place) {
  const PartPlane plane = plane_of_part(bin, part);
  Observation observation{.kind = part,
                          .place = place,
                          .residual = plane.normal.dot(place) - plane.offset,
                          .gradient = gradient_of(plane.normal, place)};
  const PartKind kind = kind_of_part(part);
  if (kind == PartKind::rim) observation.gradient[of_height] = -1;
  if (kind == PartKind::inner || kind == PartKind::outer) {
    const int half = unknown_of_half(axis_of_wall(wall_of_part(part)));
    observation.gradient[half] = kind == PartKind::inner ? 0.5 : -0.5;
    if (kind == PartKind::outer) observation.gradient[of_wall] = -1;
  }
  return observation;
}

// The nearest part that a point may be on.
std::optional<Observation> observation_of_point(const State& state, const Vector3d& place,
                                                const std::vector<std::size_t>& parts, const Gates& gates,
                                                bool is_final) {
  std::optional<Observation> nearest;
  for (const std::size_t part : parts) {
    const double gate = gates.at(part);
    const PartPlane plane = plane_of_part(state.bin, part);
    const double distance = std::abs(plane.normal.dot(place) - plane.offset);
    if (distance > gate || (nearest && std::abs(nearest->residual) <= distance)) continue;
    if (is_on_part(state.bin, part, place, is_final ? gate : -gate))
      nearest = observation_on_part(state.bin, part, place);
  }
  return nearest;
}

// An edge (in the bin's frame) of a wall's rim: the inner or the outer one.
std::optional<Observation> observation_of_edge(const State& state, const RimEdge& edge, std::size_t wall,
                                               bool is_inner, const Gates& gates) {
  constexpr double least_alignment = 0.6;
  const Vector3d& place = edge.point;
  const int axis = axis_of_wall(wall);
  const Vector3d outwards = (is_inner ? -1 : 1) * side_of_wall(wall) * Vector3d::Unit(axis);  // of the rim
  const double step = outwards.dot(edge.step);
  if (step < least_alignment * edge.step.norm()) return std::nullopt;
  const double half = half_size(state.bin, axis);
  const double end = is_inner ? -half : half + state.bin.wall;
  const double along = std::abs(place[1 - axis]) - half_size(state.bin, 1 - axis);
  if (along > (is_inner ? 0.0 : state.bin.wall)) return std::nullopt;
  Observation observation{.kind = (is_inner ? inner_edges : outer_edges) + wall,
                          .place = place,
                          .residual = end - outwards.dot(place) - state.gap * step,
                          .gradient = -gradient_of(outwards, place)};
  if (std::abs(observation.residual) > gates.at(observation.kind)) return std::nullopt;
  observation.gradient[unknown_of_half(axis)] = is_inner ? -0.5 : 0.5;
  observation.gradient[of_wall] = is_inner ? 0 : 1;
  observation.gradient[of_gap] = -step;
  return observation;
}

std::vector<Observation> observe(const State& state, const std::vector<Vector3d>& points,
                                 const std::vector<RimEdge>& edges, const Gates& gates, bool is_final) {
  const Isometry3d from_camera = state.pose.inverse(Eigen::Isometry);
  std::vector<std::size_t> visible;
  for (std::size_t part = 0; part < part_count; ++part) {
    if (faces_camera(state, plane_of_part(state.bin, part))) visible.push_back(part);
  }
  std::vector<Observation> observations;
  for (const Vector3d& point : points) {
    const auto observation = observation_of_point(state, from_camera * point, visible, gates, is_final);
    if (observation) observations.push_back(*observation);
  }
  for (const RimEdge& seen : edges) {
    const RimEdge edge{from_camera * seen.point, from_camera.linear() * seen.step};
    for (std::size_t wall = 0; wall < 4; ++wall) {
      for (const bool is_inner : {true, false}) {
        const auto observation = observation_of_edge(state, edge, wall, is_inner, gates);
        if (observation) observations.push_back(*observation);
      }
    }
  }
  return observations;
}

using Spreads = std::array<double, kinds>;  // m, robust standard deviations, NaN for none

std::array<std::vector<double>, kinds> distances_by_kind(const std::vector<Observation>& observations) {
  std::array<std::vector<double>, kinds> distances;
  for (const Observation& observation : observations)
    distances.at(observation.kind).push_back(std::abs(observation.residual));
  return distances;
}

Spreads spreads_of(const std::vector<Observation>& observations) {
  constexpr double smallest = 0.0001;
  Spreads spreads{};
  auto distances = distances_by_kind(observations);
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    if (!distances.at(kind).empty())
      spreads.at(kind) = std::max(deviation_of_median * median(std::move(distances.at(kind))), smallest);
  }
  return spreads;
}

// A piece of a surface or edge, of 0.15 m; its points share an error.
std::array<long, 4> block_of(const Observation& observation) {
  constexpr double size = 0.15;
  const auto cell = [](double value) { return std::lround(value / size); };
  const Vector3d& place = observation.place;
  return {static_cast<long>(observation.kind), cell(place.x()), cell(place.y()), cell(place.z())};
}

/// Sums over a block.
struct Block {
  double weight = 0;
  double sum = 0;  // of residuals, m
};

std::map<std::array<long, 4>, Block> blocks_of(const std::vector<Observation>& observations) {
  std::map<std::array<long, 4>, Block> blocks;
  for (const Observation& observation : observations) {
    Block& block = blocks[block_of(observation)];
    block.weight += observation.trust;
    block.sum += observation.trust * observation.residual;
  }
  return blocks;
}

/// Errors that the points of a block share, m.
struct SharedErrors {
  double floor;
  double others;

  double of_kind(std::size_t kind) const { return kind == 0 ? floor : others; }
};

double robust_deviation(std::vector<double> distances) {
  constexpr double smallest = 0.0001;
  return distances.empty() ? smallest
                           : std::max(deviation_of_median * median(std::move(distances)), smallest);
}

// Robust standard deviations of the blocks' mean residuals. A floor that bulges, or is covered with dirt, has
// a greater one than the other surfaces.
SharedErrors shared_errors(const std::vector<Observation>& observations) {
  constexpr double enough = 20;
  constexpr std::size_t blocks_min = 4;
  std::vector<double> of_all;
  std::vector<double> of_floor;
  for (const auto& [place, block] : blocks_of(observations)) {
    if (block.weight <= enough) continue;
    of_all.push_back(std::abs(block.sum / block.weight));
    if (place[0] == 0) of_floor.push_back(of_all.back());
  }
  const bool is_floor_seen = of_floor.size() >= blocks_min;
  const double overall = robust_deviation(std::move(of_all));
  return {is_floor_seen ? std::max(overall, robust_deviation(std::move(of_floor))) : overall, overall};
}

// Gives each observation a variance, with what its block shares, and takes trust from outliers (Tukey's
// biweight).
void weigh(std::vector<Observation>& observations, const Gates& gates, const SharedErrors& errors) {
  const Spreads spreads = spreads_of(observations);
  for (Observation& observation : observations) {
    const double ratio = observation.residual / gates.at(observation.kind);
    observation.trust = (1 - ratio * ratio) * (1 - ratio * ratio);
  }
  const auto blocks = blocks_of(observations);
  for (Observation& observation : observations) {
    const double spread = spreads.at(observation.kind);
    const double shared = errors.of_kind(observation.kind);
    observation.variance = spread * spread + blocks.at(block_of(observation)).weight * shared * shared;
  }
}

/// Normal equations.
struct Normal {
  Square information = Square::Zero();
  Row gradient = Row::Zero();
};

// What is known without looking: sizes and gap.
void add_prior(Normal& normal, const State& state, const BinToFit& known, double pixel) {
  constexpr double tolerance = 0.001;
  constexpr double gap_spread = 0.4;
  const auto add = [&](int unknown, double deviation, double spread) {
    normal.information(unknown, unknown) += 1 / (spread * spread);
    normal.gradient[unknown] += deviation / (spread * spread);
  };
  const double spread = tolerance + known.margin;
  add(of_length, state.bin.length - known.bin.length, spread);
  add(of_width, state.bin.width - known.bin.width, spread);
  add(of_height, state.bin.height - known.bin.height, spread);
  add(of_wall, state.bin.wall - known.bin.wall, spread);
  add(of_gap, state.gap - likely_gap, gap_spread + known.margin / 2 / pixel);
}

Normal normal_equations(const std::vector<Observation>& observations) {
  Normal normal;
  for (const Observation& observation : observations) {
    const double weight = observation.trust / observation.variance;
    normal.information += weight * observation.gradient * observation.gradient.transpose();
    normal.gradient += weight * observation.residual * observation.gradient;
  }
  return normal;
}

// Keeps unknowns that nothing was seen of from wandering, and the information invertible.
void add_inertia(Square& information) {
  constexpr double metres = 0.3;
  constexpr double radians = 0.5;
  for (int i = 0; i < 3; ++i) {
    information(i, i) += 1 / (metres * metres);
    information(i + 3, i + 3) += 1 / (radians * radians);
  }
}

void move(State& state, const Row& step) {
  const Vector3d rotation = step.segment<3>(3);
  state.pose = state.pose * Eigen::Translation3d(step.head<3>());
  if (rotation.norm() > 0) state.pose.rotate(Eigen::AngleAxisd(rotation.norm(), rotation.normalized()));
  constexpr double thinnest = 0.0005;
  state.bin.length += step[of_length];
  state.bin.width += step[of_width];
  state.bin.height = std::max(state.bin.height + step[of_height], thinnest);
  state.bin.wall = std::max(state.bin.wall + step[of_wall], thinnest);
  state.gap += step[of_gap];
}

double pixel_at(const SensorView& view, const State& state) {
  return view.pixel_size(std::max((state.pose * Vector3d(0, 0, state.bin.height)).z(), 0.01));
}

// One step of Gauss and Newton; returns the information.
Square improve(const SensorView& view, const BinToFit& known, State& state,
               const std::vector<Observation>& observations) {
  Normal normal = normal_equations(observations);
  add_prior(normal, state, known, pixel_at(view, state));
  add_inertia(normal.information);
  move(state, normal.information.ldlt().solve(-normal.gradient));
  return normal.information;
}

std::vector<Vector3d> points_near(const SensorView& view, const State& state, std::size_t count) {
  constexpr double around = 0.05;  // m
  const Vector3d half(state.bin.length / 2 + state.bin.wall, state.bin.width / 2 + state.bin.wall, 0);
  Eigen::AlignedBox3d box(-half, half + state.bin.height * Vector3d::UnitZ());
  box.min().array() -= around;
  box.max().array() += around;
  const Isometry3d from_camera = state.pose.inverse(Eigen::Isometry);
  std::vector<Vector3d> points;
  for (const std::size_t pixel : view.sample(count)) {
    const Vector3d point = view.points[pixel].cast<double>();
    if (box.contains(from_camera * point)) points.push_back(point);
  }
  return points;
}

double closeness_to_rim(const BinToFit& known) {
  constexpr double least = 0.002;
  constexpr double deviations = 4;
  return std::max(least, deviations * known.noise) + known.margin;
}

Gates same_gates(double gate) {
  Gates gates{};
  gates.fill(gate);
  return gates;
}

// Five standard deviations of what was seen at the last gates.
Gates narrowed(const std::vector<Observation>& observations, double margin) {
  constexpr double deviations = 5;
  constexpr double narrowest = 0.0015;
  constexpr double widest = 0.01;
  Gates gates{};
  const Spreads spreads = spreads_of(observations);
  for (std::size_t kind = 0; kind < kinds; ++kind)
    gates.at(kind) = std::clamp(deviations * spreads.at(kind), narrowest, widest) + margin;
  return gates;
}

// What scatters more than points on a surface do is something else near it, such as tubes at a wall.
void drop_clutter(std::vector<Observation>& observations, const BinToFit& known) {
  const Spreads spreads = spreads_of(observations);
  std::erase_if(observations, [&](const Observation& observation) {
    return spreads.at(observation.kind) > closeness_of(known);
  });
}

State start(const BinToFit& known, const Isometry3d& pose) {
  return {.pose = pose, .bin = known.bin, .gap = likely_gap};
}

// Steps with gates that close. The sizes stay near the given ones: while gates are wide, they would follow
// clutter.
void approach(const SensorView& view, const BinToFit& known, State& state,
              const std::vector<Vector3d>& points, const std::vector<RimEdge>& edges) {
  constexpr double rough_error = 0.001;  // m, that points of a block share
  const BinToFit firm{.bin = known.bin, .margin = 0, .noise = known.noise};
  for (const double gate : {0.03, 0.03, 0.02, 0.02, 0.012, 0.012, 0.008, 0.008}) {
    const Gates gates = same_gates(gate + known.margin);
    std::vector<Observation> observations = observe(state, points, edges, gates, false);
    weigh(observations, gates, {rough_error, rough_error});
    improve(view, firm, state, observations);
  }
}

std::vector<RimEdge> edges_near(const SensorView& view, const BinToFit& known, const State& state) {
  constexpr double reach = 0.03;
  return rim_edges(view, known.bin, state.pose, closeness_to_rim(known), reach);
}

void describe(const std::vector<Observation>& observations, BinFit& fit) {
  const Spreads spreads = spreads_of(observations);
  double squares = 0;
  double weight = 0;
  for (const Observation& observation : observations) {
    if (observation.kind >= part_count) {
      ++fit.edges;
      continue;
    }
    PartFit& part = fit.parts.at(observation.kind);
    ++part.points;
    part.noise = spreads.at(observation.kind);
    squares += observation.trust * observation.residual * observation.residual;
    weight += observation.trust;
  }
  if (weight > 0) fit.residual = std::sqrt(squares / weight);
}

// The scanner's own error varies smoothly over the image: it moves and tilts all that is seen, and leaves no
// residual.
void add_error_of_calibration(BinFit& fit) {
  constexpr double share_of_distance = 1.5e-4;
  const double distance = fit.pose.translation().norm();
  const double error = share_of_distance * distance;
  const double tilt = std::numbers::sqrt2 * error / std::sqrt(fit.sizes.length * fit.sizes.width);
  const Vector3d sight = fit.pose.linear().transpose() * fit.pose.translation() / distance;
  const Vector3d middle(0, 0, fit.sizes.height);  // of the rim
  const Vector3d first = sight.unitOrthogonal();
  fit.covariance.topLeftCorner<3, 3>() += error * error * sight * sight.transpose();
  for (const Vector3d& axis : {first, Vector3d(sight.cross(first))}) {
    Eigen::Matrix<double, 6, 1> motion;
    motion << middle.cross(axis), axis;
    fit.covariance += tilt * tilt * motion * motion.transpose();
  }
}

}  // namespace

double closeness_of(const BinToFit& known) {
  constexpr double least = 0.003;
  constexpr double deviations = 4;
  return least + deviations * known.noise + known.margin;
}

Isometry3d moved_near(const SensorView& view, const BinToFit& known, const Isometry3d& pose) {
  constexpr std::size_t points = 6000;
  State state = start(known, pose);
  approach(view, known, state, points_near(view, state, points), edges_near(view, known, state));
  return state.pose;
}

BinFit fit_bin(const SensorView& view, const BinToFit& known, const Isometry3d& pose) {
  constexpr std::size_t points_max = 60000;
  constexpr int rounds = 8;
  constexpr int rounds_with_same_edges = 4;
  constexpr double wall_sd_max = 0.0007;  // m; what is seen says more than what is known without looking
  State state = start(known, pose);
  const std::vector<Vector3d> points = points_near(view, state, points_max);
  std::vector<RimEdge> edges = edges_near(view, known, state);
  approach(view, known, state, points, edges);
  Gates gates = same_gates(0.005 + known.margin);
  SharedErrors shared{0.0003, 0.0003};
  std::vector<Observation> observations;
  Square information;
  for (int round = 0; round < rounds; ++round) {
    if (round == rounds_with_same_edges) edges = edges_near(view, known, state);
    observations = observe(state, points, edges, gates, true);
    drop_clutter(observations, known);
    weigh(observations, gates, shared);
    shared = shared_errors(observations);
    gates = narrowed(observations, known.margin);
    information = improve(view, known, state, observations);
  }
  BinFit fit{.pose = state.pose, .sizes = state.bin};
  describe(observations, fit);
  const Square covariance = information.inverse();
  fit.covariance = covariance.topLeftCorner<6, 6>();
  fit.is_wall_measured = covariance(of_wall, of_wall) < wall_sd_max * wall_sd_max;
  add_error_of_calibration(fit);
  // A floor that bulges is all on one side of where it should be.
  fit.floor_variance = shared.floor * shared.floor - shared.others * shared.others;
  return fit;
}

}  // namespace tanglebin
