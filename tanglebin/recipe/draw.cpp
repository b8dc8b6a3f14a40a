#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "tanglebin/base/counter_random.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/base/expect.hpp"
#include "tanglebin/base/random.hpp"
#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/recipe/randomization.hpp"
#include "tanglebin/recipe/recipe_tree.hpp"

namespace tanglebin {
namespace {

constexpr int whole_scene = 0;  // tubes count from 1

/// The random numbers of what has this name in a case, of the whole scene or of a tube. All are unrelated.
CounterRandom random_of(const std::string& name, std::uint64_t recipe_seed, const CaseId& id, int tube) {
  constexpr int no_attempt = 0;  // attempts at a scene count from 1
  const std::uint64_t seed = attempt_seed(recipe_seed, id.set, id.tubes, id.number, no_attempt);
  return {attempt_seed(seed, name, 0, 0, 0), static_cast<std::uint64_t>(tube)};
}

// By rejection; the reader sees to it that few are rejected.
double draw_normal(const RandomNumber& number, bool whole, const CounterRandom& random) {
  for (std::uint64_t draw = 0;; ++draw) {
    const double value = number.mean + number.sigma * random.normal(draw);
    const double drawn = whole ? std::round(value) : value;
    if (drawn >= number.min && drawn <= number.max) return drawn;
  }
}

double draw_number(const RandomNumber& number, bool whole, const CounterRandom& random) {
  if (number.sigma > 0) return draw_normal(number, whole, random);
  const double uniform = random.uniform(0);
  if (!number.one_of.empty()) {
    return number.one_of[static_cast<std::size_t>(uniform * static_cast<double>(number.one_of.size()))];
  }
  if (whole) return std::min(number.max, std::floor(number.min + uniform * (number.max - number.min + 1)));
  return number.min + uniform * (number.max - number.min);
}

std::size_t draw_kind(const std::vector<double>& weights, const CounterRandom& random) {
  double left = random.uniform(0) * std::accumulate(weights.begin(), weights.end(), 0.0);
  std::size_t kind = 0;
  while (kind + 1 < weights.size() && left >= weights[kind]) left -= weights[kind++];
  return kind;
}

bool is_of_a_set(std::string_view path) {
  return path.starts_with("set[");
}

std::size_t index_in(const std::string& path) {
  return std::stoul(path.substr(path.find('[') + 1));
}

std::string path_of_set(std::size_t set) {
  return fmt::format("set[{}]", set);
}

std::size_t index_of_set(const Recipe& recipe, const CaseId& id) {
  return static_cast<std::size_t>(&set_named(recipe, id.set) - recipe.sets.data());
}

bool is_per_tube(const RandomSetting& setting) {
  const RandomNumber* number = std::get_if<RandomNumber>(&setting.value);
  return number != nullptr && number->per_tube;
}

// What a number is drawn by: its path, without the place of its set or scanner among the others. (A case's
// seed depends on the set's name.)
std::string name_of(const std::string& path, const Recipe& recipe) {
  const auto after_index = [&] { return path.substr(path.find(']') + 1); };
  if (is_of_a_set(path)) return "set" + after_index();
  if (path.starts_with("scanner["))
    return fmt::format("scanner.{}{}", scanners(recipe).at(index_in(path)).name, after_index());
  return path;
}

/// Draws the numbers of a case.
class Drawing {
public:
  Drawing(const Recipe& recipe, const CaseId& id)
      : recipe_(recipe), id_(id), index_(index_of_set(recipe, id)), set_(recipe.sets[index_]) {}

  void draw_scene() {
    for (const RandomSetting& setting : recipe_.random) {
      const bool concerns = !is_of_a_set(setting.path) || setting.path.starts_with(path_of_set(index_) + ".");
      if (concerns && !is_per_tube(setting)) draw_setting(setting, whole_scene);
    }
  }

  void draw_tube(int tube) {
    const std::string kind = path_of_kind(recipe_, index_, draw_kind_of(tube));
    for (const RandomSetting& setting : recipe_.random) {
      if (is_per_tube(setting) && setting.path.starts_with(kind + ".")) draw_setting(setting, tube);
    }
  }

  std::vector<DrawnNumber> take() { return std::move(drawn_); }

private:
  CounterRandom random(const std::string& path, int tube) const {
    return random_of(name_of(path, recipe_), recipe_.seed, id_, tube);
  }

  void draw_setting(const RandomSetting& setting, int tube) {
    const auto& [path, value] = setting;
    const RandomNumber* number = std::get_if<RandomNumber>(&value);
    if (number == nullptr) return;
    drawn_.push_back({path, draw_number(*number, is_whole(path), random(path, tube)), tube});
  }

  std::size_t draw_kind_of(int tube) {
    if (set_.weights.empty()) return kind_in_turn(set_, tube);
    const std::string path = path_of_set(index_) + ".tube";
    const std::size_t kind = draw_kind(set_.weights, random(path, tube));
    drawn_.push_back({path, static_cast<double>(kind), tube});
    return kind;
  }

