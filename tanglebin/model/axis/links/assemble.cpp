#include "tanglebin/model/axis/links/assemble.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "tanglebin/model/axis/links/junctions.hpp"

namespace tanglebin {
namespace {

/// The nodes of a fragment in a line.
struct FragmentNodes {
  std::size_t first;
  std::vector<std::size_t> ends;
};

// Adds the fragment's centre line, extended to its ends.
FragmentNodes add_fragment(LineTree& line, const Fragment& fragment) {
  const std::size_t offset = line.nodes.size();
  line.nodes.insert(line.nodes.end(), fragment.nodes.begin(), fragment.nodes.end());
  for (std::size_t node = 1; node < fragment.nodes.size(); ++node) {
    line.edges.push_back({offset + fragment.parents[node], offset + node});
  }
  std::vector<std::size_t> end_nodes;
  for (const FragmentEnd& end : fragment.ends) {
    std::size_t node = offset + end.node;
    if (std::ranges::find(end_nodes, node) != end_nodes.end()) {
      // This is the second end of a fragment with a single node.
      line.edges.push_back({node, line.nodes.size()});
      node = line.nodes.size();
      line.nodes.emplace_back();
    }
    line.nodes[node] = end.position;
    end_nodes.push_back(node);
  }
  return {offset, std::move(end_nodes)};
}

// The node of the line that a link leads to. For a junction beyond an end this is a new node, which then
// replaces the end.
std::size_t target_node(LineTree& line, FragmentNodes& fragment, const Link& link) {
  if (!link.to.end) return fragment.first + link.to.node;
  std::size_t& end = fragment.ends[*link.to.end];
  if (link.kind == LinkKind::junction) {
    line.edges.push_back({end, line.nodes.size()});
    end = line.nodes.size();
    line.nodes.push_back(link.to.position);
  }
  return end;
}

// How far a link's junction lies beyond the end of its fragment, m.
double distance_beyond(const std::vector<Fragment>& fragments, const Link& link) {
  if (!link.to.end) return 0;
  return (link.to.position - fragments[link.to.fragment].ends[*link.to.end].position).norm();
}

LineTree assemble(const std::vector<Fragment>& fragments, const std::vector<std::size_t>& members,
                  const std::vector<Link>& links, const std::vector<std::size_t>& chosen) {
  LineTree line;
  std::map<std::size_t, FragmentNodes> added;
  for (const std::size_t member : members) added[member] = add_fragment(line, fragments[member]);
  std::vector<std::size_t> of_members;
  std::ranges::copy_if(chosen, std::back_inserter(of_members),
                       [&](std::size_t i) { return added.contains(links[i].fragment); });
  // Junctions first, the nearest to their fragment before those beyond them: a link to an end with a junction
  // beyond it starts at the junction.
  const auto others = std::stable_partition(of_members.begin(), of_members.end(), [&](std::size_t i) {
    return links[i].kind == LinkKind::junction;
  });
  std::stable_sort(of_members.begin(), others, [&](std::size_t a, std::size_t b) {
    return distance_beyond(fragments, links[a]) < distance_beyond(fragments, links[b]);
  });
  for (const std::size_t i : of_members) {
    const Link& link = links[i];
    const std::size_t target = target_node(line, added[link.to.fragment], link);
    line.edges.push_back({added[link.fragment].ends[link.end], target});
  }
  return line;
}

}  // namespace

LineTree assembled_line(const std::vector<Fragment>& fragments, const std::vector<std::size_t>& members,
                        const std::vector<Link>& links, const std::vector<std::size_t>& chosen,
                        double radius) {
  return with_junctions_drawn_back(assemble(fragments, members, links, chosen), radius);
}

}  // namespace tanglebin
