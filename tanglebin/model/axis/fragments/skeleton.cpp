#include "tanglebin/model/axis/fragments/skeleton.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>
#include <queue>
#include <unordered_map>
#include <utility>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/median.hpp"
#include "tanglebin/model/axis/fragments/voxel.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

struct Voxel {
  Vector3i key;
  Vector3d sum = Vector3d::Zero();      // of its points
  Vector3d normals = Vector3d::Zero();  // sum of their normals
  std::size_t points = 0;
  std::vector<std::size_t> neighbours{};  // touching voxels

  Vector3d mean() const { return sum / static_cast<double>(points); }
};

// One of each pair of opposite neighbours of a voxel.
std::array<Vector3i, 13> half_of_the_neighbours() {
  std::array<Vector3i, 13> offsets;
  std::size_t count = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (std::array{x, y, z} > std::array{0, 0, 0}) offsets[count++] = {x, y, z};
      }
    }
  }
  return offsets;
}

struct VoxelGrid {
  double size;      // m, of a voxel
  Vector3d origin;  // m, a corner of the voxel (0, 0, 0)
  std::vector<Voxel> voxels{};
  std::unordered_map<std::uint64_t, std::size_t> at{};  // by voxel_key()
  std::vector<std::size_t> of_points{};  // for each point its voxel; no_index if the point is not finite

  Vector3i key_at(const Vector3d& position) const { return voxel_at(position - origin, size); }

  std::size_t find(const Vector3i& key) const {
    const auto found = at.find(voxel_key(key));
    return found == at.end() ? no_index : found->second;
  }
};

VoxelGrid fill_voxels(const std::vector<Eigen::Vector3f>& points, const std::vector<Eigen::Vector3f>& normals,
                      double size, double shift) {
  VoxelGrid grid{.size = size,
                 .origin = Vector3d::Constant(shift * size),
                 .of_points = std::vector(points.size(), no_index)};
  std::size_t last = no_index;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) continue;
    const Vector3d point = points[i].cast<double>();
    const Vector3i key = grid.key_at(point);
    // Most often, the next point is in the same voxel.
    if (last == no_index || grid.voxels[last].key != key) {
      const auto [found, is_new] = grid.at.try_emplace(voxel_key(key), grid.voxels.size());
      if (is_new) grid.voxels.push_back({key});
      last = found->second;
    }
    Voxel& voxel = grid.voxels[last];
    voxel.sum += point;
    if (!normals.empty()) voxel.normals += normals[i].cast<double>();
    ++voxel.points;
    grid.of_points[i] = last;
  }
  const auto offsets = half_of_the_neighbours();
  for (std::size_t i = 0; i < grid.voxels.size(); ++i) {
    for (const Vector3i& offset : offsets) {
      const std::size_t found = grid.find(grid.voxels[i].key + offset);
      if (found == no_index) continue;
      grid.voxels[i].neighbours.push_back(found);
      grid.voxels[found].neighbours.push_back(i);
    }
  }
  return grid;
}

// Cuts the links of a voxel to its neighbours.
void isolate(std::vector<Voxel>& voxels, std::size_t voxel) {
  for (const std::size_t neighbour : voxels[voxel].neighbours)
    std::erase(voxels[neighbour].neighbours, voxel);
  voxels[voxel].neighbours.clear();
}

// The connected components of a set of voxels. All others must be marked as seen, unless they have no
// neighbours in the set.
std::vector<std::vector<std::size_t>> connected_components(const std::vector<Voxel>& voxels,
                                                           const std::vector<std::size_t>& members,
                                                           std::vector<bool>& seen) {
  std::vector<std::vector<std::size_t>> components;
  for (const std::size_t member : members) seen[member] = false;
  for (const std::size_t first : members) {
    if (seen[first]) continue;
    std::vector<std::size_t> component{first};
    seen[first] = true;
    for (std::size_t next = 0; next < component.size(); ++next) {
      for (const std::size_t neighbour : voxels[component[next]].neighbours) {
        if (seen[neighbour]) continue;
        seen[neighbour] = true;
        component.push_back(neighbour);
      }
    }
    components.push_back(std::move(component));
  }
  return components;
}

