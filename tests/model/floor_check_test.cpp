#include "tanglebin/model/floor_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

#include "tanglebin/geometry/labels.hpp"
#include "tests/model/mistakes.hpp"

namespace tanglebin {
namespace {

using test::right_view;
using test::View;
using testing::HasSubstr;

// A heap on a plane of which the scene has another height, m, and of which no tube was found.
View view_of_leftovers(double height) {
  View view = right_view();
  view.scene.support = {.shape = Support::Shape::plane};
  view.scene.support.pose.translation().z() = height;
  return view;
}

void remove_bin(View& view) {
  for (std::size_t i = 0; i < view.cloud.points.size(); ++i) {
    if (view.cloud.labels[i] == bin_label)
      view.cloud.points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
  }
}

std::string doubt_of(const View& view) {
  Model model;
  model.labels.assign(view.cloud.points.size(), null_label);
  const auto doubt = doubt_of_floor_height(view.cloud, view.scene, model);
  return doubt ? doubt->message : "";
}

TEST(FloorCheck, DoesNotTakeTubesThatWereNotFoundForAFloorThatIsNotInTheCloud) {
  for (const double height : {0.0, 0.01, 0.015, 0.02}) {
    View view = view_of_leftovers(height);
    remove_bin(view);
    EXPECT_EQ(doubt_of(view), "") << height;
  }
}

TEST(FloorCheck, SeesAFloorAmongTubesThatWereNotFound) {
  EXPECT_EQ(doubt_of(view_of_leftovers(0)), "");
  EXPECT_THAT(doubt_of(view_of_leftovers(-0.01)), HasSubstr("the floor is 10.0 mm above where"));
  EXPECT_THAT(doubt_of(view_of_leftovers(0.006)), HasSubstr("the floor is 6.0 mm below where"));
}

// Such as a sheet of paper under the tubes that is left when the table is cut off.
TEST(FloorCheck, DoesNotTakeASheetThatBulgesForTheFloor) {
  View view = view_of_leftovers(0);
  remove_bin(view);
  for (int i = 0; i < 10'000; ++i) {
    const auto x = static_cast<float>(i % 100 - 50) * 0.003F;
    const auto y = static_cast<float>(i / 100 - 50) * 0.003F;
    view.cloud.points.emplace_back(x, y, 0.017F - 1.2F * (x * x + y * y));
  }
  EXPECT_EQ(doubt_of(view), "");
}

}  // namespace
}  // namespace tanglebin
