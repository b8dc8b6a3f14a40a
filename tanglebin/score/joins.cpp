#include "tanglebin/score/joins.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace tanglebin {
namespace {

// m; distances along a tube that differ by less are equal
constexpr double rounding = 1e-9;

// An edge of a modelled tube that lies on a true tube: the places there that are nearest to its ends and
// middle.
struct Piece {
  std::size_t tube;  // the modelled tube
  std::size_t edge;
  Place from;
  Place middle;
  Place to;
  double length;    // m, along the true tube
  double distance;  // m, from the true tube, of the farthest of the three
};

using Pieces = std::vector<Piece>;

// The position of an edge on a true tube, if it is within the tube's radius.
std::optional<Piece> place_edge(const CentreLine& line, const Capsule& edge) {
  const Eigen::Vector3d middle = (edge.a + edge.b) / 2;
  if (line.is_surely_beyond(line.radius(), middle)) return {};
  const CentreLine::Nearest at_middle = line.nearest(middle);
  if (at_middle.distance > line.radius()) return {};
  const CentreLine::Nearest at_a = line.nearest(edge.a);
  const CentreLine::Nearest at_b = line.nearest(edge.b);
  const double distance = std::max({at_a.distance, at_middle.distance, at_b.distance});
  if (distance > line.radius()) return {};
  return Piece{.tube = 0,
               .edge = 0,
               .from = at_a.place,
               .middle = at_middle.place,
               .to = at_b.place,
               .length = line.way(at_a.place, at_b.place),
               .distance = distance};
}

// The edges on each true tube. An edge that lies on several tubes counts for the nearest.
std::vector<Pieces> edges_on(const std::vector<CentreLine>& truth, const std::vector<Tube>& modelled) {
  std::vector<Pieces> on(truth.size());
  for (std::size_t tube = 0; tube < modelled.size(); ++tube) {
    const std::vector<Capsule> axes = capsules(modelled[tube]);
    for (std::size_t edge = 0; edge < axes.size(); ++edge) {
      std::optional<Piece> nearest;
      std::size_t line = 0;
      for (std::size_t i = 0; i < truth.size(); ++i) {
        const std::optional<Piece> piece = place_edge(truth[i], axes[edge]);
        if (!piece || (nearest && piece->distance >= nearest->distance)) continue;
        nearest = piece;
        line = i;
      }
      if (!nearest) continue;
      nearest->tube = tube;
      nearest->edge = edge;
      on[line].push_back(*nearest);
    }
  }
  return on;
}

bool is_on_way(const CentreLine& line, const Place& place, const Piece& piece) {
  return line.way(piece.from, place) + line.way(place, piece.to) <= piece.length + rounding;
}

// Drops pieces that lie beside a longer one over their whole length: a second fit to the same part of a tube,
// or an edge that leads back from the end of one cylinder to the beginning of the next where the two overlap.
Pieces without_repetition(const CentreLine& line, Pieces pieces) {
  // Of pieces that are equally long, such as those beyond the tube's end, the nearest to it is kept.
  std::ranges::stable_sort(pieces, {},
                           [](const Piece& piece) { return std::pair(-piece.length, piece.distance); });
  Pieces kept;
  for (const Piece& piece : pieces) {
    const bool repeats = std::ranges::any_of(kept, [&](const Piece& longer) {
      return is_on_way(line, piece.from, longer) && is_on_way(line, piece.to, longer);
    });
    if (!repeats) kept.push_back(piece);
  }
  return kept;
}

// Two pieces by index, the lower one first.
using Join = std::pair<std::size_t, std::size_t>;

struct Neighbour {
  double way;  // m, along the true tube from middle to middle
  std::size_t piece;
};

// The neighbours of a piece on its true tube. No other piece has its middle between theirs.
std::vector<Neighbour> neighbours(const CentreLine& line, const Pieces& pieces, std::size_t piece) {
  std::vector<Neighbour> others;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (i != piece) others.push_back({line.way(pieces[piece].middle, pieces[i].middle), i});
  }
  // From near to far, so that a piece in between is already known.
  std::ranges::sort(others, {}, &Neighbour::way);
  std::vector<Neighbour> found;
  for (const Neighbour& other : others) {
    const bool is_behind = std::ranges::any_of(found, [&](const Neighbour& nearer) {
      const double rest = line.way(pieces[nearer.piece].middle, pieces[other.piece].middle);
      return nearer.way > rounding && rest > rounding && nearer.way + rest <= other.way + rounding;
    });
    if (!is_behind) found.push_back(other);
  }
  return found;
}

// Pairs of neighbouring pieces on one true tube. Piece indices start at `first`.
void add_true_joins(std::vector<Join>& joins, const CentreLine& line, const Pieces& pieces,
                    std::size_t first) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const Neighbour& neighbour : neighbours(line, pieces, i)) {
      if (i < neighbour.piece) joins.emplace_back(first + i, first + neighbour.piece);
    }
  }
}

// Pairs of pieces that a modelled tube joins: they meet at a node, or would if all edges between them that
// are not pieces shrank to nothing.
void add_modelled_joins(std::vector<Join>& joins, const Tube& tube,
                        const std::map<std::size_t, std::size_t>& piece_of_edge) {
  boost::disjoint_sets_with_storage<> shrunk(tube.nodes.size());
  for (std::size_t i = 0; i < tube.edges.size(); ++i) {
    if (!piece_of_edge.contains(i)) shrunk.union_set(tube.edges[i].from, tube.edges[i].to);
  }
  std::map<std::size_t, std::vector<std::size_t>> pieces_at;
  for (const auto& [edge, piece] : piece_of_edge) {
    for (const std::size_t node : {tube.edges[edge].from, tube.edges[edge].to}) {
      std::vector<std::size_t>& others = pieces_at[shrunk.find_set(node)];
      for (const std::size_t other : others) joins.emplace_back(std::minmax(other, piece));
      others.push_back(piece);
    }
  }
}

}  // namespace

Joins count_joins(const std::vector<CentreLine>& truth, const std::vector<Tube>& modelled) {
  const std::vector<Pieces> on_tubes = edges_on(truth, modelled);
  std::vector<Join> in_truth;
  std::vector<std::map<std::size_t, std::size_t>> piece_of_edge(modelled.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Pieces pieces = without_repetition(truth[i], on_tubes[i]);
    add_true_joins(in_truth, truth[i], pieces, count);
    for (const Piece& piece : pieces) piece_of_edge[piece.tube][piece.edge] = count++;
  }
  std::vector<Join> made;
  for (std::size_t i = 0; i < modelled.size(); ++i) add_modelled_joins(made, modelled[i], piece_of_edge[i]);
  std::ranges::sort(in_truth);
  std::ranges::sort(made);
  std::vector<Join> found;
  std::ranges::set_intersection(in_truth, made, std::back_inserter(found));
  return {std::ssize(in_truth), std::ssize(found), std::ssize(made)};
}

}  // namespace tanglebin
