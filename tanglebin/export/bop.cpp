#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/cloud/images.hpp"
#include "tanglebin/export/extent.hpp"
#include "tanglebin/export/format.hpp"
#include "tanglebin/export/mask.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/io/mesh.hpp"
#include "tanglebin/scan/scan_output.hpp"

namespace tanglebin {
namespace {

constexpr double millimetre = 1e-3;                            // m
constexpr double depth_step = 1 / (depth_scale * millimetre);  // mm

/// What scene_gt_info.json has for an empty mask.
constexpr std::array<int, 4> no_box{-1, -1, -1, -1};

// Files

std::string scene_folder(const CasePlace& place) {
  return fmt::format("train/{:06}", place.number);
}

constexpr std::array<const char*, 4> scene_files{"scene_camera.json", "scene_gt.json", "scene_gt_info.json",
                                                 "scene_tanglebin.json"};

std::string depth_file(const CasePlace& place, std::size_t image) {
  return fmt::format("{}/depth/{:06}.png", scene_folder(place), image);
}

// `kind` is "mask" or "mask_visib".
std::string mask_file(const CasePlace& place, const char* kind, std::size_t image, std::size_t tube) {
  return fmt::format("{}/{}/{:06}_{:06}.png", scene_folder(place), kind, image, tube);
}

// Every tube is an object of its own, numbered through the whole recipe.
std::size_t object_number(const CasePlace& place, std::size_t tube) {
  return place.tubes_before + tube + 1;
}

std::string model_file(const CasePlace& place, std::size_t tube) {
  return fmt::format("models/obj_{:06}.ply", object_number(place, tube));
}

// A line for each object: its number, a tab and what models_info.json says of it.
std::string models_file(const ExportUnit& unit) {
  return fmt::format("models/of_cases/{}.txt", view_name(unit.cases.front(), ""));
}

std::vector<std::string> files_of(const ExportUnit& unit, const CasePlace& place, std::size_t images) {
  const auto tubes = static_cast<std::size_t>(unit.cases.front().tubes);
  std::vector<std::string> files{models_file(unit)};
  for (const char* name : scene_files) files.push_back(fmt::format("{}/{}", scene_folder(place), name));
  for (std::size_t tube = 0; tube < tubes; ++tube) files.push_back(model_file(place, tube));
  for (std::size_t image = 0; image < images; ++image) {
    files.push_back(depth_file(place, image));
    for (std::size_t tube = 0; tube < tubes; ++tube) {
      for (const char* kind : {"mask", "mask_visib"}) files.push_back(mask_file(place, kind, image, tube));
    }
  }
  return files;
}

// What the files say

// An object's frame has the world's axes, and its origin is at the centre of the tube's bounding box.
Eigen::Vector3d origin_of(const Tube& tube) {
  return extent_of(tube).box.center();
}

Json model_info(const Tube& tube) {
  const Extent extent = extent_of(tube);
  const Eigen::Vector3d size = extent.box.sizes() / millimetre;
  return {{"diameter", extent.diameter / millimetre},
          {"min_x", -size.x() / 2},
          {"min_y", -size.y() / 2},
          {"min_z", -size.z() / 2},
          {"size_x", size.x()},
          {"size_y", size.y()},
          {"size_z", size.z()}};
}

std::string model_ply(const Tube& tube) {
  TubeMesh mesh = mesh_of(tube);
  const Eigen::Vector3d origin = origin_of(tube);
  for (Eigen::Vector3f& vertex : mesh.vertices)
    vertex = ((vertex.cast<double>() - origin) / millimetre).cast<float>();
  return bytes_of([&](std::ostream& out) { write_mesh_ply(out, {mesh}, "millimetres, the object's frame"); });
}

Json rows_of(const Eigen::Matrix3d& matrix) {
  Json json = Json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) json.push_back(matrix(row, column));
  }
  return json;
}

Json in_millimetres(const Eigen::Vector3d& vector) {
  return {vector.x() / millimetre, vector.y() / millimetre, vector.z() / millimetre};
}

Json camera_entry(const Camera& camera) {
  const Eigen::Isometry3d from_world = camera.pose.inverse();
  Eigen::Matrix3d intrinsics = Eigen::Matrix3d::Identity();
  intrinsics(0, 0) = camera.fx;
  intrinsics(1, 1) = camera.fy;
  intrinsics(0, 2) = camera.cx;
  intrinsics(1, 2) = camera.cy;
  return {{"cam_K", rows_of(intrinsics)},
          {"cam_R_w2c", rows_of(from_world.linear())},
          {"cam_t_w2c", in_millimetres(from_world.translation())},
          {"depth_scale", depth_step}};
}

Json pose_entry(const Tube& tube, std::size_t object, const Camera& camera) {
  const Eigen::Isometry3d from_world = camera.pose.inverse();
  return {{"cam_R_m2c", rows_of(from_world.linear())},
          {"cam_t_m2c", in_millimetres(from_world * origin_of(tube))},
          {"obj_id", object}};
}

Json box_entry(const Mask& mask) {
  return mask.pixels.empty() ? no_box : box_of(mask);
}