/// The nodes of a skeleton sorted by x, to look only at those beside a place.
class SortedNodes {
public:
  explicit SortedNodes(const std::vector<Vector3d>& nodes) : nodes_(nodes), by_x_(nodes.size()) {
    std::iota(by_x_.begin(), by_x_.end(), std::size_t{0});
    std::ranges::sort(by_x_, {}, [&](std::size_t node) { return nodes_[node].x(); });
  }

  /// Whether there is a node for which `counts` holds within the reach (m) of a place.
  bool any_within(double reach, const Vector3d& place, const auto& counts) const {
    const auto x_of = [&](std::size_t node) { return nodes_[node].x(); };
    for (auto node = std::ranges::lower_bound(by_x_, place.x() - reach, {}, x_of);
         node != by_x_.end() && x_of(*node) <= place.x() + reach; ++node) {
      if (counts(*node) && (nodes_[*node] - place).norm() <= reach) return true;
    }
    return false;
  }

private:
  const std::vector<Vector3d>& nodes_;
  std::vector<std::size_t> by_x_;
};

/// Lays a tree along each connected component of the voxels.
class TreeMaker {
public:
  TreeMaker(const std::vector<Voxel>& voxels, double step)
      : voxels_(voxels), step_(step), distances_(voxels.size()), nodes_(voxels.size(), no_index) {}

  /// The node of the last tree that a voxel of its component belongs to.
  std::size_t node_of(std::size_t voxel) const { return nodes_[voxel]; }

  // The nodes are level sets of the distance from one end, as in a Reeb graph.
  Skeleton tree(std::vector<std::size_t> component) {
    for (const std::size_t voxel : component) nodes_[voxel] = no_index;
    measure_from(component.front(), component);
    const std::size_t end =
        *std::ranges::max_element(component, {}, [&](std::size_t v) { return distances_[v]; });
    measure_from(end, component);
    std::ranges::stable_sort(component, {}, [&](std::size_t voxel) { return distances_[voxel]; });
    Skeleton result;
    for (const std::size_t voxel : component) {
      if (nodes_[voxel] == no_index) add_node(result, voxel);
    }
    return result;
  }

private:
  // Dijkstra's algorithm.
  void measure_from(std::size_t start, const std::vector<std::size_t>& component) {
    for (const std::size_t voxel : component) distances_[voxel] = infinity;
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    distances_[start] = 0;
    queue.push({0, start});
    while (!queue.empty()) {
      const auto [distance, voxel] = queue.top();
      queue.pop();
      if (distance > distances_[voxel]) continue;
      for (const std::size_t neighbour : voxels_[voxel].neighbours) {
        const double through = distance + (voxels_[neighbour].mean() - voxels_[voxel].mean()).norm();
        if (through >= distances_[neighbour]) continue;
        distances_[neighbour] = through;
        queue.push({through, neighbour});
      }
    }
  }

  int level(std::size_t voxel) const { return static_cast<int>(distances_[voxel] / step_); }

  // Adds a node for all voxels of this level that are connected with `first`. Its parent is the first node of
  // the level below that it touches.
  void add_node(Skeleton& skeleton, std::size_t first) {
    const std::size_t node = skeleton.nodes.size();
    std::size_t parent = no_index;
    Vector3d sum = Vector3d::Zero();
    std::size_t count = 0;
    std::vector<std::size_t> members{first};
    nodes_[first] = node;
    for (std::size_t next = 0; next < members.size(); ++next) {
      const Voxel& voxel = voxels_[members[next]];
      sum += voxel.sum;
      count += voxel.points;
      for (const std::size_t neighbour : voxel.neighbours) {
        if (level(neighbour) < level(first)) parent = std::min(parent, nodes_[neighbour]);
        if (level(neighbour) != level(first) || nodes_[neighbour] != no_index) continue;
        nodes_[neighbour] = node;
        members.push_back(neighbour);
      }
    }
    skeleton.nodes.emplace_back(sum / static_cast<double>(count));
    skeleton.parents.push_back(parent == no_index ? 0 : parent);
  }

