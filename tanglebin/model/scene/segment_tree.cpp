#include "tanglebin/model/scene/segment_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <compare>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

// The time that misfit() takes doubles with each.
constexpr int most_at_a_node = 12;

/// A node, with the neighbour through which it was reached.
struct Arrival {
  int at;
  int from;

  // NOLINTNEXTLINE(modernize-use-nullptr): a false alarm of clang-tidy 14
  auto operator<=>(const Arrival&) const = default;
};
constexpr int nowhere = -1;

/// A segment as seen from one of its nodes.
struct Branch {
  int to;
  double length;  // m
};
using Branches = std::vector<Branch>;

std::map<int, Branches> branches_of(const SegmentTree& tree) {
  std::map<int, Branches> branches;
  for (const auto& [from, to, length] : tree) {
    branches[from].push_back({to, length});
    branches[to].push_back({from, length});
  }
  return branches;
}

bool is_junction(const Branches& branches) {
  return branches.size() > 2;
}

/// A tree with its branches by their nodes.
class Tree {
public:
  explicit Tree(const SegmentTree& segments) : branches_(branches_of(segments)) {}

  const std::map<int, Branches>& nodes() const { return branches_; }

  /// The branches of a node, except the one that leads back.
  Branches onward(const Arrival& node) const {
    Branches result;
    std::ranges::copy_if(branches_.at(node.at), std::back_inserter(result),
                         [&](const Branch& branch) { return branch.to != node.from; });
    return result;
  }

  /// The length of a branch and everything beyond it, m.
  double length(int from, const Branch& branch) const {
    double sum = branch.length;
    for (const Branch& next : onward({branch.to, from})) sum += length(branch.to, next);
    return sum;
  }

  /// The distance from a node to the farthest end along a branch, m.
  double reach(int from, const Branch& branch) const {
    double farthest = 0;
    for (const Branch& next : onward({branch.to, from}))
      farthest = std::max(farthest, reach(branch.to, next));
    return branch.length + farthest;
  }

  /// The longest distance between two ends, m.
  double longest_path() const {
    double longest = 0;
    for (const auto& [node, branches] : branches_) {
      for (const Branch& branch : branches) longest = std::max(longest, reach(node, branch));
    }
    return longest;
  }

private:
  std::map<int, Branches> branches_;
};

/// Lays the visible part of a tree on the known tree in every way, and returns the least misfit.
class Overlay {
public:
  Overlay(const SegmentTree& seen, const SegmentTree& known)
      : seen_(seen), known_(known), seen_length_(total_length(seen)) {}

  double misfit() {
    double best = of_path();
    for (const auto& [node, branches] : seen_.nodes()) {
      if (!is_junction(branches)) continue;
      for (const auto& [junction, directions] : known_.nodes()) {
        if (is_junction(directions)) best = std::min(best, of_branches({node, nowhere}, {junction, nowhere}));
      }
    }
    return best;
  }

private:
  // If only a path is visible: lays it on the known tree's longest path.
  double of_path() const {
    const double path = seen_.longest_path();
    return std::max(0.0, path - known_.longest_path()) + seen_length_ - path;
  }

  // The node is this junction. Each of its branches takes a different direction, or is not part of the known
  // tree.
  double of_branches(const Arrival& node, const Arrival& junction) {
    const auto known = of_branches_.find({node, junction});
    if (known != of_branches_.end()) return known->second;
    const Branches directions = known_.onward(junction);
    // The least misfit of the branches so far, indexed by the set of directions that they take, one bit each.
    using Sums = boost::container::small_vector<double, 8>;
    const std::size_t subsets = std::size_t{1} << directions.size();
    Sums least(subsets, infinity);
    least[0] = 0;
    for (const Branch& branch : seen_.onward(node)) {
      Sums next = least;
      for (double& sum : next) sum += seen_.length(node.at, branch);
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const std::size_t direction = std::size_t{1} << i;
        const double here = of_branch(node.at, branch, 0, junction.at, directions[i]);
        for (std::size_t others = 0; others < subsets; ++others) {
          if ((others & direction) != 0) continue;
          double& sum = next[others | direction];
          sum = std::min(sum, least[others] + here);
        }
      }
      least = std::move(next);
    }
    return of_branches_[{node, junction}] = std::ranges::min(least);
  }

  // The branch takes this direction from the junction, after `way` m on which branches left that the known
  // tree does not have.
  double of_branch(int node, const Branch& branch, double way, int junction, const Branch& direction) {
    way += branch.length;
    const Arrival next{branch.to, node};
    const Branches onward = seen_.onward(next);
    if (onward.empty()) return std::max(0.0, way - known_.reach(junction, direction));
    double best = of_junction(next, way, junction, direction);
    double all = 0;
    for (const Branch& other : onward) all += seen_.length(next.at, other);
    for (const Branch& stem : onward) {
      const double others = all - seen_.length(next.at, stem);
      if (others >= best) continue;
      best = std::min(best, others + of_branch(next.at, stem, way, junction, direction));
    }
    return best;
  }

  // The node is one of the junctions in that direction, `way` m away.
  double of_junction(const Arrival& node, double way, int junction, const Branch& direction) {
    const Arrival next{direction.to, junction};
    const Branches directions = known_.onward(next);
    if (directions.empty()) return infinity;
    way -= direction.length;
    double best = std::abs(way) + of_branches(node, next);
    for (const Branch& farther : directions) best = std::min(best, of_junction(node, way, next.at, farther));
    return best;
  }

  Tree seen_;
  Tree known_;
  double seen_length_;
  std::map<std::pair<Arrival, Arrival>, double> of_branches_;
};

}  // namespace

void validate(const SegmentTree& tree, const std::string& field) {
  const auto expect = [&](bool holds, const std::string& found, const std::string& expected) {
    if (!holds) throw InputError({"", 0, field}, found, expected);
  };
  expect(!tree.empty(), "none", "at least one segment");
  std::map<int, int> segments_at{{tree.front().from, 0}};
  for (const auto& [from, to, length] : tree) {
    expect(std::isfinite(length) && length > 0, fmt::format("{} m from node {} to {}", length, from, to),
           "a positive number");
    expect(segments_at.contains(from), fmt::format("a segment from node {}", from),
           "one that starts at a node of an earlier segment");
    expect(!segments_at.contains(to), fmt::format("a segment to node {}, which closes a loop", to),
           "one that ends at a new node");
    segments_at[to] = 1;
    expect(++segments_at[from] <= most_at_a_node, fmt::format("more segments at node {}", from),
           fmt::format("at most {}", most_at_a_node));
  }
}

double total_length(const SegmentTree& tree) {
  double sum = 0;
  for (const Segment& segment : tree) sum += segment.length;
  return sum;
}

int count_ends(const SegmentTree& tree) {
  return static_cast<int>(
      std::ranges::count_if(branches_of(tree), [](const auto& node) { return node.second.size() == 1; }));
}

double misfit(const SegmentTree& seen, const SegmentTree& known) {
  return Overlay(seen, known).misfit();
}

}  // namespace tanglebin
