#include <fmt/format.h>

#include <algorithm>
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

// Not in the namespace below: read_fields() finds it by its arguments.
template <typename Struct>
static void read_field(const TomlTable& table, const Field<Struct, Edges>& field,
                       std::type_identity_t<Struct>& values) {
  if (!table.has(field.key)) return;
  std::string name;
  table.get(field.key, name);
  const auto known = std::ranges::find(edges_names, name, &EdgesName::name);
  if (known == edges_names.end()) table.fail(field.key, excerpt(name), "\"keep\", \"drop\" or \"mix\"");
  values.*field.member = known->edges;
}

namespace {

Bin read_bin(const TomlTable& table) {
  table.allow(all({{"preset"}, keys(bin_fields)}));
  std::string preset = "paper";
  table.get("preset", preset);
  Bin bin = with_place(table.place("preset"), [&] { return bin_preset(preset); });
  read_fields(table, bin_fields, bin);
  return bin;
}

Keys scanner_keys() {
  return all({{"preset"}, scanner_setting_keys()});
}

Scanner read_scanner(const TomlTable& table) {
  std::string name = "paper";
  table.get("preset", name);
  const Camera camera = with_place(table.place("preset"), [&] { return camera_preset(name); });
  return with_settings({"", camera, sensor_preset(name)}, table);
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
  table.allow(all({keys(cloud_fields), keys(output_fields), keys(occlusion_fields), keys(property_fields)}));
  OutputSettings settings;
  read_fields(table, cloud_fields, settings);
  read_fields(table, occlusion_fields, settings);
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

// A tree.
std::vector<SegmentSpec> read_segments(const TomlTable& table) {
  std::vector<SegmentSpec> segments;
  for (const TomlTable& segment : table.tables("segment")) {
    segment.allow(all({keys(segment_end_fields), keys(segment_fields)}));
    segment.require({"from", "to"});
    segments.push_back(read_segment(segment));
  }
  return segments;
}

Piece read_piece(const TomlTable& table) {
  table.allow(all({keys(straight_fields), keys(arc_fields)}));
  Piece piece;
  read_fields(table, straight_fields, piece);
  read_fields(table, arc_fields, piece);
  for (const std::string_view key : keys(arc_fields)) table.allow_one_of({"length", key});
  if (!table.has("length")) {
    table.require({"bend_deg", "bend_radius"});
    if (piece.bend == 0) table.fail("bend_deg", "0", "more than 0; a straight piece has a length");
  }
  return piece;
}

// A bar.
std::vector<Piece> read_pieces(const TomlTable& table) {
  std::vector<Piece> pieces;
  for (const TomlTable& piece : table.tables("piece")) pieces.push_back(read_piece(piece));
  if (pieces.empty()) table.fail("piece", "none", "at least one piece");
  return pieces;
}

// Either all in one way or all in the other.
void read_shape(const TomlTable& table, TubeSpec& spec) {
  for (const std::string_view key : keys(segment_fields)) table.allow_one_of({"segment", "piece", key});
  table.allow_one_of({"segment", "piece"});
  if (table.has("piece")) {
    spec.segments.clear();
    spec.pieces = read_pieces(table);
  } else if (table.has("segment")) {
    spec.segments = read_segments(table);
  } else {
    spec.segments = {read_segment(table)};
  }
}

bool read_flat_ends(const TomlTable& table) {
  std::string ends = "round";
  table.get("ends", ends);
  if (ends != "round" && ends != "flat") table.fail("ends", excerpt(ends), "\"round\" or \"flat\"");
  return ends == "flat";
}

TubeSpec read_tube(const TomlTable& table) {
  table.allow(all({{"weight"}, tube_keys()}));
  table.require({"radius"});
  TubeSpec spec;
  read_fields(table, tube_fields, spec);
  spec.flat_ends = read_flat_ends(table);
  read_mass(table, spec);
  read_shape(table, spec);
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

}  // namespace

Keys scanner_setting_keys() {
  return all({camera_intrinsics_keys(), camera_pose_keys(), keys(sensor_fields), keys(image_fields)});
}

Scanner with_settings(Scanner scanner, const TomlTable& table) {
  const Camera given = scanner.camera;
  read_camera_intrinsics(table, given, scanner.camera);
  read_camera_pose(table, scanner.camera);
  read_fields(table, sensor_fields, scanner.sensor);
  read_fields(table, image_fields, scanner.sensor);
  return scanner;
}

Scanner read_single_scanner(const TomlTable& table) {
  table.allow(scanner_keys());
  return read_scanner(table);
}

Recipe read_tree(const toml::table& tree, const TomlSource& source) {
  Recipe recipe = read_root({source, tree, ""});
  validate_at(source, [&] { validate(recipe); });
  return recipe;
}

}  // namespace tanglebin
