#include "tanglebin/model/scene/box_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tanglebin/base/random.hpp"

namespace tanglebin {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using testing::Contains;
using testing::IsEmpty;

Vector3d any_point(Rng& rng, double reach) {
  const auto coordinate = [&] { return uniform_real(rng, -reach, reach); };
  const double x = coordinate();
  const double y = coordinate();
  return {x, y, coordinate()};
}

TEST(BoxGrid, NamesEveryBoxThatContainsAPoint) {
  Rng rng(5);
  for (const double reach : {0.3, 15.0}) {  // some twenty metres are many cells
    std::vector<AlignedBox3d> boxes;
    for (int i = 0; i < 60; ++i) {
      const Vector3d corner = any_point(rng, reach);
      boxes.emplace_back(corner, corner + (any_point(rng, 0.05) + Vector3d::Constant(0.05)));
    }
    const BoxGrid grid(boxes);
    std::size_t named = 0;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      for (const Vector3d& point : {boxes[i].min(), boxes[i].max(), Vector3d(boxes[i].center())}) {
        EXPECT_THAT(grid.around(point), Contains(i));
        EXPECT_TRUE(std::ranges::is_sorted(grid.around(point)));
        named += grid.around(point).size();
      }
    }
    EXPECT_LT(named, 3 * 60 * 10) << "few others";
  }
}

TEST(BoxGrid, NamesNoneFarAway) {
  const BoxGrid grid({AlignedBox3d(Vector3d(0, 0, 0), Vector3d(1, 1, 1))});
  EXPECT_THAT(grid.around({2, 0, 0}), IsEmpty());
  EXPECT_THAT(grid.around({0, -1e30, 0}), IsEmpty());
  EXPECT_THAT(BoxGrid({}).around({0, 0, 0}), IsEmpty());
}

}  // namespace
}  // namespace tanglebin
