#include "arrays.hpp"

#include "tanglebin/geometry/rigid.hpp"

namespace tanglebin::python {

py::array_t<double> matrix_of(const Eigen::Isometry3d& pose) {
  py::array_t<double> matrix({4, 4});
  for (py::ssize_t row = 0; row < 4; ++row) {
    for (py::ssize_t column = 0; column < 4; ++column)
      matrix.mutable_at(row, column) = pose.matrix()(row, column);
  }
  return matrix;
}

Eigen::Isometry3d pose_of(const py::array_t<double>& matrix, const char* field) {
  expect_shape(matrix.ndim() == 2 && matrix.shape(0) == 4 && matrix.shape(1) == 4, matrix, field,
               "4 x 4: a rotation and a translation");
  Eigen::Matrix4d numbers;
  for (py::ssize_t row = 0; row < 4; ++row) {
    for (py::ssize_t column = 0; column < 4; ++column) numbers(row, column) = matrix.at(row, column);
  }
  const Eigen::Isometry3d pose(numbers);
  if (is_rigid(pose) && numbers.row(3) == Eigen::RowVector4d(0, 0, 0, 1)) return pose;
  const std::optional<Eigen::Isometry3d> near = rigid_motion_near(numbers);
  if (!near)
    throw InputError({"", 0, field}, "a matrix that is no rigid motion", "a rotation and a translation");
  return *near;
}

py::array_t<double> array_of(const Eigen::Vector3d& vector) {
  return py::array_t<double>(3, vector.data());
}

Eigen::Vector3d vector_of(const py::array_t<double>& array, const char* field) {
  expect_shape(array.ndim() == 1 && array.shape(0) == 3, array, field, "three numbers");
  return {array.at(0), array.at(1), array.at(2)};
}

}  // namespace tanglebin::python
