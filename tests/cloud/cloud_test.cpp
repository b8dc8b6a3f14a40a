#include "tanglebin/cloud/cloud.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/cloud/clouds.hpp"

namespace tanglebin {
namespace {

TEST(PointCloud, HasAsManyOfEverythingAndKnownLabels) {
  check_cloud(PointCloud{});
  check_cloud(small_cloud());
  PointCloud few_labels = small_cloud();
  few_labels.labels.pop_back();
  EXPECT_THROW(check_cloud(few_labels), std::invalid_argument);
  PointCloud few_colors = small_cloud();
  few_colors.colors.pop_back();
  EXPECT_THROW(check_cloud(few_colors), std::invalid_argument);
  PointCloud negative = small_cloud();
  negative.labels[1] = -2;
  EXPECT_THROW(check_cloud(negative), std::invalid_argument);
  PointCloud wide = small_cloud();
  wide.width = 3;
  EXPECT_THROW(check_cloud(wide), std::invalid_argument);
}

TEST(PointCloud, HasAPropertyOfAllItsPointsOrOfNone) {
  PointCloud cloud = small_cloud();
  cloud.intensities.assign(cloud.points.size() + 1, 1);
  EXPECT_THROW(check_cloud(cloud), std::invalid_argument);
}

}  // namespace
}  // namespace tanglebin
