#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/recipe/randomization.hpp"
#include "tanglebin/recipe/recipe_fields.hpp"
#include "tanglebin/recipe/recipe_tree.hpp"

namespace tanglebin {
namespace {

// Calls `call` and adds file and line to its error.
template <typename Call>
auto with_place(const std::string& file, std::size_t line, Call call) {
  try {
    return call();
  } catch (const InputError& error) {
    throw InputError({file, line, ""}, error.what());
  }
}

template <typename Struct, typename Value>
void read_field(const TomlTable& table, const Field<Struct, Value>& field,
                std::type_identity_t<Struct>& values) {
  table.get(field.key, values.*field.member);
}

template <typename Struct>
void read_field(const TomlTable& table, const Field<Struct, Edges>& field,
                std::type_identity_t<Struct>& values) {
  if (!table.has(field.key)) return;
  std::string name;
  table.get(field.key, name);
  const auto known = std::ranges::find(edges_names, name, &EdgesName::name);
  if (known == edges_names.end()) table.fail(field.key, excerpt(name), "\"keep\", \"drop\" or \"mix\"");
  values.*field.member = known->edges;
}

template <typename Struct>
void read_field(const TomlTable& table, const AngleField<Struct>& field,
                std::type_identity_t<Struct>& values) {
  if (!table.has(field.key)) return;
  double degrees = 0;
  table.get(field.key, degrees);
  values.*field.member = radians_from_degrees(degrees);
}

template <typename Struct, typename... Fields>
void read_fields(const TomlTable& table, const std::tuple<Fields...>& fields, Struct& values) {
  std::apply([&](const auto&... field) { (read_field(table, field, values), ...); }, fields);
}

Bin read_bin(const TomlTable& table) {
  table.allow(all({{"preset"}, keys(bin_fields)}));
  std::string preset = "paper";
  table.get("preset", preset);
  Bin bin = with_place(table.file(), table.line("preset"), [&] { return bin_preset(preset); });
  read_fields(table, bin_fields, bin);
  return bin;
}

// The lens: the preset's, with the same horizontal field of view if the size is another, unless one of the
// three ways to set it is given.
void read_lens(const TomlTable& table, Camera& camera, const Camera& preset) {
  table.allow_one_of({"hfov_deg", "focal_length_px", "fx"});
  table.allow_one_of({"hfov_deg", "focal_length_px", "fy"});
  if (table.has("fx")) table.require({"fy"});
  if (table.has("fy")) table.require({"fx"});

  double focal_length = preset.fx * (static_cast<double>(camera.width) / preset.width);
  table.get("focal_length_px", focal_length);
  if (table.has("focal_length_px") && !(focal_length > 0))
    table.fail("focal_length_px", fmt::format("{}", focal_length), "a positive number of pixels");
  if (table.has("hfov_deg")) {
    double degrees = 0;
    table.get("hfov_deg", degrees);
    if (!(degrees > 0 && degrees < 180))
      table.fail("hfov_deg", fmt::format("{}", degrees), "an angle between 0 and 180");
    focal_length = focal_length_from_hfov(camera.width, radians_from_degrees(degrees));
  }
  camera.fx = camera.fy = focal_length;
  camera.cx = (camera.width - 1.0) / 2;
  camera.cy = (camera.height - 1.0) / 2;
  read_fields(table, camera_lens_fields, camera);
}

// A view along z to a point, with the image's x axis as close to the world's as possible.
Eigen::Matrix3d read_look_at(const TomlTable& table, const Eigen::Vector3d& position) {
  Eigen::Vector3d target;
  table.get("look_at", target);
  const Eigen::Vector3d z = (target - position).normalized();
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX() - z.x() * z;
  constexpr double smallest = 1e-3;
  if (!(x.norm() > smallest) || z.isZero())
    table.fail("look_at", "a view along the world's x axis, or from a point to itself",
               "another point, or rotation_wxyz");
  Eigen::Matrix3d rotation;
  rotation << x.normalized(), z.cross(x.normalized()), z;
  return rotation;
}

// A place on a sphere about the point that the camera looks at.
Eigen::Vector3d read_place_about(const TomlTable& table) {
  for (const std::string_view other : {"position", "rotation_wxyz", "rotation_matrix"})
    table.allow_one_of({other, "distance"});
  table.require({"look_at"});
  Eigen::Vector3d target;
  double distance = 0;
  double tilt_deg = 0;
  double azimuth_deg = 0;
  table.get("look_at", target);
  table.get("distance", distance);
  table.get("tilt_deg", tilt_deg);
  table.get("azimuth_deg", azimuth_deg);
  if (!(distance > 0)) table.fail("distance", fmt::format("{}", distance), "a positive number");
  if (!(tilt_deg >= 0 && tilt_deg <= 180))
    table.fail("tilt_deg", fmt::format("{}", tilt_deg), "an angle from 0 to 180");
  const double tilt = radians_from_degrees(tilt_deg);
  const double azimuth = radians_from_degrees(azimuth_deg);
  return target + distance * Eigen::Vector3d(std::sin(tilt) * std::cos(azimuth),
                                             std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
}

Eigen::Vector3d read_position(const TomlTable& table, const Eigen::Vector3d& preset) {
  Eigen::Vector3d position = preset;
  if (table.has("tilt_deg") || table.has("azimuth_deg")) table.require({"distance"});
  if (table.has("distance")) return read_place_about(table);
  table.get("position", position);
  return position;
}

void read_pose(const TomlTable& table, Camera& camera) {
  table.allow_one_of({"rotation_wxyz", "rotation_matrix", "look_at"});
  const Eigen::Vector3d position = read_position(table, camera.pose.translation());
  Eigen::Matrix3d rotation = camera.pose.linear();
  table.get("rotation_matrix", rotation);
  if (table.has("rotation_wxyz")) {
    Eigen::Vector4d wxyz;
    table.get("rotation_wxyz", wxyz);
    if (!(std::abs(wxyz.norm() - 1) <= 0.01))
      table.fail("rotation_wxyz", fmt::format("a quaternion of norm {:.6g}", wxyz.norm()),
                 "a unit quaternion");
    rotation = Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized().toRotationMatrix();
  }
  if (table.has("look_at")) rotation = read_look_at(table, position);
  camera.pose.translation() = position;
  camera.pose.linear() = rotation;
}

Keys scanner_keys() {
  return all({{"preset", "hfov_deg", "focal_length_px", "position", "rotation_wxyz", "rotation_matrix",
               "look_at", "distance", "tilt_deg", "azimuth_deg"},
              keys(camera_size_fields),
              keys(camera_lens_fields),
              keys(sensor_fields)});
}

Scanner read_scanner(const TomlTable& table) {
  std::string name = "paper";
  table.get("preset", name);
  const Camera preset = with_place(table.file(), table.line("preset"), [&] { return camera_preset(name); });
  Camera camera = preset;
  read_fields(table, camera_size_fields, camera);
  read_lens(table, camera, preset);
  read_pose(table, camera);
  Sensor sensor = sensor_preset(name);
  read_fields(table, sensor_fields, sensor);
  return {"", camera, sensor};
}

// A [[scanner]].
Scanner read_named_scanner(const TomlTable& table) {
  table.allow(all({{"name"}, scanner_keys()}));
  table.require({"name"});
  Scanner scanner = read_scanner(table);
  table.get("name", scanner.name);
  return scanner;
}

// One [scanner] without a name, or [[scanner]]s with names.
void read_scanners(const TomlTable& root, Recipe& recipe) {
  std::vector<Scanner> all_scanners;
  if (root.is_array("scanner")) {
    for (const TomlTable& table : root.tables("scanner")) all_scanners.push_back(read_named_scanner(table));
    if (all_scanners.empty()) root.fail("scanner", "none", "at least one [[scanner]]");
  } else {
    all_scanners.push_back(read_single_scanner(root.table("scanner")));
  }
  Scanner& first = all_scanners.front();
  recipe.scanner_name = first.name;
  recipe.camera = first.camera;
  recipe.sensor = first.sensor;
  recipe.further_scanners.assign(all_scanners.begin() + 1, all_scanners.end());
}

OutputSettings read_output(const TomlTable& table) {
  table.allow(all({keys(cloud_fields), keys(output_fields), keys(property_fields)}));
  OutputSettings settings;
  read_fields(table, cloud_fields, settings);
  read_fields(table, output_fields, settings);
  read_fields(table, property_fields, settings.properties);
  return settings;
}

template <typename Struct, typename... Fields>
Struct read_settings(const TomlTable& table, const std::tuple<Fields...>& fields) {
  table.allow(keys(fields));
  Struct settings;
  read_fields(table, fields, settings);
  return settings;
}

SegmentSpec read_segment(const TomlTable& table) {
  table.require({"length", "bend_max_deg"});
  SegmentSpec segment;
  read_fields(table, segment_end_fields, segment);
  read_fields(table, segment_fields, segment);
  return segment;
}

void read_mass(const TomlTable& table, TubeSpec& spec) {
  table.allow_one_of({"mass", "density"});
  if (!table.has("density")) {
    table.require({"mass"});
    read_fields(table, mass_fields, spec);
    return;
  }
  spec.mass = 0;
  read_fields(table, density_fields, spec);
  if (!(spec.density > 0)) table.fail("density", fmt::format("{}", spec.density), "a positive number");
}

TubeSpec read_tube(const TomlTable& table) {
  table.allow(all({{"weight"}, tube_keys()}));
  table.require({"radius"});
  TubeSpec spec;
  read_fields(table, tube_fields, spec);
  read_mass(table, spec);
  if (!table.has("segment")) {
    spec.segments = {read_segment(table)};
    return spec;
  }
  for (const std::string_view key : keys(segment_fields)) table.allow_one_of({"segment", key});
  spec.segments.clear();
  for (const TomlTable& segment : table.tables("segment")) {
    segment.allow(all({keys(segment_end_fields), keys(segment_fields)}));
    segment.require({"from", "to"});
    spec.segments.push_back(read_segment(segment));
  }
  return spec;
}

// One [set.tube], or a [[set.tube]] for each kind.
std::vector<TomlTable> tables_of_kinds(const TomlTable& set) {
  if (!set.is_array("tube")) return {set.table("tube")};
  std::vector<TomlTable> tables = set.tables("tube");
  if (tables.empty()) set.fail("tube", "none", "at least one [[set.tube]]");
  return tables;
}

// Either all kinds have a weight or none has.
std::vector<double> read_weights(const std::vector<TomlTable>& kinds) {
  if (std::ranges::none_of(kinds, [](const TomlTable& kind) { return kind.has("weight"); })) return {};
  std::vector<double> weights(kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    kinds[i].require({"weight"});
    kinds[i].get("weight", weights[i]);
  }
  return weights;
}

// A list, or a random number that each case draws.
void read_numbers_of_tubes(const TomlTable& table, SetRecipe& set) {
  if (const toml::table* number = table.raw_table("tubes")) {
    set.drawn_tubes = read_random_number(*number, table.path_of("tubes"), table.source());
  } else {
    table.get("tubes", set.tubes);
  }
}

SetRecipe read_set(const TomlTable& table) {
  table.allow({"name", "tubes", "cases", "tube"});
  table.require({"name", "tubes", "tube"});
  SetRecipe set;
  table.get("name", set.name);
  read_numbers_of_tubes(table, set);
  table.get("cases", set.cases);
  const std::vector<TomlTable> kinds = tables_of_kinds(table);
  set.kinds.clear();
  for (const TomlTable& kind : kinds) set.kinds.push_back(read_tube(kind));
  set.weights = read_weights(kinds);
  return set;
}

Recipe read_root(const TomlTable& root) {
  root.allow({"format", "seed", "attempts", "bin", "scanner", "settle", "output", "tube", "set"});
  Recipe recipe;
  root.get("seed", recipe.seed);
  root.get("attempts", recipe.attempts);
  recipe.bin = read_bin(root.table("bin"));
  read_scanners(root, recipe);
  recipe.settle = read_settings<SettleSettings>(root.table("settle"), settle_fields);
  recipe.output = read_output(root.table("output"));
  for (const TomlTable& set : root.tables("set")) recipe.sets.push_back(read_set(set));
  return recipe;
}

// The line of what validate() calls `field`, or else of the innermost table around it. An angle's key has its
// unit.
std::size_t line_of(const TomlSource& source, std::string field) {
  while (!field.empty()) {
    for (const char* unit : {"", "_deg"})
      if (const std::size_t line = source.line(field + unit)) return line;
    const std::size_t last = field.find_last_of(".[");
    field.resize(last == std::string::npos ? 0 : last);
  }
  return 0;
}

}  // namespace

Scanner read_single_scanner(const TomlTable& table) {
  table.allow(scanner_keys());
  return read_scanner(table);
}

void validate_at(const TomlSource& source, const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    throw InputError({source.file(), line_of(source, error.place().field), ""}, error.what());
  }
}

Recipe read_tree(const toml::table& tree, const TomlSource& source) {
  Recipe recipe = read_root({source, tree, ""});
  validate_at(source, [&] { validate(recipe); });
  return recipe;
}

}  // namespace tanglebin
