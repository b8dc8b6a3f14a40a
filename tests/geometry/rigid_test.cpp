#include "tanglebin/geometry/rigid.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace tanglebin {
namespace {

TEST(RigidMotionNear, TakesAnExactOneAsItIs) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  pose.translation() = Eigen::Vector3d(0.1, 0.2, 0.3);
  const auto motion = rigid_motion_near(pose.matrix());
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->matrix(), pose.matrix());
}

TEST(RigidMotionNear, MakesARoundedOneExact) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  const Eigen::Matrix4d rounded = (pose.matrix() * 1000).array().round().matrix() / 1000;
  EXPECT_FALSE(is_rigid(Eigen::Isometry3d(rounded)));
  const auto motion = rigid_motion_near(rounded);
  ASSERT_TRUE(motion);
  EXPECT_TRUE(motion->linear().isUnitary(1e-12));
  EXPECT_TRUE(motion->matrix().isApprox(pose.matrix(), 1e-3));
}

TEST(RigidMotionNear, IsNoneOfAScaledMirroredOrProjectiveMatrix) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  EXPECT_TRUE(rigid_motion_near(matrix));
  matrix(0, 0) = 1.01;
  EXPECT_FALSE(rigid_motion_near(matrix));
  matrix(0, 0) = -1;
  EXPECT_FALSE(rigid_motion_near(matrix));
  matrix(0, 0) = 1;
  matrix(3, 0) = 0.1;
  EXPECT_FALSE(rigid_motion_near(matrix));
  matrix(3, 0) = 0;
  matrix(0, 3) = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(rigid_motion_near(matrix));
}

}  // namespace
}  // namespace tanglebin