Json info_entry(const Mask& whole, const Mask& visible, const DepthImage& depth) {
  const auto valid = std::ranges::count_if(
      whole.pixels, [&](std::uint32_t pixel) { return std::isfinite(depth.depths[pixel]); });
  const auto shown = std::ranges::count_if(
      visible.pixels, [&](std::uint32_t pixel) { return std::ranges::binary_search(whole.pixels, pixel); });
  const double share =
      whole.pixels.empty() ? 0 : static_cast<double>(shown) / static_cast<double>(whole.pixels.size());
  return {{"bbox_obj", box_entry(whole)},
          {"bbox_visib", box_entry(visible)},
          {"px_count_all", whole.pixels.size()},
          {"px_count_valid", valid},
          {"px_count_visib", visible.pixels.size()},
          {"visib_fract", share}};
}

std::string png_of(const Mask& mask) {
  constexpr std::uint8_t inside = 255;
  std::vector<std::uint8_t> values(static_cast<std::size_t>(mask.width) *
                                   static_cast<std::size_t>(mask.height));
  for (const std::uint32_t pixel : mask.pixels) values[pixel] = inside;
  return mask_png(mask.width, mask.height, values);
}

/// The JSON files of a scene: an entry for each image, by its number.
struct SceneJson {
  Json camera = Json::object();
  Json poses = Json::object();
  Json infos = Json::object();
  Json occlusions = Json::object();
};

void add_image(const ExportScene& scene, std::size_t number, SceneJson& json, ExportFiles& files) {
  const SceneView& view = scene.views[number];
  const Camera& camera = view.scan.camera;
  const std::string key = std::to_string(number);
  const DepthImage depth = depth_image(view.scan);
  const std::vector<Mask> visible = measured_masks(view.scan, scene.tubes.size());
  files.write(depth_file(scene.place, number), depth_png(depth));
  json.camera[key] = camera_entry(camera);
  json.poses[key] = Json::array();
  json.infos[key] = Json::array();
  json.occlusions[key] = view_json(scene, view);
  for (std::size_t tube = 0; tube < scene.tubes.size(); ++tube) {
    const Mask whole = whole_mask(view.whole[tube], camera);
    files.write(mask_file(scene.place, "mask", number, tube), png_of(whole));
    files.write(mask_file(scene.place, "mask_visib", number, tube), png_of(visible[tube]));
    json.poses[key].push_back(pose_entry(scene.tubes[tube], object_number(scene.place, tube), camera));
    json.infos[key].push_back(info_entry(whole, visible[tube], depth));
  }
}

std::string write_models(const ExportScene& scene, ExportFiles& files) {
  std::string lines;
  for (std::size_t i = 0; i < scene.tubes.size(); ++i) {
    files.write(model_file(scene.place, i), model_ply(scene.tubes[i]));
    lines += fmt::format("\"{}\":{}\n", object_number(scene.place, i), json_text(model_info(scene.tubes[i])));
  }
  return lines;
}

void write_scene(const ExportUnit& unit, const SceneReader& reader, ExportFiles& files) {
  const ExportScene scene = reader.read(unit.cases.front());
  SceneJson json;
  for (std::size_t i = 0; i < scene.views.size(); ++i) add_image(scene, i, json, files);
  const std::array parts{&json.camera, &json.poses, &json.infos, &json.occlusions};
  for (std::size_t i = 0; i < parts.size(); ++i)
    files.write(fmt::format("{}/{}", scene_folder(scene.place), scene_files.at(i)),
                parts.at(i)->dump() + '\n');
  files.seal(models_file(unit), write_models(scene, files));
}

constexpr const char* models_info_file = "models/models_info.json";
constexpr const char* camera_file = "camera.json";

void write_models_info(const std::vector<ExportUnit>& units, ExportFiles& files) {
  files.seal(models_info_file, [&](const Sink& sink) {
    std::string_view separator = "{\n";
    for (const ExportUnit& unit : units) {
      for_each_line(files.directory() / models_file(unit), [&](const FileLine& line) {
        sink(separator);
        sink(line.text);
        separator = ",\n";
      });
    }
    sink("\n}\n");
  });
}

bool has_one_camera(const Recipe& recipe) {
  return recipe.further_scanners.empty() &&
         std::ranges::none_of(
             recipe.random, [](const RandomSetting& setting) { return setting.path.starts_with("scanner"); });
}

void write_camera(const Camera& camera, ExportFiles& files) {
  const Json json{{"width", camera.width},    {"height", camera.height}, {"fx", camera.fx},
                  {"fy", camera.fy},          {"cx", camera.cx},         {"cy", camera.cy},
                  {"depth_scale", depth_step}};
  files.seal(camera_file, json_text(json) + '\n');
}

}  // namespace

Format bop_format(const Recipe& recipe) {
  const bool writes_camera = has_one_camera(recipe);
  const Camera camera = recipe.camera;
  std::vector<std::string> common{models_info_file};
  if (writes_camera) common.emplace_back(camera_file);
  return {.files_of =
              [places = case_places(recipe), images = scanners(recipe).size()](const ExportUnit& unit) {
                return files_of(unit, places.at(unit.cases.front()), images);
              },
          .write = write_scene,
          .common_files = common,
          .assemble =
              [=](const std::vector<ExportUnit>& units, ExportFiles& files) {
                write_models_info(units, files);
                if (writes_camera) write_camera(camera, files);
              }};
}

}  // namespace tanglebin
