#include "tanglebin/model/axis/fragments/fragments.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "tanglebin/base/median.hpp"
#include "tanglebin/model/axis/fragments/skeleton.hpp"

namespace tanglebin {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Statistics of the points near the end of a fragment, at least of the nearest one.
struct Surroundings {
  std::vector<Vector3d> votes;  ///< m, relative to the end
  Vector3d mean;                ///< of the votes, m, relative to the end
  Matrix3d spread;              ///< of the votes, m²
  Vector3d normal;              ///< mean of the normals n
  Matrix3d normals;             ///< mean of n nᵀ
};

// The points whose votes are near the end; the one with the nearest vote if none is in reach.
std::vector<std::size_t> points_near(const Vector3d& end, const std::vector<std::size_t>& points,
                                     const AxisVotes& votes, double reach) {
  const auto squared_distance = [&](std::size_t point) {
    const Vector3d way = votes.votes[point].cast<double>() - end;
    return way.squaredNorm();
  };
  std::vector<std::size_t> near;
  std::ranges::copy_if(points, std::back_inserter(near),
                       [&](std::size_t point) { return squared_distance(point) <= reach * reach; });
  if (near.empty()) near.push_back(*std::ranges::min_element(points, {}, squared_distance));
  return near;
}

Surroundings surroundings(const Vector3d& end, const std::vector<std::size_t>& points, const AxisVotes& votes,
                          double reach) {
  std::vector<Vector3d> near;
  Vector3d sum = Vector3d::Zero();
  Matrix3d products = Matrix3d::Zero();
  Vector3d sum_of_normals = Vector3d::Zero();
  Matrix3d products_of_normals = Matrix3d::Zero();
  for (const std::size_t point : points_near(end, points, votes, reach)) {
    const Vector3d d = votes.votes[point].cast<double>() - end;
    const Vector3d normal = votes.normals[point].cast<double>();
    near.push_back(d);
    sum += d;
    products += d * d.transpose();
    sum_of_normals += normal;
    products_of_normals += normal * normal.transpose();
  }
  const auto count = static_cast<double>(near.size());
  const Vector3d mean = sum / count;
  return {std::move(near), mean, products / count - mean * mean.transpose(), sum_of_normals / count,
          products_of_normals / count};
}

// If a tube is seen end-on, only its cap may have votes: all in one place, from normals in all directions.
bool is_cap(const Surroundings& around, double radius, const FragmentSettings& settings) {
  if (std::sqrt(around.spread.trace()) > settings.spot_max * radius) return false;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(around.normals, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0] > settings.cap_min;
}

// The axis is where the votes spread out, and perpendicular to the normals, so even a short piece that shows
// much of its circumference has a direction. Behind a cap, the tube continues away from the normals.
Vector3d direction(const Surroundings& around, double radius, const FragmentSettings& settings) {
  if (is_cap(around, radius, settings)) return -around.normal.normalized();
  constexpr double unit_of_spread = 0.4;  // radii
  const double unit = unit_of_spread * radius;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(around.normals - around.spread / (unit * unit));
  return solver.eigenvectors().col(0);
}

// How far the votes extend, m, ignoring the outermost as noise.
double extent(const std::vector<Vector3d>& votes, const Vector3d& outward, double least) {
  std::vector<double> along;
  along.reserve(votes.size());
  for (const Vector3d& vote : votes) along.push_back(vote.dot(outward));
  constexpr double share = 0.02;
  const auto last = along.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(along.size()));
  std::ranges::nth_element(along, last, std::greater<>());
  return std::max(*last, least);
}

std::vector<std::size_t> leaves(const std::vector<std::size_t>& parents) {
  std::vector<std::size_t> neighbours(parents.size());
  for (std::size_t node = 1; node < parents.size(); ++node) {
    ++neighbours[node];
    ++neighbours[parents[node]];
  }
  std::vector<std::size_t> found;
  for (std::size_t node = 0; node < parents.size(); ++node) {
    if (neighbours[node] <= 1) found.push_back(node);
  }
  return found;
}

