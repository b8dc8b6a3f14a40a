#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tanglebin/recipe/randomization.hpp"
#include "tanglebin/recipe/recipe_fields.hpp"
#include "tanglebin/recipe/recipe_tree.hpp"

namespace tanglebin {
namespace {

// The order in which settings are written

/// A table of a tree, as it is written.
struct Section {
  std::string header;  ///< "[bin]", "[[set]]"; empty for the root
  std::string path;    ///< "bin", "set[0]"
  const toml::table& table;
  Keys order;  ///< keys that are not here come first
};

/// A key of a section and its value.
struct Entry {
  std::string_view key;
  const toml::node& value;
};

constexpr std::array<std::string_view, 8> keys_of_tables{"bin", "scanner", "settle",  "output",
                                                         "set", "tube",    "segment", "piece"};

bool contains(const auto& keys, std::string_view key) {
  return std::ranges::find(keys, key) != keys.end();
}

std::vector<Entry> entries(const Section& section) {
  std::vector<Entry> result;
  for (const auto& [key, value] : section.table)
    if (!contains(section.order, key.str()) && !contains(keys_of_tables, key.str()))
      result.push_back({key.str(), value});
  for (const std::string_view key : section.order)
    if (const toml::node* value = section.table.get(key)) result.push_back({key, *value});
  return result;
}

/// Calls `visit(header, path, table)` for a table or each table of an array under `key`, if any.
template <typename Visit>
void for_each_table(const Section& parent, std::string_view key, const std::string& name,
                    const Visit& visit) {
  const toml::node* node = parent.table.get(key);
  if (node == nullptr) return;
  const std::string path = path_of(parent.path, key);
  if (const toml::table* table = node->as_table()) {
    visit(fmt::format("[{}]", name), path, *table);
    return;
  }
  const toml::array& array = *node->as_array();
  for (std::size_t i = 0; i < array.size(); ++i)
    visit(fmt::format("[[{}]]", name), fmt::format("{}[{}]", path, i), *array[i].as_table());
}

Keys scanner_order(const toml::table& table) {
  const Keys camera =
      all({{"name"}, keys(camera_size_fields), keys(camera_lens_fields), {"position", "rotation_matrix"}});
  const Keys sensor = keys(sensor_fields);
  const bool has_sensor =
      std::ranges::all_of(sensor, [&](std::string_view key) { return table.contains(key); });
  return has_sensor ? all({camera, sensor, keys(image_fields)}) : camera;
}

/// Every section of a recipe's tree.
std::vector<Section> sections(const toml::table& tree) {
  std::vector<Section> result{{"", "", tree, {"format", "seed", "attempts"}}};
  const Section root = result.front();
  const auto add_all = [&](const Section& parent, std::string_view key, const std::string& name,
                           const auto& order, const auto& add_inner) {
    for_each_table(parent, key, name, [&](std::string header, std::string path, const toml::table& table) {
      result.push_back({std::move(header), std::move(path), table, order(table)});
      add_inner(Section(result.back()));
    });
  };
  const auto fixed = [](const Keys& order) { return [order](const toml::table&) { return order; }; };
  const auto nothing = [](const Section&) {};
  add_all(root, "bin", "bin", fixed(keys(bin_fields)), nothing);
  add_all(root, "scanner", "scanner", scanner_order, nothing);
  add_all(root, "settle", "settle", fixed(keys(settle_fields)), nothing);
  add_all(
      root, "output", "output",
      fixed(all({keys(cloud_fields), keys(output_fields), keys(occlusion_fields), keys(property_fields)})),
      nothing);
  const Keys tube = all({{"weight"},
                         keys(tube_fields),
                         {"ends"},
                         keys(mass_fields),
                         keys(density_fields),
                         keys(segment_fields)});
  const Keys segment = all({keys(segment_end_fields), keys(segment_fields)});
  add_all(root, "set", "set", fixed({"name", "tubes", "cases"}), [&](const Section& set) {
    add_all(set, "tube", "set.tube", fixed(tube), [&](const Section& kind) {
      add_all(kind, "segment", "set.tube.segment", fixed(segment), nothing);
      add_all(kind, "piece", "set.tube.piece", fixed(all({keys(straight_fields), keys(arc_fields)})),
              nothing);
    });
  });
  return result;
}

// Text

std::string value_text(const toml::node& node);

std::string array_text(const toml::array& array) {
  std::vector<std::string> elements;
  elements.reserve(array.size());
  for (const toml::node& element : array) elements.push_back(value_text(element));
  return fmt::format("[{}]", fmt::join(elements, ", "));
}

std::string random_text(const toml::table& number) {
  std::vector<std::string> entries;
  for (const std::string_view key : keys_of_random_numbers)
    if (const toml::node* value = number.get(key))
      entries.push_back(fmt::format("{} = {}", key, value_text(*value)));
  return fmt::format("{{ {} }}", fmt::join(entries, ", "));
}

std::string value_text(const toml::node& node) {
  if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* real = node.as_floating_point()) return real_text(real->get());
  if (const auto* boolean = node.as_boolean()) return boolean->get() ? "true" : "false";
  // Strings are names, which need no escapes.
  if (const auto* string = node.as_string()) return fmt::format("\"{}\"", string->get());
  if (const toml::array* array = node.as_array()) return array_text(*array);
  return random_text(*node.as_table());
}

/// What a reader of this setting should know.
std::string_view comment_on(const std::string& path) {
  return path == "bin.friction" ? "  # of tubes on the bin, if less than settle.friction" : "";
}

std::string text_of(const toml::table& tree) {
  std::string text = "# A resolved recipe: every value is here, presets are spelled out.\n";
  for (const Section& section : sections(tree)) {
    if (!section.header.empty()) text += fmt::format("\n{}\n", section.header);
    for (const auto& [key, value] : entries(section))
      text += fmt::format("{} = {}{}\n", key, value_text(value), comment_on(path_of(section.path, key)));
  }
  return text;
}

// Differences

using Settings = std::vector<std::pair<std::string, std::string>>;

/// The path and the text of every setting, in the order in which they are written.
Settings settings_of(const Recipe& recipe) {
  const toml::table tree = tree_of(recipe);
  Settings settings;
  for (const Section& section : sections(tree))
    for (const auto& [key, value] : entries(section))
      settings.emplace_back(path_of(section.path, key), value_text(value));
  return settings;
}

std::string text_at(const Settings& settings, const std::string& path) {
  const auto found = std::ranges::find(settings, path, &Settings::value_type::first);
  return found == settings.end() ? "nothing" : found->second;
}

}  // namespace

