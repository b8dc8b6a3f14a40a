#include "tanglebin/settle/contacts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tanglebin/geometry/bin_parts.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tests/geometry/example_tubes.hpp"

namespace tanglebin {
namespace {

using testing::IsEmpty;

constexpr double half_thickness = 0.0125;

Tube tube_through(int id, const std::vector<Eigen::Vector3d>& points) {
  Tube tube = test::tube_through(points);
  tube.id = id;
  return tube;
}

TEST(Contacts, ATubeOnTheFloorTouchesItAtItsNodes) {
  const Tube tube =
      tube_through(1, {{-0.1, 0, half_thickness}, {0, 0.02, half_thickness}, {0.1, 0, half_thickness}});
  const std::vector<Contact> found = contacts({tube}, Bin{});
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].other, bin_label);
    EXPECT_EQ(bin_part_names.at(*found[i].bin_part), "floor");
    EXPECT_NEAR(found[i].gap, 0, 1e-12);
    EXPECT_NEAR(found[i].point.z(), 0, 1e-12);
  }
}

TEST(Contacts, CrossedTubesTouchOnceBetweenTheirAxes) {
  const std::vector<Tube> tubes{tube_through(1, {{-0.1, 0, 0.1}, {-0.0001, 0, 0.1}, {0.1, 0, 0.1}}),
                                tube_through(2, {{0, -0.1, 0.1 + 2 * half_thickness - 0.0001},
                                                 {0, 0.1, 0.1 + 2 * half_thickness - 0.0001}})};
  const std::vector<Contact> found = contacts(tubes, Bin{});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].tube, 1);
  EXPECT_EQ(found[0].other, 2);
  EXPECT_FALSE(found[0].bin_part);
  EXPECT_NEAR(found[0].gap, -0.0001, 1e-9);
  EXPECT_NEAR((found[0].point - Eigen::Vector3d(0, 0, 0.1 + half_thickness - 0.00005)).norm(), 0, 1e-6);
}

TEST(Contacts, TubesThatAreATenthOfAMillimetreApartTouchAndNoMore) {
  const auto apart = [](double gap) {
    return contacts({tube_through(1, {{-0.1, 0, 0.1}, {0.1, 0, 0.1}}),
                     tube_through(2, {{0, -0.1, 0.1 + 2 * half_thickness + gap},
                                      {0, 0.1, 0.1 + 2 * half_thickness + gap}})},
                    Bin{});
  };
  EXPECT_EQ(apart(0.00009).size(), 1U);
  EXPECT_THAT(apart(0.00011), IsEmpty());
}

TEST(Contacts, ATubeThatLeansOverTheRimTouchesItBetweenItsNodes) {
  const Bin bin;
  // Along x through a point a radius above the rim's inner edge, in a direction that rises outwards.
  const Eigen::Vector3d edge(bin.length / 2, 0, bin.height);
  const Eigen::Vector3d direction = Eigen::Vector3d(1, 0, 1).normalized();
  const Eigen::Vector3d above = edge + half_thickness * Eigen::Vector3d(-1, 0, 1).normalized();
  const Tube tube = tube_through(1, {above - 0.1 * direction, above + 0.15 * direction});
  const std::vector<Contact> found = contacts({tube}, bin);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(bin_part_names.at(*found[0].bin_part), "wall_max_x");
  EXPECT_NEAR((found[0].point - edge).norm(), 0, 1e-6);
}

}  // namespace
}  // namespace tanglebin
