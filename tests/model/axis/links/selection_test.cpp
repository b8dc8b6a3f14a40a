#include "tanglebin/model/axis/links/selection.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/model/axis/fragments/straight_fragment.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

// Short pieces that lie about, of chains or of trees, and links between all of them.
struct Heap {
  TubeKind kind;
  LinkSettings settings{};
  std::vector<Fragment> fragments;
  RangeImage seen{{}, camera_preset("paper")};
  std::vector<Link> links;

  Heap() {
    if (*rc::gen::arbitrary<bool>())
      kind.segments = {{1, 2, 0.1}, {1, 3, 0.1}, {1, 4, 0.1}};
    else
      kind.segments = {{1, 2, 0.3}};
    const int count = *rc::gen::inRange(2, 12);
    const auto coordinate = rc::gen::inRange(-8, 9);
    for (int i = 0; i < count; ++i) {
      const Vector3d from = Vector3d(*coordinate, *coordinate, 5) / 100;
      const double angle = 0.4 * *coordinate;
      fragments.push_back(
          test::straight_fragment(from, from + 0.06 * Vector3d(std::cos(angle), std::sin(angle), 0)));
    }
    links = find_links(fragments, seen, kind, settings);
  }
};

/// What a selection says of itself.
struct State {
  std::vector<std::size_t> taken;
  std::vector<double> costs;  // of each fragment's tube
  double weight;

  State(const Selection& selection, std::size_t fragments)
      : taken(selection.taken()), weight(selection.weight()) {
    for (std::size_t i = 0; i < fragments; ++i) costs.push_back(selection.cost_of_tube(i));
  }

  bool operator==(const State&) const = default;
};

void expect_consistent(const Selection& selection, const LinkCandidates& candidates) {
  std::set<std::size_t> used;
  double weight = 0;
  for (const std::size_t link : selection.taken()) {
    const auto& [first, second, its_weight] = candidates.pairs[link];
    RC_ASSERT(used.insert(first).second && used.insert(second).second);
    RC_ASSERT(!selection.has_free_ends(link));
    weight += its_weight;
  }
  for (std::size_t i = 0; i < candidates.fragments.size(); ++i) {
    if (selection.represents(i)) weight -= selection.cost_of_tube(i);
  }
  RC_ASSERT(std::abs(selection.weight() - weight) < 1e-9);
}

RC_GTEST_PROP(Selection, UndoesWhateverWasTakenAndReleased, ()) {
  const Heap heap;
  const LinkCandidates candidates(heap.fragments, heap.links, heap.kind, heap.settings, heap.seen);
  Selection::Costs costs;
  Selection selection(candidates, costs);
  RC_PRE(!heap.links.empty());
  const auto any_link = rc::gen::inRange(std::size_t{0}, heap.links.size());
  std::vector<std::pair<Selection::Mark, State>> marks;
  for (int step = 0; step < 20; ++step) {
    marks.emplace_back(selection.mark(), State(selection, heap.fragments.size()));
    const std::size_t link = *any_link;
    if (*rc::gen::arbitrary<bool>()) {
      if (selection.has_free_ends(link)) selection.take(link);
    } else {
      const Selection::Released released = selection.release_tubes_of(link);
      RC_ASSERT(std::ranges::is_sorted(released.fragments) && std::ranges::is_sorted(released.links));
      RC_ASSERT(selection.has_free_ends(link));
      for (const std::size_t i : released.links) RC_ASSERT(selection.has_free_ends(i));
      for (const std::size_t i : released.fragments) RC_ASSERT(selection.represents(i));
    }
    expect_consistent(selection, candidates);
    if (*rc::gen::inRange(0, 4) != 0) continue;
    const auto back = *rc::gen::inRange(std::size_t{0}, marks.size());
    selection.undo_to(marks[back].first);
    RC_ASSERT(State(selection, heap.fragments.size()) == marks[back].second);
    marks.erase(marks.begin() + static_cast<std::ptrdiff_t>(back), marks.end());
  }
}

}  // namespace
}  // namespace tanglebin
