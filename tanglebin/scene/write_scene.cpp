#include "tanglebin/scene/write_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "tanglebin/files/toml_table.hpp"

namespace tanglebin {
namespace {

std::string line(std::string_view key, std::string_view value) {
  return fmt::format("{} = {}\n", key, value);
}

std::string line(std::string_view key, double value) {
  return line(key, real_text(value));
}

std::string rows_of(std::string_view key, const Eigen::Isometry3d& pose) {
  std::vector<std::string> rows;
  for (const auto& row : pose.matrix().rowwise()) {
    std::vector<std::string> numbers;
    for (const double number : row) numbers.push_back(real_text(number));
    rows.push_back(fmt::format("  [{}]", fmt::join(numbers, ", ")));
  }
  return line(key, fmt::format("[\n{},\n]", fmt::join(rows, ",\n")));
}

std::string range_of(std::string_view key, const LengthRange& range) {
  if (range.min == range.max) return line(key, range.min);
  return line(key, fmt::format("{{ min = {}, max = {} }}", real_text(range.min), real_text(range.max)));
}

std::string text_of(const Intrinsics& intrinsics) {
  std::string text;
  if (intrinsics.width > 0)
    text += line("width", fmt::format("{}", intrinsics.width)) +
            line("height", fmt::format("{}", intrinsics.height));
  return text + line("fx", intrinsics.fx) + line("fy", intrinsics.fy) + line("cx", intrinsics.cx) +
         line("cy", intrinsics.cy);
}

std::string text_of(const SceneCamera& camera) {
  std::string text;
  if (camera.intrinsics) text += text_of(*camera.intrinsics);
  if (camera.pose) text += rows_of("camera_to_world", *camera.pose);
  if (camera.frame) text += line("frame", *camera.frame == CloudFrame::camera ? "\"camera\"" : "\"world\"");
  if (camera.unit) text += line("unit", *camera.unit == 1 ? "\"m\"" : "\"mm\"");
  if (camera.depth_scale) text += line("depth_scale", *camera.depth_scale);
  return text.empty() ? text : "[camera]\n" + text;
}

std::string text_of(const Support& support, bool wall_is_given) {
  std::string text = "[support]\n" + line("shape", fmt::format("\"{}\"", name_of(support.shape)));
  if (support.shape == Support::Shape::nothing) return text;
  if (support.shape == Support::Shape::bin) {
    text += line("length", support.bin.length) + line("width", support.bin.width) +
            line("height", support.bin.height);
    if (wall_is_given) text += line("wall", support.bin.wall);
  }
  if (support.pose.matrix() != Eigen::Matrix4d::Identity()) text += rows_of("support_to_world", support.pose);
  if (support.margin != 0) text += line("margin", support.margin);
  return text;
}

std::string text_of(const TubeClass& tubes) {
  std::string text = "[[tube]]\n";
  text += tubes.radius ? range_of("radius", *tubes.radius) : line("radius", "\"auto\"");
  if (tubes.length) text += range_of("length", *tubes.length);
  if (tubes.flat_ends) text += line("ends", "\"flat\"");
  for (const auto& [from, to, length] : tubes.tree)
    text += "[[tube.segment]]\n" + line("from", fmt::format("{}", from)) + line("to", fmt::format("{}", to)) +
            line("length", length);
  return text;
}

}  // namespace

void write_scene(std::ostream& out, const Scene& scene) {
  std::vector<std::string> tables;
  if (const std::string camera = text_of(scene.camera); !camera.empty()) tables.push_back(camera);
  if (scene.support) tables.push_back(text_of(*scene.support, scene.wall_is_given));
  for (const TubeClass& tubes : scene.tubes) tables.push_back(text_of(tubes));
  out << fmt::format("{}", fmt::join(tables, "\n"));
}

}  // namespace tanglebin
