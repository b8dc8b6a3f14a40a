#include "tanglebin/recipe/recipe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <istream>
#include <limits>
#include <numbers>
#include <ostream>
#include <string_view>
#include <tuple>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/recipe/randomization.hpp"
#include "tanglebin/recipe/toml_table.hpp"

namespace tanglebin {
namespace {

// Keys and what they stand for: a line here is all that a new setting needs to be read and written.

template <typename Struct, typename Value>
struct Field {
  const char* key;
  Value Struct::*member;
};
template <typename Struct, typename Value>
Field(const char*, Value Struct::*) -> Field<Struct, Value>;

/// Degrees in the recipe, radians in the struct.
template <typename Struct>
struct AngleField {
  const char* key;
  double Struct::*member;
};
template <typename Struct>
AngleField(const char*, double Struct::*) -> AngleField<Struct>;

constexpr std::tuple bin_fields{
    Field{"length", &Bin::length}, Field{"width", &Bin::width},       Field{"height", &Bin::height},
    Field{"wall", &Bin::wall},     Field{"friction", &Bin::friction},
};
constexpr std::tuple camera_size_fields{
    Field{"width", &Camera::width},
    Field{"height", &Camera::height},
};
constexpr std::tuple camera_lens_fields{
    Field{"fx", &Camera::fx},
    Field{"fy", &Camera::fy},
    Field{"cx", &Camera::cx},
    Field{"cy", &Camera::cy},
};
constexpr std::tuple sensor_fields{
    Field{"sigma", &Sensor::sigma},
    Field{"dropout", &Sensor::dropout},
    Field{"edges", &Sensor::edges},
    Field{"footprint", &Sensor::footprint},
    Field{"sub_rays", &Sensor::sub_rays},
    Field{"edge_jump", &Sensor::edge_jump},
    Field{"shadows", &Sensor::shadows},
    Field{"baseline", &Sensor::baseline},
    Field{"working_distance", &Sensor::working_distance},
    Field{"signal", &Sensor::signal},
    Field{"snr", &Sensor::snr},
    Field{"snr_min", &Sensor::snr_min},
    Field{"snr_max", &Sensor::snr_max},
    Field{"albedo_min", &Sensor::albedo_min},
    Field{"albedo_max", &Sensor::albedo_max},
    Field{"gloss_min", &Sensor::gloss_min},
    Field{"gloss_max", &Sensor::gloss_max},
    Field{"shininess", &Sensor::shininess},
    Field{"bin_albedo", &Sensor::bin_albedo},
    Field{"bin_gloss", &Sensor::bin_gloss},
    Field{"disparity_sigma", &Sensor::disparity_sigma},
    Field{"trueness", &Sensor::trueness},
    Field{"trueness_length", &Sensor::trueness_length},
    Field{"kinect_noise", &Sensor::kinect_noise},
};
constexpr std::tuple settle_fields{
    Field{"gravity", &SettleSettings::gravity},
    Field{"friction", &SettleSettings::friction},
    Field{"step", &SettleSettings::step},
    Field{"iterations", &SettleSettings::iterations},
    Field{"iterations_max", &SettleSettings::iterations_max},
    Field{"sor", &SettleSettings::sor},
    Field{"erp", &SettleSettings::erp},
    Field{"surface_layer", &SettleSettings::surface_layer},
    Field{"correction_speed", &SettleSettings::correction_speed},
    Field{"calm_speed", &SettleSettings::calm_speed},
    Field{"calm_time", &SettleSettings::calm_time},
    Field{"calm_damping", &SettleSettings::calm_damping},
    Field{"rest_speed", &SettleSettings::rest_speed},
    Field{"rest_time", &SettleSettings::rest_time},
    Field{"proof_time", &SettleSettings::proof_time},
    Field{"proof_motion", &SettleSettings::proof_motion},
    Field{"overlap_max", &SettleSettings::overlap_max},
    Field{"time_limit", &SettleSettings::time_limit},
};
constexpr std::tuple output_fields{
    Field{"bin_points", &OutputSettings::bin_points},
    Field{"worlds", &OutputSettings::worlds},
    Field{"pcds", &OutputSettings::pcds},
    Field{"depths", &OutputSettings::depths},
    Field{"labels", &OutputSettings::labels},
};
constexpr std::tuple property_fields{
    Field{"normals", &PointProperties::normals},
    Field{"intensities", &PointProperties::intensities},
    Field{"mixed", &PointProperties::mixed},
};
constexpr std::tuple tube_fields{
    Field{"radius", &TubeSpec::radius},
    Field{"mass", &TubeSpec::mass},
};
constexpr std::tuple segment_end_fields{
    Field{"from", &Segment::from},
    Field{"to", &Segment::to},
};
constexpr std::tuple segment_fields{
    Field{"length", &Segment::length},
    Field{"cylinders_min", &Segment::cylinders_min},
    Field{"cylinders_max", &Segment::cylinders_max},
    Field{"cylinder_length_min", &Segment::cylinder_length_min},
    AngleField{"bend_min_deg", &Segment::bend_min},
    AngleField{"bend_max_deg", &Segment::bend_max},
};

struct EdgesName {
  Edges edges;
  std::string_view name;
};
constexpr std::array<EdgesName, 3> edges_names{
    {{Edges::keep, "keep"}, {Edges::drop, "drop"}, {Edges::mix, "mix"}}};

using Keys = std::vector<std::string_view>;

template <typename... Fields>
Keys keys(const std::tuple<Fields...>& fields) {
  return std::apply([](const auto&... field) { return Keys{field.key...}; }, fields);
}

Keys all(std::initializer_list<Keys> lists) {
  Keys result;
  for (const Keys& list : lists) result.insert(result.end(), list.begin(), list.end());
  return result;
}

// Degrees

double radians_from_degrees(double degrees) {
  constexpr double radians_per_degree = std::numbers::pi / 180;
  return degrees * radians_per_degree;
}

// The shortest degrees that read_recipe turns into exactly these radians. Where the radians came from degrees
// there are some: rounding puts them at most two doubles from the quotient.
std::string degrees_text(double radians) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double nearest = radians / radians_from_degrees(1);
  const double below = std::nextafter(nearest, -infinity);
  const double above = std::nextafter(nearest, infinity);
  std::string shortest;
  for (const double degrees :
       {nearest, below, above, std::nextafter(below, -infinity), std::nextafter(above, infinity)}) {
    const std::string text = real_text(degrees);
    if (radians_from_degrees(degrees) == radians && (shortest.empty() || text.size() < shortest.size()))
      shortest = text;
  }
  return shortest.empty() ? real_text(nearest) : shortest;
}

// Reading

// Calls `call`; an error of its gets the place in the recipe.
template <typename Call>
auto with_place(const std::string& file, std::size_t line, Call call) {
  try {
    return call();
  } catch (const InputError& error) {
    throw InputError({file, line, ""}, error.what());
  }
}

template <typename Struct, typename Value>
void read_field(const TomlTable& table, const Field<Struct, Value>& field, Struct& values) {
  table.get(field.key, values.*field.member);
}

template <typename Struct>
void read_field(const TomlTable& table, const Field<Struct, Edges>& field, Struct& values) {
  if (!table.has(field.key)) return;
  std::string name;
  table.get(field.key, name);
  const auto known = std::ranges::find(edges_names, name, &EdgesName::name);
  if (known == edges_names.end()) table.fail(field.key, excerpt(name), "\"keep\", \"drop\" or \"mix\"");
  values.*field.member = known->edges;
}

template <typename Struct>
void read_field(const TomlTable& table, const AngleField<Struct>& field, Struct& values) {
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

// How the camera sees: as the preset, with the same horizontal field of view where the size is another,
// unless one of the three ways to say it is there.
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

// The view along z to a point, the image's x axis as near to the world's as can be.
Eigen::Matrix3d read_look_at(const TomlTable& table, const Eigen::Vector3d& position) {
  Eigen::Vector3d target;
  table.get("look_at", target);
  const Eigen::Vector3d z = (target - position).normalized();
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX() - z.x() * z;
  constexpr double smallest = 1e-3;
  if (!(x.norm() > smallest) || z.isZero())
    table.fail("look_at", "a view along the world's x axis, or nowhere",
               "a point elsewhere, or rotation_wxyz for such a view");
  Eigen::Matrix3d rotation;
  rotation << x.normalized(), z.cross(x.normalized()), z;
  return rotation;
}

void read_pose(const TomlTable& table, Camera& camera) {
  table.allow_one_of({"rotation_wxyz", "rotation_matrix", "look_at"});
  Eigen::Vector3d position = camera.pose.translation();
  Eigen::Matrix3d rotation = camera.pose.linear();
  table.get("position", position);
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
  return all(
      {{"preset", "hfov_deg", "focal_length_px", "position", "rotation_wxyz", "rotation_matrix", "look_at"},
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

// The one [scanner] of a recipe.
Scanner read_single_scanner(const TomlTable& table) {
  table.allow(scanner_keys());
  return read_scanner(table);
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
  table.allow(all({keys(output_fields), keys(property_fields)}));
  OutputSettings settings;
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

Segment read_segment(const TomlTable& table) {
  table.require({"length", "bend_max_deg"});
  Segment segment;
  read_fields(table, segment_end_fields, segment);
  read_fields(table, segment_fields, segment);
  return segment;
}

TubeSpec read_tube(const TomlTable& table) {
  table.allow(all({keys(tube_fields), keys(segment_fields), {"segment"}}));
  table.require({"radius", "mass"});
  TubeSpec spec;
  read_fields(table, tube_fields, spec);
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
std::vector<TubeSpec> read_kinds(const TomlTable& set) {
  if (!set.is_array("tube")) return {read_tube(set.table("tube"))};
  std::vector<TubeSpec> kinds;
  for (const TomlTable& table : set.tables("tube")) kinds.push_back(read_tube(table));
  if (kinds.empty()) set.fail("tube", "none", "at least one [[set.tube]]");
  return kinds;
}

SetRecipe read_set(const TomlTable& table) {
  table.allow({"name", "tubes", "cases", "tube"});
  table.require({"name", "tubes", "tube"});
  SetRecipe set;
  table.get("name", set.name);
  table.get("tubes", set.tubes);
  table.get("cases", set.cases);
  set.kinds = read_kinds(table);
  return set;
}

Recipe read_root(const TomlTable& root) {
  root.allow({"seed", "attempts", "bin", "scanner", "settle", "output", "set"});
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

// In ASCII: all that a recipe says is, and comments do not matter. For toml++ 3.3 must not be given other
// characters where TOML allows none (it runs into __builtin_unreachable); it refuses '?' there.
std::string ascii(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) > 127; }, '?');
  return text;
}

std::string lines_of(std::istream& in) {
  std::string text;
  for (std::string line; std::getline(in, line);) text += line + '\n';
  return text;
}

toml::table parse(const std::string& text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    // What it saw may be the end of a line.
    std::string problem(error.description());
    std::ranges::replace_if(
        problem, [](char c) { return c < ' '; }, ' ');
    throw InputError({name, error.source().begin.line, ""}, problem);
  }
}

// The line that says what validate() calls `field`, or else of the innermost table around it. An angle's key
// tells its unit.
std::size_t line_of(const toml::table& root, std::string field) {
  while (!field.empty()) {
    for (const char* unit : {"", "_deg"})
      if (const auto found = toml::at_path(root, field + unit)) return found.node()->source().begin.line;
    const std::size_t last = field.find_last_of(".[");
    field.resize(last == std::string::npos ? 0 : last);
  }
  return 0;
}

// Calls `call`, which validates what was read; an error of its gets the line that it is about.
template <typename Call>
void validate_at(const std::string& name, const toml::table& root, Call call) {
  try {
    call();
  } catch (const InputError& error) {
    throw InputError({name, line_of(root, error.place().field), ""}, error.what());
  }
}

// The words that stand for themselves in TOML.
constexpr std::array<std::string_view, 4> toml_words{"true", "false", "inf", "nan"};

// A setting of the command line, key=value, where a string needs no quotation marks.
std::string toml_line(const std::string& setting) {
  const std::size_t middle = setting.find('=');
  if (middle == std::string::npos || middle + 1 == setting.size()) return setting;
  const std::string value = setting.substr(middle + 1);
  const bool begins_with_letter =
      (value[0] >= 'a' && value[0] <= 'z') || (value[0] >= 'A' && value[0] <= 'Z');
  const bool is_string = begins_with_letter && std::ranges::find(toml_words, value) == toml_words.end();
  return is_string ? fmt::format("{} = {:?}", setting.substr(0, middle), value) : setting;
}

// Writing

std::string value_text(double value) {
  return real_text(value);
}
std::string value_text(int value) {
  return fmt::format("{}", value);
}
std::string value_text(bool value) {
  return value ? "true" : "false";
}
std::string value_text(Edges value) {
  return fmt::format("\"{}\"", std::ranges::find(edges_names, value, &EdgesName::edges)->name);
}

template <typename Vector>
std::string vector_text(const Vector& values) {
  std::vector<std::string> texts;
  for (Eigen::Index i = 0; i < values.size(); ++i) texts.push_back(real_text(values[i]));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

template <typename Struct, typename Value>
std::string field_text(const Field<Struct, Value>& field, const Struct& values) {
  return fmt::format("{} = {}\n", field.key, value_text(values.*field.member));
}

template <typename Struct>
std::string field_text(const AngleField<Struct>& field, const Struct& values) {
  return fmt::format("{} = {}\n", field.key, degrees_text(values.*field.member));
}

template <typename Struct, typename... Fields>
std::string fields_text(const std::tuple<Fields...>& fields, const Struct& values) {
  return std::apply([&](const auto&... field) { return (field_text(field, values) + ...); }, fields);
}

std::string scanner_text(const Scanner& scanner) {
  const Camera& camera = scanner.camera;
  const Eigen::Vector3d position = camera.pose.translation();
  const Eigen::Matrix3d rotation = camera.pose.linear();
  const std::string header =
      scanner.name.empty() ? "\n[scanner]\n" : fmt::format("\n[[scanner]]\nname = \"{}\"\n", scanner.name);
  return header + fields_text(camera_size_fields, camera) + fields_text(camera_lens_fields, camera) +
         fmt::format("position = {}\n", vector_text(position)) +
         fmt::format("rotation_matrix = [{}, {}, {}]\n", vector_text(rotation.row(0)),
                     vector_text(rotation.row(1)), vector_text(rotation.row(2))) +
         // The paper's ideal scanner is told by its camera alone.
         (scanner.sensor == Sensor{} ? "" : fields_text(sensor_fields, scanner.sensor));
}

std::string output_text(const OutputSettings& output) {
  return fields_text(output_fields, output) +
         (output.properties == PointProperties{} ? "" : fields_text(property_fields, output.properties));
}

std::string tube_text(const TubeSpec& spec, std::string_view header) {
  std::string text = fmt::format("\n{}\n", header) + fields_text(tube_fields, spec);
  const bool is_chain = spec.segments.size() == 1;
  for (const Segment& segment : spec.segments) {
    if (!is_chain) text += "\n[[set.tube.segment]]\n" + fields_text(segment_end_fields, segment);
    text += fields_text(segment_fields, segment);
  }
  return text;
}

std::string set_text(const SetRecipe& set) {
  std::string text = fmt::format("\n[[set]]\nname = \"{}\"\ntubes = [{}]\ncases = {}\n", set.name,
                                 fmt::join(set.tubes, ", "), set.cases);
  const bool is_single = set.kinds.size() == 1;
  for (const TubeSpec& kind : set.kinds) text += tube_text(kind, is_single ? "[set.tube]" : "[[set.tube]]");
  return text;
}

std::string text_of(const Recipe& recipe) {
  std::string text = "# A resolved recipe: every value is here, presets are spelled out.\n" +
                     fmt::format("seed = {}\nattempts = {}\n", recipe.seed, recipe.attempts) +
                     fmt::format("\n[bin]\n{}", fields_text(bin_fields, recipe.bin));
  for (const Scanner& scanner : scanners(recipe)) text += scanner_text(scanner);
  text += fmt::format("\n[settle]\n{}", fields_text(settle_fields, recipe.settle)) +
          fmt::format("\n[output]\n{}", output_text(recipe.output));
  for (const SetRecipe& set : recipe.sets) text += set_text(set);
  return recipe.random.empty() ? text : with_settings(text, recipe.random);
}

// Reading, with random numbers

Recipe read_text(const std::string& text, const std::string& name) {
  const toml::table root = parse(text, name);
  Recipe recipe = read_root({name, root, ""});
  validate_at(name, root, [&] { validate(recipe); });
  return recipe;
}

// Which cases there are, and what they follow from, is not drawn.
void expect_drawable(const RandomNumber& number, const std::string& name) {
  const std::string& path = number.path;
  const bool structural = path == "seed" || path == "attempts" || path.ends_with(".cases") ||
                          path.find(".tubes") != std::string::npos;
  if (structural) throw InputError({name, number.line, path}, "a number to be drawn", "a fixed one");
}

// Without one of these, the resolved recipe could not tell what the field of view of another size is.
void expect_lens_of_random_size(const std::vector<RandomSetting>& settings, const std::string& name) {
  const auto said = [&](const std::string& table, std::string_view key) {
    return std::ranges::any_of(
        settings, [&](const RandomSetting& setting) { return setting.table == table && setting.key == key; });
  };
  for (const RandomSetting& setting : settings) {
    if (setting.key != "width" && setting.key != "height") continue;
    if (!setting.table.starts_with("scanner")) continue;
    const std::string& table = setting.table;
    if (said(table, "hfov_deg") || said(table, "focal_length_px") || said(table, "fx")) continue;
    throw InputError({name, 0, table + "." + setting.key}, "an image whose size is drawn",
                     "hfov_deg, focal_length_px or fx and fy beside it");
  }
}

// Reads the recipe with the lowest and with the highest numbers, and with each alone at either end of its
// range or at any number of its list.
Recipe read_random(const std::string& text, const toml::table& root, const std::vector<RandomNumber>& numbers,
                   const std::string& name) {
  for (const RandomNumber& number : numbers) expect_drawable(number, name);
  std::vector<double> lows(numbers.size());
  std::vector<double> highs(numbers.size());
  std::ranges::transform(numbers, lows.begin(), lowest);
  std::ranges::transform(numbers, highs.begin(), highest);
  read_text(with_numbers(text, numbers, highs), name);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::vector<double> one_other = lows;
    for (const double number : numbers_to_try(numbers[i])) {
      one_other[i] = number;
      read_text(with_numbers(text, numbers, one_other), name);
    }
  }
  Recipe recipe = read_text(with_numbers(text, numbers, lows), name);
  recipe.random = random_settings(root);
  expect_lens_of_random_size(recipe.random, name);
  const std::string written = text_of(recipe);
  if (find_random_numbers(parse(written, name), written, name).size() != numbers.size()) {
    throw InputError({name, numbers.front().line, numbers.front().path},
                     "a number to be drawn in a tree of one segment",
                     "the segment's keys in [set.tube] itself");
  }
  return recipe;
}

bool concerns(const RandomNumber& number, const Recipe& recipe, const CaseId& id) {
  if (!number.path.starts_with("set[")) return true;
  const auto set = std::ranges::find(recipe.sets, id.set, &SetRecipe::name);
  return number.path.starts_with(fmt::format("set[{}].", set - recipe.sets.begin()));
}

std::size_t index_in(const std::string& path) {
  return std::stoul(path.substr(path.find('[') + 1));
}

// What a number is drawn by: its path without the place that its set or scanner has among the others. (A
// case's seed knows the set's name.)
std::string name_of(const RandomNumber& number, const Recipe& recipe) {
  const std::string& path = number.path;
  const auto after_index = [&] { return path.substr(path.find(']') + 1); };
  if (path.starts_with("set[")) return "set" + after_index();
  if (path.starts_with("scanner["))
    return fmt::format("scanner.{}{}", scanners(recipe).at(index_in(path)).name, after_index());
  return path;
}

}  // namespace

const TubeSpec& kind_of(const SetRecipe& set, int tube) {
  return set.kinds[static_cast<std::size_t>(tube - 1) % set.kinds.size()];
}

const SetRecipe& set_named(const Recipe& recipe, const std::string& name) {
  const auto found = std::ranges::find(recipe.sets, name, &SetRecipe::name);
  if (found == recipe.sets.end()) throw InputError({"", 0, "set"}, excerpt(name), "a set of the recipe");
  return *found;
}

std::vector<Scanner> scanners(const Recipe& recipe) {
  std::vector<Scanner> all{{recipe.scanner_name, recipe.camera, recipe.sensor}};
  all.insert(all.end(), recipe.further_scanners.begin(), recipe.further_scanners.end());
  return all;
}

std::vector<DrawnNumber> draw(const Recipe& recipe, const CaseId& id) {
  if (recipe.random.empty()) return {};
  const std::string text = text_of(recipe);
  std::vector<DrawnNumber> drawn;
  for (const RandomNumber& number : find_random_numbers(parse(text, ""), text, "")) {
    if (!concerns(number, recipe, id)) continue;
    drawn.push_back({number.path, draw_number(number, name_of(number, recipe), recipe.seed, id)});
  }
  return drawn;
}

Recipe resolve(const Recipe& recipe, const std::vector<DrawnNumber>& drawn) {
  if (recipe.random.empty()) return recipe;
  const std::string text = text_of(recipe);
  const std::vector<RandomNumber> places = find_random_numbers(parse(text, ""), text, "");
  std::vector<double> numbers;
  for (const RandomNumber& place : places) {
    const auto found = std::ranges::find(drawn, place.path, &DrawnNumber::path);
    if (found == drawn.end() && !place.path.starts_with("set["))
      throw InputError({"", 0, place.path}, "has not been drawn");
    numbers.push_back(found == drawn.end() ? lowest(place) : found->value);
  }
  return read_text(with_numbers(text, places, numbers), "");
}

Scanner scanner_with(const std::string& preset, const std::vector<std::string>& settings,
                     const std::string& option) {
  std::string text;
  for (const std::string& setting : settings) text += toml_line(ascii(setting)) + '\n';
  text += fmt::format("scanner.preset = {:?}\n", ascii(preset));
  const toml::table root = parse(text, option);
  const TomlTable table(option, root, "");
  table.allow({"scanner"});
  Scanner scanner = read_single_scanner(table.table("scanner"));
  validate_at(option, root, [&] {
    validate(scanner.camera);
    validate(scanner.sensor);
  });
  return scanner;
}

Recipe read_recipe(std::istream& in, const std::string& name) {
  const std::string text = ascii(lines_of(in));
  if (in.bad()) throw InputError({name, 0, ""}, "cannot be read");
  const toml::table root = parse(text, name);
  const std::vector<RandomNumber> numbers = find_random_numbers(root, text, name);
  return numbers.empty() ? read_text(text, name) : read_random(text, root, numbers, name);
}

Recipe read_recipe(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw InputError({file.string(), 0, ""}, fmt::format("cannot be opened: {}", std::strerror(errno)));
  return read_recipe(in, file.string());
}

void write_recipe(std::ostream& out, const Recipe& recipe) {
  out << text_of(recipe);
}

}  // namespace tanglebin
