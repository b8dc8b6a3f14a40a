#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "tanglebin/recipe/recipe_fields.hpp"
#include "tanglebin/recipe/recipe_tree.hpp"

namespace tanglebin {
namespace {

/// Keys that say the same in different ways: a kind that has one of them inherits none of the others.
struct Alternatives {
  Keys some;
  Keys others;

  /// Does a kind that has this key of its own say already what `inherited` does?
  bool say(std::string_view own, std::string_view inherited) const {
    const auto holds = [](const Keys& keys, std::string_view key) {
      return std::ranges::find(keys, key) != keys.end();
    };
    return (holds(some, own) && holds(others, inherited)) || (holds(others, own) && holds(some, inherited));
  }
};

std::vector<Alternatives> all_alternatives() {
  return {{keys(mass_fields), keys(density_fields)},
          {{"segment"}, keys(segment_fields)},
          {{"piece"}, all({{"segment"}, keys(segment_fields)})}};
}

Keys own_keys(const toml::table& kind) {
  Keys own;
  for (const auto& [key, value] : kind) own.push_back(key.str());
  return own;
}

void inherit(toml::table& kind, const std::string& path, const toml::table& tube, TomlSource& source) {
  const Keys own = own_keys(kind);
  for (const auto& [key, value] : tube) {
    const std::string_view inherited = key.str();
    const bool is_said = std::ranges::any_of(own, [&](std::string_view said) {
      return said == inherited || std::ranges::any_of(all_alternatives(), [&](const Alternatives& keys) {
               return keys.say(said, inherited);
             });
    });
    if (is_said) continue;
    kind.insert(inherited, value);
    source.take_lines(path_of(path, inherited), path_of("tube", inherited));
  }
}

void inherit_in_set(toml::table& set, const std::string& path, const toml::table& tube, TomlSource& source) {
  if (!set.contains("tube")) source.take_lines(path, "tube");
  toml::node& kinds = set.insert("tube", toml::table{}).first->second;
  if (toml::table* only = kinds.as_table()) inherit(*only, path, tube, source);
  toml::array* several = kinds.as_array();
  if (several == nullptr) return;
  for (std::size_t i = 0; i < several->size(); ++i)
    if (toml::table* kind = (*several)[i].as_table())
      inherit(*kind, fmt::format("{}[{}]", path, i), tube, source);
}

}  // namespace

void inherit_tube(toml::table& tree, TomlSource& source) {
  if (!tree.contains("tube")) return;
  const TomlTable root(source, tree, "");
  const TomlTable defaults = root.table("tube");
  defaults.allow(tube_keys());
  const toml::table tube = *tree.get_as<toml::table>("tube");
  tree.erase("tube");
  toml::array* sets = tree.get_as<toml::array>("set");
  for (std::size_t i = 0; sets != nullptr && i < sets->size(); ++i)
    if (toml::table* set = (*sets)[i].as_table())
      inherit_in_set(*set, fmt::format("set[{}].tube", i), tube, source);
}

}  // namespace tanglebin