  const Recipe& recipe_;
  const CaseId& id_;
  std::size_t index_;
  const SetRecipe& set_;
  std::vector<DrawnNumber> drawn_;
};

/// Puts drawn numbers in the place of random ones.
class Resolution {
public:
  Resolution(const Recipe& recipe, const CaseId& id, const std::vector<DrawnNumber>& drawn)
      : recipe_(recipe), drawn_(drawn), tree_(tree_of(recipe)), index_(index_of_set(recipe, id)) {
    for (const RandomSetting& setting : recipe.random) {
      if (const RandomNumber* number = std::get_if<RandomNumber>(&setting.value))
        numbers_[setting.path] = number_of_scene(setting.path, *number);
    }
  }

  Recipe scene() const { return read_tree(with_numbers(tree_, numbers_), TomlSource{}); }

  bool tubes_differ() const {
    const auto is_of_one_tube = [&](const RandomSetting& setting) {
      return is_per_tube(setting) && is_own(setting.path);
    };
    return !recipe_.sets[index_].weights.empty() || std::ranges::any_of(recipe_.random, is_of_one_tube);
  }

  TubeSpec tube(int tube) const {
    const std::size_t kind = kind_of_tube(tube);
    const std::string path = path_of_kind(recipe_, index_, kind) + ".";
    NumbersByPath numbers = numbers_;
    for (const RandomSetting& setting : recipe_.random) {
      if (is_per_tube(setting) && setting.path.starts_with(path))
        numbers[setting.path] = value_of(setting.path, tube);
    }
    return read_tree(with_numbers(tree_, numbers), TomlSource{}).sets[index_].kinds[kind];
  }

private:
  bool is_own(const std::string& path) const { return path.starts_with(path_of_set(index_) + "."); }

  double value_of(const std::string& path, int tube) const {
    const auto is_it = [&](const DrawnNumber& number) { return number.path == path && number.tube == tube; };
    const auto found = std::ranges::find_if(drawn_, is_it);
    if (found == drawn_.end()) throw InputError({"", 0, path}, "has not been drawn");
    return found->value;
  }

  double number_of_scene(const std::string& path, const RandomNumber& number) const {
    if (number.per_tube) return middle(number, is_whole(path));
    return is_of_a_set(path) && !is_own(path) ? lowest(number) : value_of(path, whole_scene);
  }

  std::size_t kind_of_tube(int tube) const {
    const SetRecipe& set = recipe_.sets[index_];
    if (set.weights.empty()) return kind_in_turn(set, tube);
    const std::string path = path_of_set(index_) + ".tube";
    const double kind = value_of(path, tube);
    for (std::size_t known = 0; known < set.kinds.size(); ++known)
      if (kind == static_cast<double>(known)) return known;
    throw InputError({"", 0, path}, fmt::format("{}", kind),
                     fmt::format("a kind from 0 to {}", set.kinds.size() - 1));
  }

  const Recipe& recipe_;
  const std::vector<DrawnNumber>& drawn_;
  toml::table tree_;
  std::size_t index_;
  NumbersByPath numbers_;
};

}  // namespace

int draw_number_of_tubes(const Recipe& recipe, const SetRecipe& set, int number) {
  constexpr int not_drawn_yet = 0;
  const CaseId id{set.name, not_drawn_yet, number};
  const CounterRandom random = random_of("set.tubes", recipe.seed, id, whole_scene);
  return static_cast<int>(draw_number(*set.drawn_tubes, true, random));
}

void expect_lowest_numbers(const Recipe& recipe) {
  NumbersByPath lows;
  for (const RandomSetting& setting : recipe.random) {
    if (const RandomNumber* number = std::get_if<RandomNumber>(&setting.value))
      lows[setting.path] = lowest(*number);
  }
  const Recipe read = read_tree(with_numbers(tree_of(recipe), lows), TomlSource{});
  Recipe fixed = recipe;
  fixed.random.clear();
  if (const auto changed = first_difference(fixed, read))
    expect(false, changed->path, changed->first,
           changed->second +
               ", the lowest that cases draw: what is drawn cannot be set in code, only in the "
               "recipe's text");
}

std::vector<DrawnNumber> draw(const Recipe& recipe, const CaseId& id) {
  Drawing drawing(recipe, id);
  drawing.draw_scene();
  for (int tube = 1; tube <= id.tubes; ++tube) drawing.draw_tube(tube);
  return drawing.take();
}

Recipe resolve(const Recipe& recipe, const CaseId& id, const std::vector<DrawnNumber>& drawn) {
  const bool draws_kinds =
      std::ranges::any_of(recipe.sets, [](const SetRecipe& set) { return !set.weights.empty(); });
  if (recipe.random.empty() && !draws_kinds) return recipe;
  const Resolution resolution(recipe, id, drawn);
  Recipe resolved = resolution.scene();
  if (!resolution.tubes_differ()) return resolved;
  std::vector<TubeSpec>& tubes = resolved.sets[index_of_set(recipe, id)].each_tube;
  for (int tube = 1; tube <= id.tubes; ++tube) tubes.push_back(resolution.tube(tube));
  return resolved;
}

}  // namespace tanglebin
