#include "tanglebin/scene/read_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <istream>
#include <string_view>
#include <utility>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/millimetres.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/io/toml_camera.hpp"
#include "tanglebin/scene/camera_file.hpp"

namespace tanglebin {
namespace {

/// The value that stands for a name, or the table's error.
template <typename Value, std::size_t Count>
Value named(const TomlTable& table, std::string_view key,
            const std::array<std::pair<std::string_view, Value>, Count>& names, const std::string& expected) {
  std::string name;
  table.get(key, name);
  for (const auto& [known, value] : names) {
    if (known == name) return value;
  }
  table.fail(key, excerpt(name), expected);
}

bool has_any(const TomlTable& table, const Keys& keys) {
  return std::ranges::any_of(keys, [&](std::string_view key) { return table.has(key); });
}

// [camera]

Keys intrinsics_keys() {
  return all({{"file", "image", "preset"}, camera_intrinsics_keys()});
}

Keys pose_keys() {
  return all({camera_pose_keys(), {"up", "camera_to_world"}});
}

SceneCamera read_file_of_camera(const TomlTable& table, const std::filesystem::path& directory,
                                std::optional<int> image) {
  for (const std::string_view key : all({{"preset"}, camera_intrinsics_keys()}))
    table.allow_one_of({"file", key});
  std::string file;
  table.get("file", file);
  int number = image.value_or(0);
  table.get("image", number);
  if (table.has("image")) image = number;
  return with_place({table.file(), table.line("file")},
                    [&] { return read_camera_file(directory / file, image); });
}

SceneCamera read_preset(const TomlTable& table) {
  std::string name;
  table.get("preset", name);
  const Camera preset = with_place(table.place("preset"), [&] { return camera_preset(name); });
  Camera camera = preset;
  read_camera_intrinsics(table, preset, camera);
  return {.intrinsics = intrinsics_of(camera), .pose = camera.pose};
}

// Without a size, as in BOP's scene_camera.json, only fx, fy, cx and cy say what a camera is.
SceneCamera read_numbers(const TomlTable& table) {
  if (has_any(table, all({keys(camera_size_fields), {"hfov_deg", "focal_length_px"}}))) {
    table.require({"width", "height"});
    if (!has_any(table, {"hfov_deg", "focal_length_px", "fx", "fy"})) table.require({"fx"});
  } else {
    table.require({"fx", "fy", "cx", "cy"});
  }
  Camera camera{.width = 0, .height = 0};
  read_camera_intrinsics(table, camera, camera);
  return {.intrinsics = intrinsics_of(camera)};
}

SceneCamera read_intrinsics(const TomlTable& table, const std::filesystem::path& directory,
                            std::optional<int> image) {
  if (table.has("file")) return read_file_of_camera(table, directory, image);
  if (table.has("image")) table.require({"file"});
  if (table.has("preset")) return read_preset(table);
  return has_any(table, camera_intrinsics_keys()) ? read_numbers(table) : SceneCamera{};
}

// A pose in the table takes the place of a file's; of a preset's, it may be a part.
void read_pose(const TomlTable& table, SceneCamera& camera) {
  if (!has_any(table, pose_keys())) return;
  if (!table.has("preset") && !table.has("camera_to_world") && !table.has("distance")) {
    table.require({"position"});
    if (!has_any(table, {"look_at", "rotation_wxyz", "rotation_matrix"})) table.require({"look_at"});
  }
  Camera posed;
  if (table.has("preset")) posed.pose = *camera.pose;
  read_camera_pose(table, posed);
  camera.pose = posed.pose;
}

SceneCamera read_camera(const TomlTable& table, const std::filesystem::path& directory,
                        std::optional<int> image) {
  table.allow(all({intrinsics_keys(), pose_keys(), {"frame", "unit", "depth_scale"}}));
  SceneCamera camera = read_intrinsics(table, directory, image);
  read_pose(table, camera);
  if (table.has("frame"))
    camera.frame =
        named<CloudFrame, 2>(table, "frame", {{{"camera", CloudFrame::camera}, {"world", CloudFrame::world}}},
                             "\"camera\" or \"world\"");
  if (table.has("unit"))
    camera.unit = named<double, 2>(table, "unit", {{{"m", 1.0}, {"mm", 0.001}}}, "\"m\" or \"mm\"");
  if (table.has("depth_scale")) table.get("depth_scale", camera.depth_scale.emplace());
  return camera;
}

// [support]

// The orientation of a support from its z axis in the world and a turn about that.
Eigen::Matrix3d read_up(const TomlTable& table) {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  table.get("up", up);
  const std::optional<Eigen::Matrix3d> rotation = orientation_along(up.normalized());
  if (!rotation)
    table.fail("up", "no direction, or one along the world's x axis", "another direction, or rotation_wxyz");
  double yaw_deg = 0;
  table.get("yaw_deg", yaw_deg);
  const Eigen::AngleAxisd yaw(radians_from_degrees(yaw_deg), Eigen::Vector3d::UnitZ());
  return *rotation * yaw.toRotationMatrix();
}

Keys support_pose_keys() {
  return {"position", "up", "yaw_deg", "rotation_wxyz", "rotation_matrix", "support_to_world"};
}

Eigen::Isometry3d read_support_pose(const TomlTable& table) {
  for (const std::string_view other : {"position", "up", "yaw_deg", "rotation_wxyz", "rotation_matrix"})
    table.allow_one_of({other, "support_to_world"});
  table.allow_one_of({"up", "rotation_wxyz", "rotation_matrix"});
  table.allow_one_of({"yaw_deg", "rotation_wxyz"});
  table.allow_one_of({"yaw_deg", "rotation_matrix"});
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  table.get("position", position);
  Eigen::Matrix3d rotation = read_up(table);
  read_rotation(table, rotation);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = position;
  pose.linear() = rotation;
  read_rigid_motion(table, "support_to_world", pose);
  return pose;
}

constexpr std::tuple bin_size_fields{
    Field{"length", &Bin::length},
    Field{"width", &Bin::width},
    Field{"height", &Bin::height},
    Field{"wall", &Bin::wall},
};

void expect_thin_wall(const TomlTable& table, double wall) {
  constexpr double thickest = 0.5;  // m
  if (wall > thickest)
    table.fail("wall", fmt::format("{} m", wall),
               fmt::format("at most {} m{}", thickest, hint_of_millimetres(wall, thickest)));
}

Bin read_bin(const TomlTable& table) {
  Bin bin;
  std::string preset;
  table.get("preset", preset);
  if (table.has("preset")) {
    bin = with_place(table.place("preset"), [&] { return bin_preset(preset); });
  } else {
    table.require({"length", "width", "height"});
  }
  read_fields(table, bin_size_fields, bin);
  expect_thin_wall(table, bin.wall);
  return bin;
}

Support read_support(const TomlTable& table) {
  table.require({"shape"});
  const auto shape = named<Support::Shape, 3>(table, "shape",
                                              {{{"bin", Support::Shape::bin},
                                                {"plane", Support::Shape::plane},
                                                {"nothing", Support::Shape::nothing}}},
                                              "\"bin\", \"plane\" or \"nothing\"");
  Support support{.shape = shape};
  if (shape == Support::Shape::nothing) {
    table.allow({"shape"});
    return support;
  }
  const Keys of_all = all({{"shape", "margin"}, support_pose_keys()});
  if (shape == Support::Shape::bin) {
    table.allow(all({of_all, {"preset"}, keys(bin_size_fields)}));
    support.bin = read_bin(table);
  } else {
    table.allow(of_all);
  }
  support.pose = read_support_pose(table);
  table.get("margin", support.margin);
  return support;
}

// [[tube]]

// A number, or the ends of a range: { min = 0.2, max = 0.5 }.
LengthRange read_range(const TomlTable& table, std::string_view key) {
  LengthRange range{};
  if (table.raw_table(key) == nullptr) {
    table.get(key, range.min);
    range.max = range.min;
    return range;
  }
  const TomlTable ends = table.table(key);
  ends.allow({"min", "max"});
  ends.require({"min", "max"});
  ends.get("min", range.min);
  ends.get("max", range.max);
  return range;
}

// A radius of "auto" is to be estimated, as one that is left out.
std::optional<LengthRange> read_radius(const TomlTable& table) {
  if (!table.has("radius")) return std::nullopt;
  if (!table.is_string("radius")) return read_range(table, "radius");
  std::string text;
  table.get("radius", text);
  if (text != "auto")
    table.fail("radius", excerpt(text), "a number, m; a range, { min = 0.005, max = 0.01 }; or \"auto\"");
  return std::nullopt;
}

SegmentTree read_segments(const TomlTable& table) {
  SegmentTree tree;
  for (const TomlTable& segment : table.tables("segment")) {
    segment.allow({"from", "to", "length"});
    segment.require({"from", "to", "length"});
    Segment& read = tree.emplace_back();
    segment.get("from", read.from);
    segment.get("to", read.to);
    segment.get("length", read.length);
  }
  if (tree.empty()) table.fail("segment", "none", "at least one [[tube.segment]]");
  return tree;
}

TubeClass read_tubes(const TomlTable& table) {
  table.allow({"radius", "length", "ends", "segment"});
  table.allow_one_of({"length", "segment"});
  TubeClass tubes{.radius = read_radius(table)};
  if (table.has("length")) tubes.length = read_range(table, "length");
  if (table.has("segment")) tubes.tree = read_segments(table);
  if (table.has("ends"))
    tubes.flat_ends =
        named<bool, 2>(table, "ends", {{{"round", false}, {"flat", true}}}, "\"round\" or \"flat\"");
  return tubes;
}

Scene read_root(const TomlTable& root, const std::filesystem::path& directory, std::optional<int> image) {
  root.allow({"camera", "support", "tube"});
  Scene scene{.camera = read_camera(root.table("camera"), directory, image)};
  if (root.has("support")) {
    const TomlTable support = root.table("support");
    scene.support = read_support(support);
    scene.wall_is_given = has_any(support, {"wall", "preset"});
  }
  for (const TomlTable& tubes : root.tables("tube")) scene.tubes.push_back(read_tubes(tubes));
  return scene;
}

}  // namespace

Scene read_scene(std::istream& in, const std::string& name, const std::filesystem::path& directory,
                 std::optional<int> image) {
  const toml::table tree = parse_toml(read_bytes(in, name), name);
  const TomlSource source(name, tree);
  Scene scene = read_root({source, tree, ""}, directory, image);
  validate_at(source, [&] { validate(scene); });
  return scene;
}

Scene read_scene(const std::filesystem::path& file, std::optional<int> image) {
  std::optional<std::ifstream> in = open_if_there(file);
  if (!in) throw InputError({file.string(), 0, ""}, "cannot be opened: there is no such file");
  return read_scene(*in, file.string(), file.parent_path(), image);
}

}  // namespace tanglebin
