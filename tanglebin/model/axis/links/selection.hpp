#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/model/axis/links/link_candidates.hpp"

// Internal to the room.
namespace tanglebin {

/// A set of links in which no two share an end and every tube is possible. What was changed can be undone.
class Selection {
public:
  /// Shape costs already computed, keyed by Part::links.
  using Costs = std::unordered_map<std::uint64_t, double>;

  /// Without links.
  Selection(const LinkCandidates& candidates, Costs& costs);

  /// Takes a link, whose ends must be free, if the resulting tube is possible and likelier than its two
  /// parts. Returns true if it did.
  bool take(std::size_t link);

  /// Takes as many of these links as possible, in order.
  void take_possible(const std::vector<std::size_t>& links);

  /// What was a tube, or two, before it was given up.
  struct Released {
    std::vector<std::size_t> fragments;  ///< ascending
    std::vector<std::size_t> links;      ///< heaviest first
  };

  /// Gives up the tubes that a link would join.
  Released release_tubes_of(std::size_t link);

  bool has_free_ends(std::size_t link) const {
    const WeightedPair& pair = candidates_->pairs[link];
    const bool first_is_free = links_at_[pair.first] == no_index;
    const bool second_is_free = links_at_[pair.second] == no_index;
    return first_is_free && second_is_free;
  }

  /// Whether a tube is represented by this fragment.
  bool represents(std::size_t fragment) const { return places_[fragment].tube == fragment; }

  /// Of the tube that a fragment is part of.
  double cost_of_tube(std::size_t fragment) const { return places_[places_[fragment].tube].part.cost; }

  /// All links, heaviest first.
  std::vector<std::size_t> taken() const;

  /// The sum of the links' weights, less the costs of the tubes: log odds. What is taken and released changes
  /// it, so that rounding adds up, until it is summed anew.
  double weight() const { return weight_; }
  void sum_weight_anew();

  /// A state to go back to.
  struct Mark {
    std::size_t places;    ///< changed so far
    std::size_t vertices;  ///< changed so far
    double weight;         ///< log odds
  };

  Mark mark() const { return {changed_places_.size(), changed_vertices_.size(), weight_}; }
  void undo_to(const Mark& mark);

private:
  /// Where a fragment is.
  struct Place {
    std::size_t tube;  // the fragment that represents its tube
    std::size_t next;  // fragment of this tube, in a circle
    Part part;         // the tube, if the fragment represents it
  };

  std::pair<std::size_t, std::size_t> tubes_of(std::size_t link) const;
  std::vector<std::size_t> members_of(std::size_t tube) const;
  std::vector<std::size_t> links_of(const std::vector<std::size_t>& fragments) const;
  Part joined(std::size_t first, std::size_t second, std::size_t link) const;
  double hidden_beyond(const Link& link) const;
  double cost_of_shape(const Part& tube, std::size_t first, std::size_t second, std::size_t link);
  void join(std::size_t first, std::size_t second, const Part& tube);
  Place& change(std::size_t fragment);
  void use_ends_of(std::size_t link, std::size_t by);

  const LinkCandidates* candidates_;
  Costs* costs_;
  std::vector<Place> places_;          // of each fragment
  std::vector<std::size_t> links_at_;  // for each vertex, the link that uses it, or no_index
  double weight_ = 0;
  std::vector<std::pair<std::size_t, Place>> changed_places_;          // what was there before
  std::vector<std::pair<std::size_t, std::size_t>> changed_vertices_;  // the same
};

}  // namespace tanglebin
