#include "tanglebin/model/segment_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

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

  /// Those of a node but the one that leads back.
  Branches onward(int node, int from) const {
    Branches result;
    std::ranges::copy_if(branches_.at(node), std::back_inserter(result),
                         [&](const Branch& branch) { return branch.to != from; });
    return result;
  }

  /// m, of a branch and all beyond it.
  double length(int from, const Branch& branch) const {
    double sum = branch.length;
    for (const Branch& next : onward(branch.to, from)) sum += length(branch.to, next);
    return sum;
  }

  /// m, from a node to the farthest end along a branch.
  double reach(int from, const Branch& branch) const {
    double farthest = 0;
    for (const Branch& next : onward(branch.to, from)) farthest = std::max(farthest, reach(branch.to, next));
    return branch.length + farthest;
  }

  /// m, from one end to the farthest other.
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

/// Lays what is seen of a tree on the known one, each way, and gives the misfit of the best.
class Overlay {
public:
  Overlay(const SegmentTree& seen, const SegmentTree& known)
      : seen_(seen), known_(known), seen_length_(total_length(seen)) {}

  double misfit() const {
    double best = of_path();
    for (const auto& [node, branches] : seen_.nodes()) {
      if (!is_junction(branches)) continue;
      for (const auto& [junction, directions] : known_.nodes()) {
        if (is_junction(directions)) best = std::min(best, of_branches(node, branches, junction, directions));
      }
    }
    return best;
  }

private:
  // Where only the longest path is seen of the known tree, on its longest one.
  double of_path() const {
    const double path = seen_.longest_path();
    return std::max(0.0, path - known_.longest_path()) + seen_length_ - path;
  }

  // The node is the junction: the last of its branches goes one of these directions, or is none of the known
  // tree; then the others.
  double of_branches(int node, Branches branches, int junction, const Branches& directions) const {
    if (branches.empty()) return 0;
    const Branch branch = branches.back();
    branches.pop_back();
    double best = seen_.length(node, branch) + of_branches(node, branches, junction, directions);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double here = of_branch(node, branch, 0, junction, directions[i]);
      if (here >= best) continue;
      Branches rest = directions;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
      best = std::min(best, here + of_branches(node, branches, junction, rest));
    }
    return best;
  }

  // A branch that goes a direction from the junction, after `way` m on which others left that are none of
  // the known tree.
  double of_branch(int node, const Branch& branch, double way, int junction, const Branch& direction) const {
    way += branch.length;
    const Branches onward = seen_.onward(branch.to, node);
    if (onward.empty()) return std::max(0.0, way - known_.reach(junction, direction));
    double best = of_junction(branch.to, onward, way, junction, direction);
    double all = 0;
    for (const Branch& next : onward) all += seen_.length(branch.to, next);
    for (const Branch& next : onward) {
      const double others = all - seen_.length(branch.to, next);
      if (others >= best) continue;
      best = std::min(best, others + of_branch(branch.to, next, way, junction, direction));
    }
    return best;
  }

  // The node is one of the junctions in that direction, `way` m from this one.
  double of_junction(int node, const Branches& branches, double way, int junction,
                     const Branch& direction) const {
    double best = std::numeric_limits<double>::infinity();
    const Branches directions = known_.onward(direction.to, junction);
    if (directions.empty()) return best;
    way -= direction.length;
    best = std::abs(way) + of_branches(node, branches, direction.to, directions);
    for (const Branch& next : directions)
      best = std::min(best, of_junction(node, branches, way, direction.to, next));
    return best;
  }

  Tree seen_;
  Tree known_;
  double seen_length_;
};

}  // namespace

void validate(const SegmentTree& tree, const std::string& field) {
  const auto expect = [&](bool holds, const std::string& found, const std::string& expected) {
    if (!holds) throw InputError({"", 0, field}, found, expected);
  };
  expect(!tree.empty(), "none", "at least one segment");
  std::set<int> reached{tree.front().from};
  for (const auto& [from, to, length] : tree) {
    expect(std::isfinite(length) && length > 0, fmt::format("{} m from node {} to {}", length, from, to),
           "a positive number");
    expect(reached.contains(from), fmt::format("a segment from node {}", from),
           "one from a node of an earlier segment");
    expect(reached.insert(to).second, fmt::format("a segment to node {}, which closes a loop", to),
           "one to a new node");
  }
}

double total_length(const SegmentTree& tree) {
  double sum = 0;
  for (const TreeSegment& segment : tree) sum += segment.length;
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