std::vector<FragmentEnd> ends_of(const Fragment& fragment, const AxisVotes& votes, double radius,
                                 const FragmentSettings& settings) {
  std::vector<FragmentEnd> ends;
  for (const std::size_t leaf : leaves(fragment.parents)) {
    const Vector3d& end = fragment.nodes[leaf];
    const Surroundings around = surroundings(end, fragment.points, votes, settings.end_length * radius);
    const double least = settings.extent_min * radius;
    const auto add_end = [&](const Vector3d& outward) {
      ends.push_back({leaf, end + extent(around.votes, outward, least) * outward, outward});
    };
    const Vector3d axis = direction(around, radius, settings);
    const Vector3d outward = axis.dot(around.mean) > 0 ? Vector3d(-axis) : axis;
    add_end(outward);
    if (fragment.nodes.size() == 1) add_end(-outward);
  }
  // A fragment with two nodes may be too short to tell its ends apart.
  constexpr std::size_t two_nodes = 2;
  if (fragment.nodes.size() == two_nodes && ends[0].outward.dot(ends[1].outward) > 0) {
    ends[1].outward = -ends[1].outward;
  }
  return ends;
}

// Its centre line leads inwards.
std::vector<FragmentEnd> ends_of_face(const Fragment& fragment) {
  const Vector3d outward = (fragment.nodes[0] - fragment.nodes[1]).normalized();
  return {{0, fragment.nodes[0], outward}, {1, fragment.nodes[1], -outward}};
}

double length_of(const Fragment& fragment) {
  double length = 0;
  for (std::size_t node = 1; node < fragment.nodes.size(); ++node) {
    length += (fragment.nodes[node] - fragment.nodes[fragment.parents[node]]).norm();
  }
  return length;
}

// Of a close scanner's points, a few in one place are noise.
void drop_specks(std::vector<Fragment>& fragments, double radius, double share_min) {
  const double points_min = share_min * points_on_a_radius(fragments, radius);
  std::erase_if(fragments, [&](const Fragment& fragment) {
    return static_cast<double>(fragment.points.size()) < points_min;
  });
}

// For each node, the points whose votes it is the nearest to.
std::vector<std::vector<std::size_t>> points_of_nodes(const Fragment& fragment, const AxisVotes& votes) {
  std::vector<std::vector<std::size_t>> of_nodes(fragment.nodes.size());
  for (const std::size_t point : fragment.points) {
    const Vector3d vote = votes.votes[point].cast<double>();
    const auto nearest = std::ranges::min_element(
        fragment.nodes, {}, [&](const Vector3d& node) { return (node - vote).squaredNorm(); });
    of_nodes[static_cast<std::size_t>(nearest - fragment.nodes.begin())].push_back(point);
  }
  return of_nodes;
}

// The node with the fewest votes of those that leave no more than this length, m, on both sides. None if it
// has about as many as others.
std::optional<std::size_t> weak_node(const Fragment& fragment, const AxisVotes& votes, double length_max) {
  constexpr double weak = 0.25;  // of the median
  const std::vector<std::vector<std::size_t>> points_of = points_of_nodes(fragment, votes);
  const std::vector<double> ways = ways_along(fragment.nodes);
  std::vector<std::size_t> counts;
  std::optional<std::size_t> weakest;
  for (std::size_t node = 0; node < ways.size(); ++node) {
    counts.push_back(points_of[node].size());
    if (ways[node] > length_max || ways.back() - ways[node] > length_max) continue;
    if (!weakest || counts[node] < counts[*weakest]) weakest = node;
  }
  if (!weakest) return std::nullopt;
  const double least = weak * static_cast<double>(median(counts));
  return static_cast<double>(counts[*weakest]) < least ? weakest : std::nullopt;
}

// The part with the nodes from `first` to before `end`, of a fragment without branches.
Fragment part_of(const Fragment& fragment, const std::vector<std::vector<std::size_t>>& points_of,
                 std::size_t first, std::size_t end) {
  Fragment part{.points = {}, .nodes = {}, .parents = {}, .ends = {}, .length = 0};
  for (std::size_t node = first; node < end; ++node) {
    part.parents.push_back(node == first ? 0 : node - first - 1);
    part.nodes.push_back(fragment.nodes[node]);
    part.points.insert(part.points.end(), points_of[node].begin(), points_of[node].end());
  }
  std::ranges::sort(part.points);
  return part;
}

}  // namespace