void sort_as_written(Recipe& recipe) {
  const toml::table tree = tree_of(recipe);
  std::vector<RandomSetting> sorted;
  for (const Section& section : sections(tree))
    for (const Entry& entry : entries(section))
      std::ranges::copy_if(recipe.random, std::back_inserter(sorted), [&](const RandomSetting& setting) {
        return table_in(setting.path) == section.path && key_in(setting.path) == entry.key;
      });
  recipe.random = std::move(sorted);
}

void write_recipe(std::ostream& out, const Recipe& recipe) {
  out << text_of(tree_of(recipe));
}

std::optional<SettingDifference> first_difference(const Recipe& first, const Recipe& second) {
  if (first == second) return std::nullopt;
  const Settings of_first = settings_of(first);
  const Settings of_second = settings_of(second);
  for (const Settings& settings : {of_second, of_first}) {
    for (const auto& [path, text] : settings) {
      SettingDifference difference{path, text_at(of_first, path), text_at(of_second, path)};
      if (difference.first != difference.second) return difference;
    }
  }
  return std::nullopt;
}

std::optional<std::string> difference(const Recipe& found, const Recipe& wanted) {
  const std::optional<SettingDifference> first = first_difference(found, wanted);
  if (!first) return std::nullopt;
  return fmt::format("{}: it has {}, this one {}", first->path, first->first, first->second);
}

}  // namespace tanglebin
