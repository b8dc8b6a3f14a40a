#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/recipe/randomization.hpp"
#include "tanglebin/recipe/recipe_fields.hpp"
#include "tanglebin/recipe/recipe_tree.hpp"

namespace tanglebin {
namespace {

// The shortest degrees that read_recipe turns into exactly these radians. If the radians came from degrees,
// there are some: rounding puts them at most two doubles from the quotient.
double degrees_from_radians(double radians) {
  const double nearest = radians / radians_from_degrees(1);
  const double below = std::nextafter(nearest, -infinity);
  const double above = std::nextafter(nearest, infinity);
  double shortest = nearest;
  std::size_t size = std::numeric_limits<std::size_t>::max();
  for (const double degrees :
       {nearest, below, above, std::nextafter(below, -infinity), std::nextafter(above, infinity)}) {
    const std::size_t digits = real_text(degrees).size();
    if (radians_from_degrees(degrees) != radians || digits >= size) continue;
    shortest = degrees;
    size = digits;
  }
  return shortest;
}

toml::array array_of(const auto& values) {
  toml::array array;
  for (const auto value : values) array.push_back(value);
  return array;
}

toml::array rows_of(const Eigen::Matrix3d& matrix) {
  toml::array rows;
  for (const auto& row : matrix.rowwise()) rows.push_back(array_of(row));
  return rows;
}

template <typename Struct, typename Value>
void put_field(toml::table& table, const Field<Struct, Value>& field,
               const std::type_identity_t<Struct>& values) {
  table.insert(field.key, values.*field.member);
}

template <typename Struct>
void put_field(toml::table& table, const Field<Struct, Edges>& field,
               const std::type_identity_t<Struct>& values) {
  const auto edges = std::ranges::find(edges_names, values.*field.member, &EdgesName::edges);
  table.insert(field.key, edges->name);
}

template <typename Struct>
void put_field(toml::table& table, const AngleField<Struct>& field,
               const std::type_identity_t<Struct>& values) {
  table.insert(field.key, degrees_from_radians(values.*field.member));
}

template <typename Struct, typename... Fields>
void put_fields(toml::table& table, const std::tuple<Fields...>& fields, const Struct& values) {
  std::apply([&](const auto&... field) { (put_field(table, field, values), ...); }, fields);
}

template <typename Struct, typename... Fields>
toml::table table_of(const std::tuple<Fields...>& fields, const Struct& values) {
  toml::table table;
  put_fields(table, fields, values);
  return table;
}

bool alters_the_image(const Sensor& sensor) {
  const Sensor off;
  return sensor.column_correlation != off.column_correlation || sensor.quantization != off.quantization ||
         sensor.fill != off.fill || sensor.median != off.median;
}

toml::table scanner_table(const Scanner& scanner) {
  const Camera& camera = scanner.camera;
  toml::table table = table_of(camera_size_fields, camera);
  if (!scanner.name.empty()) table.insert("name", scanner.name);
  put_fields(table, camera_lens_fields, camera);
  const Eigen::Vector3d position = camera.pose.translation();
  table.insert("position", array_of(position));
  table.insert("rotation_matrix", rows_of(camera.pose.linear()));
  // The camera alone says that a scanner is the paper's ideal one.
  if (scanner.sensor != Sensor{}) put_fields(table, sensor_fields, scanner.sensor);
  if (alters_the_image(scanner.sensor)) put_fields(table, image_fields, scanner.sensor);
  return table;
}

toml::table output_table(const OutputSettings& output) {
  toml::table table = table_of(output_fields, output);
  if (!output.plys) put_fields(table, cloud_fields, output);
  if (output.occlusions) put_fields(table, occlusion_fields, output);
  if (output.properties != PointProperties{}) put_fields(table, property_fields, output.properties);
  return table;
}

toml::array piece_tables(const std::vector<Piece>& pieces) {
  toml::array tables;
  for (const Piece& piece : pieces)
    tables.push_back(piece.bend == 0 ? table_of(straight_fields, piece) : table_of(arc_fields, piece));
  return tables;
}

toml::table tube_table(const TubeSpec& spec) {
  toml::table table = table_of(tube_fields, spec);
  if (spec.flat_ends) table.insert("ends", "flat");
  if (spec.density == 0) {
    put_fields(table, mass_fields, spec);
  } else {
    put_fields(table, density_fields, spec);
  }
  if (!spec.pieces.empty()) {
    table.insert("piece", piece_tables(spec.pieces));
    return table;
  }
  if (spec.segments.size() == 1) {
    put_fields(table, segment_fields, spec.segments.front());
    return table;
  }
  toml::array segments;
  for (const SegmentSpec& segment : spec.segments) {
    toml::table inner = table_of(segment_end_fields, segment);
    put_fields(inner, segment_fields, segment);
    segments.push_back(std::move(inner));
  }
  table.insert("segment", std::move(segments));
  return table;
}

toml::table kind_table(const SetRecipe& set, std::size_t kind) {
  toml::table table = tube_table(set.kinds[kind]);
  if (!set.weights.empty()) table.insert("weight", set.weights[kind]);
  return table;
}

toml::table set_table(const SetRecipe& set) {
  toml::table table;
  table.insert("name", set.name);
  if (set.drawn_tubes) {
    table.insert("tubes", random_table(*set.drawn_tubes, true));
  } else {
    table.insert("tubes", array_of(set.tubes));
  }
  table.insert("cases", set.cases);
  if (set.kinds.size() == 1) {
    table.insert("tube", kind_table(set, 0));
    return table;
  }
  toml::array kinds;
  for (std::size_t i = 0; i < set.kinds.size(); ++i) kinds.push_back(kind_table(set, i));
  table.insert("tube", std::move(kinds));
  return table;
}

void put_scanners(toml::table& tree, const Recipe& recipe) {
  const std::vector<Scanner> all = scanners(recipe);
  if (all.front().name.empty()) {
    tree.insert("scanner", scanner_table(all.front()));
    return;
  }
  toml::array tables;
  for (const Scanner& scanner : all) tables.push_back(scanner_table(scanner));
  tree.insert("scanner", std::move(tables));
}

}  // namespace

std::string path_of_kind(const Recipe& recipe, std::size_t set, std::size_t kind) {
  const std::string path = fmt::format("set[{}].tube", set);
  return recipe.sets[set].kinds.size() == 1 ? path : fmt::format("{}[{}]", path, kind);
}

toml::table tree_of(const Recipe& recipe) {
  toml::table tree;
  tree.insert("format", recipe_format);
  tree.insert("seed", static_cast<std::int64_t>(recipe.seed));
  tree.insert("attempts", recipe.attempts);
  tree.insert("bin", table_of(bin_fields, recipe.bin));
  put_scanners(tree, recipe);
  tree.insert("settle", table_of(settle_fields, recipe.settle));
  tree.insert("output", output_table(recipe.output));
  toml::array sets;
  for (const SetRecipe& set : recipe.sets) sets.push_back(set_table(set));
  tree.insert("set", std::move(sets));
  put_settings(tree, recipe.random);
  return tree;
}

}  // namespace tanglebin
