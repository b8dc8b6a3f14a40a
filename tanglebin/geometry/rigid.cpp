#include "tanglebin/geometry/rigid.hpp"

#include <Eigen/SVD>

namespace tanglebin {

std::optional<Eigen::Isometry3d> rigid_motion_near(const Eigen::Matrix4d& matrix) {
  constexpr double tolerance = 1e-3;
  const Eigen::Isometry3d motion(matrix);
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  if (!matrix.allFinite() || matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) return std::nullopt;
  if (is_rigid(motion)) return motion;
  if (!rotation.isUnitary(tolerance) || !(rotation.determinant() > 0)) return std::nullopt;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Isometry3d nearest = motion;
  nearest.linear() = svd.matrixU() * svd.matrixV().transpose();
  return nearest;
}

}  // namespace tanglebin