  const std::vector<Voxel>& voxels_;
  double step_;
  std::vector<double> distances_;   // of each voxel from the end of its component
  std::vector<std::size_t> nodes_;  // of each voxel
};

/// Prunes a tree to the longest path from its first node and its true branches. These are long, and their
/// tips are away from the rest; branches that are only noise run beside it.
class Pruner {
public:
  Pruner(const Skeleton& whole, double branch_min)
      : whole_(whole),
        sorted_(whole.nodes),
        branch_min_(branch_min),
        below_(whole.nodes.size(), 0),
        next_(whole.nodes.size(), no_index),
        kept_(whole.nodes.size()) {
    // Children come after their parents, so everything below a node is known before the node.
    for (std::size_t node = whole.nodes.size(); node-- > 1;) {
      const std::size_t parent = whole.parents[node];
      if (next_[parent] != no_index && through(node) <= below_[parent]) continue;
      below_[parent] = through(node);
      next_[parent] = node;
    }
  }

  Skeleton pruned() {
    keep(0);
    // A branch starts from a longer one.
    for (const std::size_t node : branches()) {
      if (kept_[whole_.parents[node]] && is_apart(tip_of(node))) keep(node);
    }
    Skeleton result;
    std::vector<std::size_t> new_index(whole_.nodes.size());
    for (std::size_t node = 0; node < whole_.nodes.size(); ++node) {
      if (!kept_[node]) continue;
      new_index[node] = result.nodes.size();
      result.nodes.push_back(whole_.nodes[node]);
      result.parents.push_back(new_index[whole_.parents[node]]);
    }
    return result;
  }

  /// The nodes from which more than one long path goes down, ascending.
  std::vector<std::size_t> forks() const {
    std::vector<std::size_t> result;
    for (const std::size_t node : branches()) {
      const std::size_t fork = whole_.parents[node];
      // The other path must be long too.
      if (below_[fork] >= branch_min_) result.push_back(fork);
    }
    std::ranges::sort(result);
    return result;
  }

private:
  // The longest path down from the node's parent through the node, m.
  double through(std::size_t node) const {
    return below_[node] + (whole_.nodes[node] - whole_.nodes[whole_.parents[node]]).norm();
  }

  // The first nodes of the branches that are long enough, longest first.
  std::vector<std::size_t> branches() const {
    std::vector<std::size_t> result;
    for (std::size_t node = 1; node < whole_.nodes.size(); ++node) {
      if (next_[whole_.parents[node]] != node && through(node) >= branch_min_) result.push_back(node);
    }
    std::ranges::stable_sort(result, std::greater<>(), [&](std::size_t node) { return through(node); });
    return result;
  }

  std::size_t tip_of(std::size_t node) const {
    while (next_[node] != no_index) node = next_[node];
    return node;
  }

  bool is_apart(std::size_t tip) const {
    return !sorted_.any_within(branch_min_, whole_.nodes[tip], [&](std::size_t node) { return kept_[node]; });
  }

  // Keeps the longest path from a node down to a tip.
  void keep(std::size_t node) {
    for (; node != no_index; node = next_[node]) kept_[node] = true;
  }

  const Skeleton& whole_;
  SortedNodes sorted_;
  double branch_min_;
  std::vector<double> below_;      // m, the longest path down from each node
  std::vector<std::size_t> next_;  // first node of that path; no_index at a tip
  std::vector<bool> kept_;
};

/// The votes of a set of voxels.
struct Votes {
  double count = 0;
  Vector3d mean = Vector3d::Zero();       // m
  Vector3d normal = Vector3d::Zero();     // unit, along the mean of their normals
  double parallelism = 0;                 // length of that mean
  Vector3d deviation = Vector3d::Zero();  // m, along their principal axes, the least first
};

Votes votes_in(const std::vector<Voxel>& grid, const std::vector<std::size_t>& voxels) {
  Votes votes;
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (const std::size_t i : voxels) {
    const auto count = static_cast<double>(grid[i].points);
    const Vector3d mean = grid[i].mean();
    votes.count += count;
    votes.mean += count * mean;
    votes.normal += grid[i].normals;
    products += count * mean * mean.transpose();
  }
  votes.mean /= votes.count;
  votes.normal /= votes.count;
  votes.parallelism = votes.normal.norm();
  votes.normal.normalize();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      products / votes.count - votes.mean * votes.mean.transpose(), Eigen::EigenvaluesOnly);
  votes.deviation = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  return votes;
}

