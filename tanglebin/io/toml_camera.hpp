#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string_view>
#include <tuple>

#include "tanglebin/files/toml_fields.hpp"
#include "tanglebin/geometry/camera.hpp"

// Internal to the library: cameras in recipes and in scene files (docs/formats.md). The functions read only
// the keys that a table has; what it may have is its reader's business.
namespace tanglebin {

inline constexpr std::tuple camera_size_fields{
    Field{"width", &Camera::width},
    Field{"height", &Camera::height},
};
inline constexpr std::tuple camera_lens_fields{
    Field{"fx", &Camera::fx},
    Field{"fy", &Camera::fy},
    Field{"cx", &Camera::cx},
    Field{"cy", &Camera::cy},
};

/// The keys of size and lens, and those of the pose.
Keys camera_intrinsics_keys();
Keys camera_pose_keys();

/// Sets the size and the lens. A lens that the table does not have is the preset's, with the same horizontal
/// field of view if the size is another.
void read_camera_intrinsics(const TomlTable& table, const Camera& preset, Camera& camera);

/// Sets the pose where the table has it. A scene file may have two more keys than a recipe: up, the direction
/// in the world that is up in the image, beside look_at, and camera_to_world, four rows, in place of all
/// others.
void read_camera_pose(const TomlTable& table, Camera& camera);

/// The orientation with this z axis (a unit vector) whose x axis is as close as possible to the world's. None
/// if they are parallel, or for a zero vector.
std::optional<Eigen::Matrix3d> orientation_along(const Eigen::Vector3d& z);

/// Sets `pose` from four rows of a 4 x 4 matrix, if the table has the key. A rotation that is off by less
/// than 0.001 is made exact.
void read_rigid_motion(const TomlTable& table, std::string_view key, Eigen::Isometry3d& pose);

/// Sets `rotation` from the keys rotation_wxyz or rotation_matrix, if the table has one of them.
void read_rotation(const TomlTable& table, Eigen::Matrix3d& rotation);

}  // namespace tanglebin