std::vector<double> ways_along(const std::vector<Vector3d>& line) {
  std::vector<double> ways{0};
  for (std::size_t i = 1; i < line.size(); ++i) ways.push_back(ways.back() + (line[i] - line[i - 1]).norm());
  return ways;
}

std::size_t number_of_points(const std::vector<Fragment>& fragments,
                             const std::vector<std::size_t>& members) {
  std::size_t points = 0;
  for (const std::size_t member : members) points += fragments[member].points.size();
  return points;
}

double points_on_a_radius(const std::vector<Fragment>& fragments, double radius) {
  constexpr double length_min = 2;  // radii
  std::vector<double> densities;
  for (const Fragment& fragment : fragments) {
    if (fragment.length < length_min * radius) continue;
    densities.push_back(static_cast<double>(fragment.points.size()) * radius / fragment.length);
  }
  return densities.empty() ? 0 : median(std::move(densities));
}

std::vector<Fragment> find_fragments(const AxisVotes& votes, double radius, bool with_branches,
                                     const FragmentSettings& settings, double shift) {
  const CutSettings cut{.branch_min = settings.branch_min * radius,
                        .spread_max = settings.spread_max * radius,
                        .share_min = settings.share_min,
                        .weak_max = settings.weak_max,
                        .parallel_max = settings.parallel_max,
                        .may_branch = with_branches,
                        .shift = shift,
                        .face_radius = radius};
  std::vector<Fragment> fragments;
  for (Skeleton& skeleton :
       find_skeletons(votes.votes, votes.normals, settings.voxel * radius, settings.step * radius, cut)) {
    if (skeleton.points.size() < static_cast<std::size_t>(settings.points_min)) continue;
    Fragment fragment{
        std::move(skeleton.points), std::move(skeleton.nodes), std::move(skeleton.parents), {}, 0};
    fragment.ends = skeleton.is_face ? ends_of_face(fragment) : ends_of(fragment, votes, radius, settings);
    fragment.length = length_of(fragment);
    fragments.push_back(std::move(fragment));
  }
  drop_specks(fragments, radius, settings.speck_max);
  return fragments;
}

std::size_t keep_largest(std::vector<Fragment>& fragments, std::size_t most) {
  if (fragments.size() <= most) return 0;
  const std::size_t dropped = fragments.size() - most;
  std::ranges::stable_sort(fragments, std::greater<>(),
                           [](const Fragment& fragment) { return fragment.points.size(); });
  fragments.erase(fragments.end() - static_cast<std::ptrdiff_t>(dropped), fragments.end());
  return dropped;
}

bool cut_at(std::vector<Fragment>& fragments, std::size_t which, std::size_t node, const AxisVotes& votes,
            double radius, const FragmentSettings& settings) {
  const Fragment& fragment = fragments[which];
  const std::vector<std::vector<std::size_t>> points_of = points_of_nodes(fragment, votes);
  std::array parts = {part_of(fragment, points_of, 0, node),
                      part_of(fragment, points_of, node + 1, fragment.nodes.size())};
  for (Fragment& part : parts) {
    if (part.points.size() < static_cast<std::size_t>(settings.points_min)) return false;
    part.ends = ends_of(part, votes, radius, settings);
    part.length = length_of(part);
  }
  fragments[which] = std::move(parts[0]);
  fragments.push_back(std::move(parts[1]));
  return true;
}

bool cut_too_long(std::vector<Fragment>& fragments, const AxisVotes& votes, double radius, double length_max,
                  const FragmentSettings& settings) {
  constexpr double much_longer = 1.25;  // a length that was told may be wrong by less
  const std::size_t before = fragments.size();
  for (std::size_t i = 0; i < before; ++i) {
    if (fragments[i].ends.size() > 2 || fragments[i].length <= much_longer * length_max) continue;
    const std::optional<std::size_t> weak = weak_node(fragments[i], votes, length_max);
    if (weak) cut_at(fragments, i, *weak, votes, radius, settings);
  }
  return fragments.size() > before;
}

}  // namespace tanglebin
