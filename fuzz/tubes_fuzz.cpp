// Any input is either tubes, each a tree of known nodes, or an error with a message on one line.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "fuzz/is_refused.hpp"
#include "tanglebin/io/read_tubes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream file(std::string(data, data + size));
  std::vector<tanglebin::Tube> tubes;
  if (is_refused([&] { tubes = tanglebin::read_tubes(file, "tubes"); })) return 0;
  for (const tanglebin::Tube& tube : tubes) {
    const bool has_known_nodes = std::ranges::all_of(tube.edges, [&](const tanglebin::Edge& edge) {
      return edge.from < tube.nodes.size() && edge.to < tube.nodes.size();
    });
    if (!has_known_nodes || tube.edges.size() + 1 != tube.nodes.size() || !(tube.radius > 0)) std::abort();
  }
  return 0;
}