/// Finds flat ends of tubes that are seen face-on. Their votes, one radius inside, are a disc.
class FaceFinder {
public:
  FaceFinder(const VoxelGrid& grid, double radius) : grid_(grid), radius_(radius) {}

  std::optional<Skeleton> face(const std::vector<std::size_t>& voxels) const {
    constexpr std::size_t most = 200;  // a disc has fewer by far
    if (radius_ <= 0 || voxels.size() > most) return std::nullopt;
    const Votes votes = votes_in(grid_.voxels, voxels);
    if (!is_disc(votes) || goes_on(votes)) return std::nullopt;
    return Skeleton{.points = {},
                    .nodes = {votes.mean + radius_ * votes.normal, votes.mean},
                    .parents = {0, 0},
                    .is_face = true};
  }

private:
  // Those of all else are on lines, or are parts of something larger.
  bool is_disc(const Votes& votes) const {
    constexpr double parallel_min = 0.97;
    constexpr double breadth_min = 0.25;  // radii, as a standard deviation; of a whole disc it is 0.5
    constexpr double breadth_max = 0.55;
    return votes.parallelism > parallel_min && votes.deviation[1] > breadth_min * radius_ &&
           votes.deviation[2] < breadth_max * radius_;
  }

  // Whether the plane of a disc goes on beyond its rim.
  bool goes_on(const Votes& disc) const {
    constexpr double share_max = 0.2;  // of the disc's votes
    constexpr double reach = 2.2;      // radii
    const Vector3i middle = grid_.key_at(disc.mean);
    const int steps = static_cast<int>(std::ceil(reach * radius_ / grid_.size));
    double beyond = 0;
    for (int x = -steps; x <= steps; ++x) {
      for (int y = -steps; y <= steps; ++y) {
        for (int z = -steps; z <= steps; ++z) {
          const std::size_t found = grid_.find(middle + Vector3i(x, y, z));
          if (found != no_index && is_beyond_rim(grid_.voxels[found], disc))
            beyond += static_cast<double>(grid_.voxels[found].points);
        }
      }
    }
    return beyond > share_max * disc.count;
  }

  bool is_beyond_rim(const Voxel& voxel, const Votes& disc) const {
    constexpr double rim = 1.1;  // radii
    constexpr double height_max = 0.3;
    constexpr double parallel_min = 0.95;
    const Vector3d way = voxel.mean() - disc.mean;
    const double height = way.dot(disc.normal);
    return std::abs(height) < height_max * radius_ && (way - height * disc.normal).norm() > rim * radius_ &&
           voxel.normals.dot(disc.normal) > parallel_min * static_cast<double>(voxel.points);
  }

  const VoxelGrid& grid_;
  double radius_;  // m
};

/// Cuts connected sets of voxels until each piece looks like a tube.
class Cutter {
public:
  Cutter(VoxelGrid& grid, double step, const CutSettings& settings)
      : grid_(grid),
        settings_(settings),
        maker_(grid.voxels, step),
        faces_(grid, settings.face_radius),
        seen_(grid.voxels.size()),
        skeleton_of_(grid.voxels.size(), no_index) {}

  void cut(const std::vector<std::size_t>& members) {
    std::vector<Part> parts;
    for (const std::vector<std::size_t>& component : connected_components(grid_.voxels, members, seen_))
      std::ranges::move(parts_of(without_weak(component, settings_.weak_max)), std::back_inserter(parts));
    parallel_max_ = parallel_max_of(parts);
    for (Part& part : parts) {
      if (part.is_tube || !take_faces(part)) take(std::move(part), 0);
    }
  }

