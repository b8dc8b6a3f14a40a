#include "tanglebin/model/axis/links/selection.hpp"

#include <algorithm>
#include <iterator>

namespace tanglebin {
namespace {

std::vector<std::size_t> merged(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
  std::vector<std::size_t> all;
  all.reserve(a.size() + b.size());
  std::ranges::merge(a, b, std::back_inserter(all));
  return all;
}

std::vector<std::size_t> without_repeats(std::vector<std::size_t> links) {
  std::ranges::sort(links);
  links.erase(std::unique(links.begin(), links.end()), links.end());
  return links;
}

}  // namespace

Selection::Selection(const LinkCandidates& candidates, Costs& costs)
    : candidates_(&candidates), costs_(&costs), links_at_(candidates.vertices, no_index) {
  places_.reserve(candidates.fragments.size());
  for (std::size_t i = 0; i < candidates.fragments.size(); ++i)
    places_.push_back({i, i, candidates.alone[i]});
  sum_weight_anew();
}

bool Selection::take(std::size_t link) {
  const auto [first, second] = tubes_of(link);
  if (first == second) return false;
  Part tube = joined(first, second, link);
  if (tube.length > candidates_->tube_length_max || tube.ends > candidates_->tube_ends_max) return false;
  const double worth = candidates_->pairs[link].weight + cost_of_tube(first) + cost_of_tube(second);
  tube.cost = cost_of_length(*candidates_, tube);
  if (worth <= tube.cost) return false;  // whatever its shape costs
  if (has_shape_costs(*candidates_)) tube.cost += cost_of_shape(tube, first, second, link);
  if (worth <= tube.cost) return false;
  join(first, second, tube);
  use_ends_of(link, link);
  weight_ += worth - tube.cost;
  return true;
}

void Selection::take_possible(const std::vector<std::size_t>& links) {
  for (const std::size_t link : links) {
    if (has_free_ends(link)) take(link);  // usually false
  }
}

Selection::Released Selection::release_tubes_of(std::size_t link) {
  const auto [first, second] = tubes_of(link);
  Released released{members_of(first), {}};
  if (second != first) released.fragments = merged(released.fragments, members_of(second));
  released.links = links_of(released.fragments);
  for (const std::size_t i : released.links) {
    use_ends_of(i, no_index);
    weight_ -= candidates_->pairs[i].weight;
  }
  for (const std::size_t i : released.fragments) {
    if (represents(i)) weight_ += places_[i].part.cost;
    weight_ -= candidates_->alone[i].cost;
  }
  for (const std::size_t i : released.fragments) change(i) = {i, i, candidates_->alone[i]};
  return released;
}

std::vector<std::size_t> Selection::taken() const {
  std::vector<std::size_t> links;
  std::ranges::copy_if(links_at_, std::back_inserter(links), [](std::size_t i) { return i != no_index; });
  return without_repeats(std::move(links));
}

void Selection::sum_weight_anew() {
  weight_ = 0;
  for (const std::size_t i : taken()) weight_ += candidates_->pairs[i].weight;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (represents(i)) weight_ -= places_[i].part.cost;
  }
}

void Selection::undo_to(const Mark& mark) {
  for (; changed_places_.size() > mark.places; changed_places_.pop_back())
    places_[changed_places_.back().first] = changed_places_.back().second;
  for (; changed_vertices_.size() > mark.vertices; changed_vertices_.pop_back())
    links_at_[changed_vertices_.back().first] = changed_vertices_.back().second;
  weight_ = mark.weight;
}

// Each is represented by one of its fragments.
std::pair<std::size_t, std::size_t> Selection::tubes_of(std::size_t link) const {
  const auto& [first, second] = candidates_->fragments_of[link];
  return {places_[first].tube, places_[second].tube};
}

// Ascending.
std::vector<std::size_t> Selection::members_of(std::size_t tube) const {
  std::vector<std::size_t> members;
  std::size_t fragment = tube;
  do {
    members.push_back(fragment);
    fragment = places_[fragment].next;
  } while (fragment != tube);
  std::ranges::sort(members);
  return members;
}

// Of whole tubes, heaviest first.
std::vector<std::size_t> Selection::links_of(const std::vector<std::size_t>& fragments) const {
  std::vector<std::size_t> links;
  for (const std::size_t fragment : fragments) {
    const std::size_t first = candidates_->ends_before[fragment];
    for (std::size_t end = first; end < candidates_->ends_before[fragment + 1]; ++end) {
      if (links_at_[end] != no_index) links.push_back(links_at_[end]);
    }
  }
  return without_repeats(std::move(links));
}

Part Selection::joined(std::size_t first, std::size_t second, std::size_t link) const {
  const Part& a = places_[first].part;
  const Part& b = places_[second].part;
  const Link& its = candidates_->links[link];
  return {.length = a.length + its.gap + b.length,
          .ends = a.ends + b.ends - ends_taken(its.kind),
          .links = a.links + b.links + candidates_->numbers[link],
          .hidden = a.hidden + b.hidden - hidden_beyond(its),
          .cost = 0};
}

// Beyond the ends that a link takes, m.
double Selection::hidden_beyond(const Link& link) const {
  const std::vector<Fragment>& fragments = candidates_->fragments;
  const double from = fragments[link.fragment].ends[link.end].hidden;
  return ends_taken(link.kind) == 1 ? from : from + fragments[link.to.fragment].ends[*link.to.end].hidden;
}

double Selection::cost_of_shape(const Part& tube, std::size_t first, std::size_t second, std::size_t link) {
  const auto weighed = costs_->find(tube.links);
  if (weighed != costs_->end()) return weighed->second;
  const std::vector<std::size_t> fragments = merged(members_of(first), members_of(second));
  std::vector<std::size_t> chosen = links_of(fragments);
  chosen.insert(std::ranges::upper_bound(chosen, link), link);
  return (*costs_)[tube.links] = shape_cost(*candidates_, fragments, chosen);
}

// Makes two tubes one.
void Selection::join(std::size_t first, std::size_t second, const Part& tube) {
  for (const std::size_t fragment : members_of(second)) change(fragment).tube = first;
  Place& of_first = change(first);
  of_first.part = tube;
  std::swap(of_first.next, places_[second].next);
}

// To be changed.
Selection::Place& Selection::change(std::size_t fragment) {
  changed_places_.emplace_back(fragment, places_[fragment]);
  return places_[fragment];
}

void Selection::use_ends_of(std::size_t link, std::size_t by) {
  for (const std::size_t vertex : {candidates_->pairs[link].first, candidates_->pairs[link].second}) {
    changed_vertices_.emplace_back(vertex, links_at_[vertex]);
    links_at_[vertex] = by;
  }
}

}  // namespace tanglebin
