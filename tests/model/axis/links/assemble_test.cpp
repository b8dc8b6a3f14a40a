#include "tanglebin/model/axis/links/assemble.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/model/axis/fragments/straight_fragment.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::straight_fragment;

// A link from the lower end of a fragment to a junction beyond the second end of fragment 0.
Link to_junction_beyond(double distance, std::size_t fragment) {
  const Vector3d junction(distance, 0, 0);
  return {.kind = LinkKind::junction,
          .fragment = fragment,
          .end = 0,
          .to = {.fragment = 0, .node = 1, .end = 1, .position = junction},
          .gap = 0.05,
          .features = {}};
}

// Whichever link is heavier, the stem passes the nearer junction first.
TEST(Assemble, ChainsJunctionsBeyondAnEndByTheirDistance) {
  const std::vector<Fragment> fragments = {straight_fragment({-0.2, 0, 0}, {0, 0, 0}),
                                           straight_fragment({0.1, 0.05, 0}, {0.1, 0.2, 0}),
                                           straight_fragment({0.03, -0.05, 0}, {0.03, -0.2, 0})};
  const std::vector<Link> links = {to_junction_beyond(0.1, 1), to_junction_beyond(0.03, 2)};
  const LineTree line = assembled_line(fragments, {0, 1, 2}, links, {0, 1}, test::radius);
  double stem = 0;
  for (const auto& [from, to] : line.edges) {
    const Vector3d& a = line.nodes[from];
    const Vector3d& b = line.nodes[to];
    if (a.y() == 0 && b.y() == 0) stem += (b - a).norm();
  }
  EXPECT_NEAR(stem, 0.3, 1e-9) << "from -0.2 to 0.1 and not back";
}

}  // namespace
}  // namespace tanglebin