  std::vector<Skeleton> skeletons() {
    for (std::size_t i = 0; i < grid_.of_points.size(); ++i) {
      if (grid_.of_points[i] == no_index) continue;
      const std::size_t skeleton = skeleton_of_[grid_.of_points[i]];
      if (skeleton != no_index) skeletons_[skeleton].points.push_back(i);
    }
    return std::move(skeletons_);
  }

private:
  /// A connected set of voxels.
  struct Part {
    std::vector<std::size_t> voxels;
    Skeleton whole;     // its tree
    Skeleton skeleton;  // without what is noise
    bool is_tube;       // looks like one
  };

  std::vector<Part> parts_of(const std::vector<std::size_t>& members) {
    std::vector<Part> parts;
    for (std::vector<std::size_t>& voxels : connected_components(grid_.voxels, members, seen_)) {
      Skeleton whole = maker_.tree(voxels);
      Skeleton skeleton = Pruner(whole, settings_.branch_min).pruned();
      const bool is_tube = looks_like_a_tube(skeleton, voxels);
      parts.push_back({std::move(voxels), std::move(whole), std::move(skeleton), is_tube});
    }
    return parts;
  }

  // A part that is left after this number of cuts: of weak voxels and of forks, by turns.
  void take(Part part, std::size_t cuts) {
    if (std::optional<Skeleton> face = faces_.face(part.voxels)) {
      add(part.voxels, *std::move(face));
    } else if (part.is_tube) {
      if (cuts > 0 && parallelism(part.voxels) >= parallel_max_) return;
      add(part.voxels, std::move(part.skeleton));
    } else if (cuts < 2 * weak_shares.size()) {
      const bool is_weak_next = cuts % 2 == 0;
      for (Part& rest : parts_of(is_weak_next ? without_weak(part.voxels, weak_shares[cuts / 2])
                                              : without_forks(part.voxels, part.whole)))
        take(std::move(rest), cuts + 1);
    }
  }

  // Takes the flat ends in a part, whose votes hang together with those of the tube's side, and what is left
  // without them. Returns false if there are none.
  bool take_faces(const Part& part) {
    constexpr double parallel_min = 0.95;
    std::vector<std::size_t> flat;
    std::ranges::copy_if(part.voxels, std::back_inserter(flat), [&](std::size_t voxel) {
      return grid_.voxels[voxel].normals.norm() >
             parallel_min * static_cast<double>(grid_.voxels[voxel].points);
    });
    std::vector<std::size_t> taken;
    for (const std::vector<std::size_t>& piece : connected_components(grid_.voxels, flat, seen_)) {
      std::optional<Skeleton> face = faces_.face(piece);
      if (!face) continue;
      add(piece, *std::move(face));
      taken.insert(taken.end(), piece.begin(), piece.end());
    }
    if (taken.empty()) return false;
    std::ranges::sort(taken);
    for (Part& rest : parts_of(without(
             part.voxels, [&](std::size_t voxel) { return std::ranges::binary_search(taken, voxel); })))
      take(std::move(rest), 0);
    return true;
  }

  void add(const std::vector<std::size_t>& voxels, Skeleton skeleton) {
    for (const std::size_t voxel : voxels) skeleton_of_[voxel] = skeletons_.size();
    skeletons_.push_back(std::move(skeleton));
  }

  // Nearly all votes are near the skeleton, which has branches only if tubes have.
  bool looks_like_a_tube(const Skeleton& skeleton, const std::vector<std::size_t>& component) const {
    if (!settings_.may_branch && has_branches(skeleton)) return false;
    const SortedNodes nodes(skeleton.nodes);
    std::size_t near = 0;
    std::size_t all = 0;
    for (const std::size_t member : component) {
      const Voxel& voxel = grid_.voxels[member];
      all += voxel.points;
      if (nodes.any_within(settings_.spread_max, voxel.mean(), [](std::size_t) { return true; }))
        near += voxel.points;
    }
    return static_cast<double>(near) >= settings_.share_min * static_cast<double>(all);
  }

  // How alike the normals are that lead to one place: 1 on a plane, less on a tube, which is seen from more
  // than one side.
  double parallelism(const std::vector<std::size_t>& voxels) const {
    double sum = 0;
    double votes = 0;
    for (const std::size_t voxel : voxels) {
      sum += grid_.voxels[voxel].normals.norm();
      votes += static_cast<double>(grid_.voxels[voxel].points);
    }
    return sum / votes;
  }

