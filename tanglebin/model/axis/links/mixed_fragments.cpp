#include "tanglebin/model/axis/links/mixed_fragments.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace tanglebin {
namespace {

constexpr double strange = 5;     // TubeShapes::strangeness() of what is no part of a tube
constexpr double ordinary = 2.5;  // and of what is one
constexpr double part_min = 3;    // radii; shorter parts are of any shape

// How strange the stranger of the two parts beside a node is.
double strangeness_beside(const CentrePath& line, std::size_t node, const TubeShapes& shapes) {
  const auto at = line.begin() + static_cast<std::ptrdiff_t>(node);
  return std::max(shapes.strangeness({line.begin(), at}), shapes.strangeness({at + 1, line.end()}));
}

// The node that parts a centre line into what looks most like parts of tubes. None if the line is one itself.
std::optional<std::size_t> node_between_tubes(const CentrePath& line, double radius,
                                              const TubeShapes& shapes) {
  if (shapes.strangeness(line, strange) < strange) return std::nullopt;
  const std::vector<double> ways = ways_along(line);
  std::optional<std::size_t> between;
  double least = ordinary;
  for (std::size_t node = 0; node < line.size(); ++node) {
    if (std::min(ways[node], ways.back() - ways[node]) < part_min * radius) continue;
    const double strangeness = strangeness_beside(line, node, shapes);
    if (strangeness >= least) continue;
    least = strangeness;
    between = node;
  }
  return between;
}

}  // namespace

bool cut_mixed(std::vector<Fragment>& fragments, const AxisVotes& votes, double radius,
               const TubeShapes& shapes, const FragmentSettings& settings) {
  if (!shapes.are_bent()) return false;
  const std::size_t before = fragments.size();
  for (std::size_t i = 0; i < before; ++i) {
    if (fragments[i].ends.size() > 2) continue;
    const std::optional<std::size_t> between = node_between_tubes(fragments[i].nodes, radius, shapes);
    if (between) cut_at(fragments, i, *between, votes, radius, settings);
  }
  return fragments.size() > before;
}

}  // namespace tanglebin
