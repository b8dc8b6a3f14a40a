#include "tanglebin/scene/camera_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/files/json_record.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/geometry/rigid.hpp"
#include "tanglebin/scene/camera_info.hpp"

namespace tanglebin {
namespace {

constexpr double metres_per_millimetre = 0.001;

std::vector<double> numbers(const JsonRecord& record, const std::string& field, std::size_t count) {
  std::vector<double> result = record.numbers(field, -infinity, infinity);
  if (result.size() != count)
    record.fail(field, fmt::format("{} numbers", result.size()), fmt::format("{} numbers", count));
  return result;
}

template <int Rows, int Columns, int Order>
Eigen::Matrix<double, Rows, Columns> matrix(const JsonRecord& record, const std::string& field) {
  const std::vector<double> values = numbers(record, field, static_cast<std::size_t>(Rows * Columns));
  return Eigen::Map<const Eigen::Matrix<double, Rows, Columns, Order>>(values.data());
}

Intrinsics intrinsics_of(const Eigen::Matrix3d& matrix, const JsonRecord& record, const std::string& field) {
  constexpr double square = 1e-3;
  if (!(std::abs(matrix(0, 1)) <= square * std::abs(matrix(0, 0))) || matrix(1, 0) != 0 ||
      matrix(2, 0) != 0 || matrix(2, 1) != 0 || matrix(2, 2) != 1)
    record.fail(field, "a matrix with other entries",
                "fx and cx, fy and cy, and 1 in its rows, zeros elsewhere");
  return {.width = 0,
          .height = 0,
          .fx = matrix(0, 0),
          .fy = matrix(1, 1),
          .cx = matrix(0, 2),
          .cy = matrix(1, 2)};
}

Eigen::Isometry3d rigid_motion(const Eigen::Matrix4d& matrix, const JsonRecord& record,
                               const std::string& field) {
  const std::optional<Eigen::Isometry3d> motion = rigid_motion_near(matrix);
  if (!motion) record.fail(field, "a matrix that is no rigid motion", "a rotation and a position");
  return *motion;
}

double depth_scale_of(const JsonRecord& record) {
  const double scale = record.number("depth_scale", 0);
  if (!(scale > 0)) record.fail("depth_scale", "0", "a positive number");
  return scale;
}

// Our own key: rows of a matrix.
Eigen::Isometry3d read_camera_to_world(const JsonRecord& record) {
  const std::string field = "camera_to_world";
  const Json& rows = record.json().at(field);
  Eigen::Matrix4d matrix;
  const auto fail = [&] { record.fail(field, excerpt(rows.dump()), "4 rows of 4 numbers"); };
  if (!rows.is_array() || rows.size() != 4) fail();
  for (std::size_t row = 0; row < 4; ++row) {
    if (!rows[row].is_array() || rows[row].size() != 4) fail();
    for (std::size_t column = 0; column < 4; ++column) {
      if (!rows[row][column].is_number()) fail();
      matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          rows[row][column].get<double>();
    }
  }
  return rigid_motion(matrix, record, field);
}

// Open3D's PinholeCameraIntrinsic, to which our own files add the scale and the pose.
SceneCamera read_pinhole_intrinsic(const JsonRecord& record) {
  SceneCamera camera;
  Intrinsics intrinsics =
      intrinsics_of(matrix<3, 3, Eigen::ColMajor>(record, "intrinsic_matrix"), record, "intrinsic_matrix");
  intrinsics.width = record.positive_int("width");
  intrinsics.height = record.positive_int("height");
  camera.intrinsics = intrinsics;
  if (record.has("depth_scale")) camera.depth_scale = depth_scale_of(record);
  if (record.has("camera_to_world")) camera.pose = read_camera_to_world(record);
  return camera;
}

// Open3D's PinholeCameraParameters.
SceneCamera read_pinhole_parameters(const JsonRecord& record) {
  SceneCamera camera = read_pinhole_intrinsic(record.object("intrinsic"));
  camera.pose =
      rigid_motion(matrix<4, 4, Eigen::ColMajor>(record, "extrinsic"), record, "extrinsic").inverse();
  return camera;
}

// BOP's camera.json. Its depth scale is in millimetres per step.
SceneCamera read_bop_camera(const JsonRecord& record) {
  SceneCamera camera;
  camera.intrinsics = {.width = record.positive_int("width"),
                       .height = record.positive_int("height"),
                       .fx = record.number("fx"),
                       .fy = record.number("fy"),
                       .cx = record.number("cx"),
                       .cy = record.number("cy")};
  if (record.has("depth_scale")) camera.depth_scale = 1 / (depth_scale_of(record) * metres_per_millimetre);
  return camera;
}

SceneCamera read_bop_image(const JsonRecord& record) {
  SceneCamera camera;
  camera.intrinsics = intrinsics_of(matrix<3, 3, Eigen::RowMajor>(record, "cam_K"), record, "cam_K");
  if (record.has("depth_scale")) camera.depth_scale = 1 / (depth_scale_of(record) * metres_per_millimetre);
  if (!record.has("cam_R_w2c")) return camera;
  Eigen::Matrix4d world_to_camera = Eigen::Matrix4d::Identity();
  world_to_camera.topLeftCorner<3, 3>() = matrix<3, 3, Eigen::RowMajor>(record, "cam_R_w2c");
  world_to_camera.topRightCorner<3, 1>() =
      matrix<3, 1, Eigen::ColMajor>(record, "cam_t_w2c") * metres_per_millimetre;
  camera.pose = rigid_motion(world_to_camera, record, "cam_R_w2c").inverse();
  return camera;
}

// BOP's scene_camera.json: the cameras of images 0, 1, 2, …
SceneCamera read_bop_scene(const JsonRecord& record, const std::string& name, std::optional<int> image) {
  const std::vector<std::string> images = record.fields();
  if (!image && images.size() == 1) return read_bop_image(record.object(images.front()));
  if (!image)
    throw InputError(
        {name, 0, "image"}, fmt::format("the cameras of {} images", images.size()),
        "the number of the one that is meant, such as image = 3 in a scene file; or a cloud that "
        "is called like its image, 000003.png");
  const std::string field = fmt::format("{}", *image);
  if (!record.has(field))
    throw InputError({name, 0, "image"}, field,
                     fmt::format("one of {} images, {} to {}", images.size(), images.front(), images.back()));
  return read_bop_image(record.object(field));
}

bool is_bop_scene(const JsonRecord& record) {
  const auto is_image = [&](const std::string& field) {
    const Json& value = record.json().at(field);
    return to_number<int>(field).has_value() && value.is_object() && value.contains("cam_K");
  };
  const std::vector<std::string> fields = record.fields();
  return !fields.empty() && std::ranges::all_of(fields, is_image);
}

SceneCamera read_json(const JsonRecord& record, const std::string& name, std::optional<int> image) {
  if (record.has("intrinsic_matrix")) return read_pinhole_intrinsic(record);
  if (record.has("intrinsic") && record.has("extrinsic")) return read_pinhole_parameters(record);
  if (record.has("fx")) return read_bop_camera(record);
  if (is_bop_scene(record)) return read_bop_scene(record, name, image);
  throw InputError({name, 0, ""}, "JSON of another kind",
                   "a camera of `tanglebin scan --depth`, of Open3D or of BOP");
}

}  // namespace

SceneCamera read_camera_text(const std::string& text, const std::string& name, std::optional<int> image) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) throw InputError({name, 0, ""}, "an empty file", "a camera");
  Scene scene;
  if (text[first] == '{') {
    scene.camera = read_json(JsonRecord(text, name, 0), name, image);
  } else {
    scene.camera.intrinsics = read_camera_info(text, name);
  }
  with_file(name, [&] { validate(scene); });
  return scene.camera;
}

SceneCamera read_camera_file(const std::filesystem::path& file, std::optional<int> image) {
  return read_camera_text(read_file(file), file.string(), image);
}

}  // namespace tanglebin