  // Where a tube has few pixels across, it looks flatter. So the parts that look like tubes as they are say
  // what tubes look like here, unless those are planes themselves, as with a wrong radius.
  double parallel_max_of(const std::vector<Part>& parts) const {
    std::vector<std::size_t> of_tubes;
    for (const Part& part : parts) {
      if (part.is_tube) of_tubes.insert(of_tubes.end(), part.voxels.begin(), part.voxels.end());
    }
    constexpr double share = 0.25;
    constexpr double of_a_plane = 0.99;
    const double typical = of_tubes.empty() ? of_a_plane : parallelism(of_tubes);
    if (typical >= of_a_plane) return settings_.parallel_max;
    return std::max(settings_.parallel_max, 1 - share * (1 - typical));
  }

  static bool has_branches(const Skeleton& skeleton) {
    std::vector<int> children(skeleton.nodes.size());
    for (std::size_t node = 1; node < skeleton.nodes.size(); ++node) ++children[skeleton.parents[node]];
    for (std::size_t node = 0; node < children.size(); ++node) {
      if (children[node] > (node == 0 ? 2 : 1)) return true;
    }
    return false;
  }

  // Without the voxels that have fewer votes than this share of the median.
  std::vector<std::size_t> without_weak(const std::vector<std::size_t>& component, double share) {
    const double least = share * median_of_votes(component);
    return without(component, [&](std::size_t voxel) {
      return static_cast<double>(grid_.voxels[voxel].points) < least;
    });
  }

  // Without the voxels where long branches of the tree part.
  std::vector<std::size_t> without_forks(const std::vector<std::size_t>& component, const Skeleton& whole) {
    const std::vector<std::size_t> forks = Pruner(whole, settings_.branch_min).forks();
    return without(component, [&](std::size_t voxel) {
      return std::ranges::binary_search(forks, maker_.node_of(voxel));
    });
  }

  template <typename Goes>
  std::vector<std::size_t> without(const std::vector<std::size_t>& component, const Goes& goes) {
    std::vector<std::size_t> rest;
    for (const std::size_t voxel : component) {
      if (goes(voxel)) {
        isolate(grid_.voxels, voxel);
      } else {
        rest.push_back(voxel);
      }
    }
    return rest;
  }

  // Of the votes, each with the number of votes in its voxel.
  double median_of_votes(const std::vector<std::size_t>& component) const {
    std::vector<std::pair<double, std::size_t>> votes;
    votes.reserve(component.size());
    for (const std::size_t voxel : component) {
      const std::size_t count = grid_.voxels[voxel].points;
      votes.emplace_back(static_cast<double>(count), count);
    }
    return weighted_median(std::move(votes));
  }

  static constexpr std::array weak_shares = {0.125, 0.25, 0.5};  // of the median number of votes

  VoxelGrid& grid_;
  const CutSettings& settings_;
  TreeMaker maker_;
  FaceFinder faces_;
  double parallel_max_ = 1;
  std::vector<bool> seen_;
  std::vector<std::size_t> skeleton_of_;  // of each voxel; no_index if it is in none
  std::vector<Skeleton> skeletons_;
};

std::vector<std::size_t> all_of(const VoxelGrid& grid) {
  std::vector<std::size_t> all(grid.voxels.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

}  // namespace

std::vector<Skeleton> find_skeletons(const std::vector<Eigen::Vector3f>& points, double voxel, double step,
                                     double branch_min) {
  return find_skeletons(points, {}, voxel, step,
                        {.branch_min = branch_min,
                         .spread_max = infinity,
                         .share_min = 0,
                         .weak_max = 0,
                         .parallel_max = 1,
                         .may_branch = true});
}

std::vector<Skeleton> find_skeletons(const std::vector<Eigen::Vector3f>& points,
                                     const std::vector<Eigen::Vector3f>& normals, double voxel, double step,
                                     const CutSettings& settings) {
  VoxelGrid grid = fill_voxels(points, normals, voxel, settings.shift);
  Cutter cutter(grid, step, settings);
  cutter.cut(all_of(grid));
  return cutter.skeletons();
}

}  // namespace tanglebin
