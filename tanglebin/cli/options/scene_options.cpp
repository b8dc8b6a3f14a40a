#include "tanglebin/cli/options/scene_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <system_error>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/experiment/run.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/files/toml_table.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/report/text.hpp"
#include "tanglebin/scene/camera_file.hpp"
#include "tanglebin/scene/read_scene.hpp"

namespace tanglebin::cli {
namespace {

namespace fs = std::filesystem;

/// A case of a dataset, as a user names it.
struct CasePath {
  fs::path dataset;
  std::string name;     ///< "A10/1"
  std::string scanner;  ///< empty if none is named
};

bool is_dataset(const fs::path& directory) {
  std::error_code ignored;
  return fs::exists(directory / recipe_name, ignored);
}

// The case that a file of a dataset is of: "A10/plys/1.ply", or "A10/left/plys/1.ply" of a scanner with a
// name.
std::optional<CasePath> case_of_file(const fs::path& dataset, const std::string& file) {
  std::error_code error;
  const fs::path relative = fs::relative(file, dataset, error);
  const std::vector<fs::path> parts(relative.begin(), relative.end());
  const bool has_scanner = parts.size() == 4;
  if (error || (parts.size() != 3 && !has_scanner) || parts.front() == "..") return std::nullopt;
  return CasePath{dataset, parts.front().string() + "/" + relative.stem().string(),
                  has_scanner ? parts[1].string() : ""};
}

// What names a case of a dataset, for messages; `prefix` is before its name.
std::string a_case(const std::vector<CaseId>& there, const fs::path& prefix = "") {
  if (there.empty()) return "a case, but the dataset has none";
  return "a case of the dataset, such as " + (prefix / name_of(there.front())).string();
}

CaseId case_named(const Dataset& dataset, const std::string& name) {
  const std::vector<CaseId> there = cases(dataset);
  const auto found = std::ranges::find(there, name, [](const CaseId& id) { return name_of(id); });
  if (found == there.end())
    throw InputError({dataset.directory.string(), 0, ""}, excerpt(name), a_case(there));
  return *found;
}

Recipe recipe_of_case(const CasePath& path) {
  const Dataset dataset = read_dataset(path.dataset);
  return recipe_of(dataset, case_named(dataset, path.name));
}

fs::path without_slash(const std::string& name) {
  return fs::path(name).has_filename() ? fs::path(name) : fs::path(name).parent_path();
}

// Of a path that is no file: DATASET/A10/1, or DATASET/A10/left/1 of a scanner with a name.
std::optional<CasePath> case_path(const fs::path& path) {
  std::error_code ignored;
  if (fs::exists(path, ignored)) return std::nullopt;
  const std::string number = path.filename().string();
  const auto in_dataset = [&](const fs::path& set, const std::string& scanner) -> std::optional<CasePath> {
    if (!set.has_filename()) return std::nullopt;
    const fs::path dataset = set.has_parent_path() ? set.parent_path() : ".";
    if (!is_dataset(dataset)) return std::nullopt;
    return CasePath{dataset, set.filename().string() + "/" + number, scanner};
  };
  const fs::path folder = path.parent_path();
  const auto named = in_dataset(folder, "");
  return named ? named : in_dataset(folder.parent_path(), folder.filename().string());
}

// The scanner that the path names, or the only one.
Scanner scanner_of(const CasePath& path, const Recipe& recipe) {
  const std::vector<Scanner> all = scanners(recipe);
  if (path.scanner.empty() && all.size() == 1) return all.front();
  const auto found = std::ranges::find(all, path.scanner, &Scanner::name);
  if (found != all.end()) return *found;
  const fs::path name = path.dataset / path.name;
  std::string names;
  for (const Scanner& scanner : all) {
    const fs::path seen = name.parent_path() / scanner.name / name.filename();
    names += (names.empty() ? "" : " or ") + seen.string();
  }
  throw InputError({path.dataset.string(), 0, "scanner"},
                   path.scanner.empty() ? fmt::format("the {} scanners of {}", all.size(), path.name)
                                        : excerpt(path.scanner),
                   "one of them: " + names);
}

Scene scene_of_simulation(const KnownScene& known) {
  Scene scene = scene_of(known);
  scene.camera.depth_scale = depth_scale;
  return scene;
}

Scene scene_of_case(const CasePath& path) {
  const Dataset dataset = read_dataset(path.dataset);
  const CaseId id = case_named(dataset, path.name);
  const Recipe recipe = recipe_of(dataset, id);
  KnownScene known = known_scene(recipe, id);
  known.camera = scanner_of(path, recipe).camera;
  return scene_of_simulation(known);
}

// The case that --scene names, or that `input` is of if it names a dataset.
std::optional<CasePath> case_meant(const fs::path& scene, const std::string& input) {
  if (!is_dataset(scene)) return case_path(scene);
  std::optional<CasePath> named = case_of_file(scene, input);
  if (!named)
    throw InputError({scene.string(), 0, ""},
                     fmt::format("a dataset, and {}, which is not in it", excerpt(input)),
                     a_case(cases(read_dataset(scene)), scene));
  return named;
}

// What all cases of a recipe have in common.
Scene scene_of_recipe(const fs::path& file) {
  const Recipe recipe = read_recipe(file);
  const std::string remedy = "a case of a dataset, such as DATASET/A10/1, or a scene file";
  if (!recipe.random.empty())
    throw InputError({file.string(), 0, recipe.random.front().path}, "a number that is drawn for each case",
                     remedy);
  Scene scene = scene_of_simulation(known_scene(recipe, {recipe.sets.front().name}));
  for (const SetRecipe& set : recipe.sets) {
    if (scene_of(known_scene(recipe, {set.name})).tubes != scene.tubes)
      throw InputError({file.string(), 0, "set"}, "sets of different tubes", remedy);
  }
  return scene;
}

// BOP's images, and the files of a dataset, are called by their numbers.
std::optional<int> number_of(const std::string& file) {
  return to_number<int>(fs::path(file).stem().string());
}

bool is_recipe(const fs::path& file) {
  return parse_toml(read_file(file), file.string()).contains("set");
}

// What a scene file or a recipe says; of a recipe's scanners, the first one's camera.
Scene scene_of_file(const std::string& file, const std::string& input) {
  const fs::path path = without_slash(file);
  std::error_code ignored;
  if (!fs::exists(path, ignored) || fs::is_directory(path, ignored))
    throw InputError({"", 0, "--scene"},
                     (fs::exists(path, ignored) ? "the directory " : "nothing called ") + excerpt(file),
                     "a scene file, a recipe, a dataset, or one of its cases, such as DATASET/A10/1");
  return is_recipe(path) ? scene_of_recipe(path) : read_scene(path, number_of(input));
}

// The dataset that --scene names, itself or by one of its cases.
std::optional<fs::path> dataset_named(const fs::path& scene) {
  if (is_dataset(scene)) return scene;
  const std::optional<CasePath> named = case_path(scene);
  return named ? std::optional(named->dataset) : std::nullopt;
}

// The camera file that a scene file names.
std::optional<fs::path> camera_file_in(const fs::path& scene) {
  std::error_code ignored;
  if (!fs::is_regular_file(scene, ignored)) return std::nullopt;
  const toml::table tree = parse_toml(read_file(scene), scene.string());
  const auto name = tree["camera"]["file"].value<std::string>();
  return name ? std::optional(scene.parent_path() / *name) : std::nullopt;
}

void expect_one_scanner(const fs::path& file) {
  if (!is_recipe(file)) return;
  const std::size_t count = scanners(read_recipe(file)).size();
  if (count > 1)
    throw InputError({file.string(), 0, "scanner"}, counted(count, "scanner"),
                     "one, or what one of them sees of a dataset's case, such as DATASET/A10/left/1");
}

/// The value that an option's text stands for.
template <typename Value>
Value choice(const std::string& text, const std::string& option,
             const std::vector<std::pair<std::string, Value>>& choices) {
  std::string names;
  for (const auto& [name, value] : choices) {
    if (name == text) return value;
    names += (names.empty() ? "" : " or ") + name;
  }
  throw InputError({"", 0, option}, excerpt(text), names);
}

void override_camera(const SceneOptions& options, const std::string& input, Scene& scene) {
  if (options.camera)
    scene = overridden(scene, {.camera = read_camera_file(*options.camera, number_of(input))});
  if (options.frame)
    scene.camera.frame = choice<CloudFrame>(*options.frame, "--frame",
                                            {{"camera", CloudFrame::camera}, {"world", CloudFrame::world}});
  if (options.unit) scene.camera.unit = choice<double>(*options.unit, "--unit", {{"m", 1}, {"mm", 0.001}});
}

std::vector<std::optional<LengthRange>> ranges(const std::string& text, std::string_view unknown,
                                               const std::string& option) {
  if (text == unknown) return {std::nullopt};
  const auto lengths = [&] {
    try {
      return parse_lengths(text, option);
    } catch (const InputError& error) {
      throw InputError(error.place(), fmt::format("{}, or {} alone", error.problem(), unknown));
    }
  };
  std::vector<std::optional<LengthRange>> result;
  for (const double length : lengths()) result.emplace_back(LengthRange{length, length});
  return result;
}

// Each radius makes a class of tubes, unless there are as many already.
void override_radii(const std::string& text, std::vector<TubeClass>& classes) {
  const auto radii = ranges(text, "auto", "--radius");
  if (classes.size() == 1) classes.assign(radii.size(), classes.front());
  if (classes.size() != radii.size())
    throw InputError({"", 0, "--radius"}, counted(radii.size(), "number"),
                     fmt::format("one for each of the scene's {} classes of tubes", classes.size()));
  for (std::size_t i = 0; i < radii.size(); ++i) classes[i].radius = radii[i];
}

// Calls `set` for each class with its value: its own, or the only one.
template <typename Value>
void set_each(const std::vector<Value>& values, const std::string& what, std::vector<TubeClass>& classes,
              const std::function<void(TubeClass&, const Value&)>& set) {
  if (values.size() != 1 && values.size() != classes.size())
    throw InputError({"", 0, "--" + what}, fmt::format("{} {}s", values.size(), what),
                     fmt::format("one, or one for each radius: {}", classes.size()));
  for (std::size_t i = 0; i < classes.size(); ++i) set(classes[i], values[values.size() == 1 ? 0 : i]);
}

void override_tubes(const SceneOptions& options, std::vector<TubeClass>& classes) {
  if (classes.empty()) classes.emplace_back();
  if (options.radius) override_radii(*options.radius, classes);
  if (options.length) {
    set_each<std::optional<LengthRange>>(ranges(*options.length, "unknown", "--length"), "length", classes,
                                         [](TubeClass& tubes, const std::optional<LengthRange>& length) {
                                           tubes.length = length;
                                           tubes.tree.clear();
                                         });
  }
  std::vector<SegmentTree> trees;
  for (const std::string& tree : options.trees) trees.push_back(parse_tree(tree, "--tree"));
  if (trees.empty()) return;
  set_each<SegmentTree>(trees, "tree", classes, [](TubeClass& tubes, const SegmentTree& tree) {
    tubes.tree = tree;
    tubes.length.reset();
  });
}

// The option that gave a tube's value its place; empty if none did.
std::string option_for(const std::string& field, const SceneOptions& options) {
  const std::string key = field.substr(std::min(field.find('.'), field.size()));
  if (key == ".radius") return options.radius ? "--radius" : "";
  const bool is_length = key == ".length" || key.starts_with(".segment");
  if (is_length && options.length) return "--length";
  return is_length && !options.trees.empty() ? "--tree" : "";
}

InputPlace place_in_scene(const std::string& scene, const std::string& field) {
  std::error_code ignored;
  if (!fs::is_regular_file(scene, ignored)) return {scene, 0, field};
  const toml::table tree = parse_toml(read_file(scene), scene);
  return {scene, TomlSource(scene, tree).line_of_field(field), field};
}

InputPlace place_for(const std::string& field, const SceneOptions& options) {
  const std::string option = option_for(field, options);
  if (!option.empty()) return {"", 0, option};
  return options.scene ? place_in_scene(*options.scene, field) : InputPlace{"", 0, field};
}

}  // namespace

void add_scene_option(CLI::App& command, std::optional<std::string>& scene) {
  command
      .add_option("--scene", scene,
                  "What is known: a scene file (docs/formats.md), a recipe, a dataset's case such as "
                  "DATASET/A10/1 (DATASET/A10/left/1 by the scanner left), or the dataset that the input is "
                  "in")
      ->option_text("SCENE");
}

void add_camera_options(CLI::App& command, SceneOptions& options) {
  command
      .add_option("--camera", options.camera,
                  "Camera file: of ROS, Open3D, BOP, or written by tanglebin scan --depth")
      ->option_text("FILE");
  command.add_option("--frame", options.frame, "Frame of the cloud's points: camera or world")
      ->option_text("FRAME");
  command.add_option("--unit", options.unit, "Unit of the cloud's coordinates: m or mm")->option_text("UNIT");
}

void add_tube_options(CLI::App& command, SceneOptions& options) {
  command
      .add_option(
          "--radius", options.radius,
          "Radius of the tubes, m; 0.008,0.0125 for two classes of tubes; auto to estimate it from the "
          "cloud")
      ->option_text("METRES");
  CLI::Option* const length = command
                                  .add_option("--length", options.length,
                                              "Length of the tubes, m; 0.4,0.5 for two classes; or unknown")
                                  ->option_text("METRES");
  command
      .add_option(
          "--tree", options.trees,
          "Shape of branching tubes: straight segments, each as the numbers of the nodes at its ends and its "
          "length, m; 1-2:0.3,1-3:0.1,1-4:0.1 is three that meet at node 1; repeat the option for each class "
          "of tubes (method axis)")
      ->allow_extra_args(false)
      ->excludes(length)
      ->option_text("SEGMENTS");
}

std::vector<std::string> inputs_with(const std::optional<std::string>& scene,
                                     std::vector<std::string> inputs) {
  if (!scene) return inputs;
  inputs.push_back(*scene);
  const fs::path path = without_slash(*scene);
  if (const auto dataset = dataset_named(path)) {
    inputs.push_back(dataset->string());
    for (const char* name : dataset_files) inputs.push_back((*dataset / name).string());
  } else if (const auto camera = camera_file_in(path)) {
    inputs.push_back(camera->string());
  }
  return inputs;
}

std::optional<DatasetCase> dataset_case(const std::string& name) {
  const std::optional<CasePath> path = case_path(without_slash(name));
  if (!path) return std::nullopt;
  Dataset dataset = read_dataset(path->dataset);
  const CaseId id = case_named(dataset, path->name);
  std::string scanner = scanner_of(*path, recipe_of(dataset, id)).name;
  return DatasetCase{std::move(dataset), {id, std::move(scanner)}};
}

std::optional<Scanner> scanner_in(const std::string& scene, const std::string& input) {
  const fs::path path = without_slash(scene);
  if (const auto named = case_meant(path, input)) return scanner_of(*named, recipe_of_case(*named));
  if (!is_recipe(path)) return std::nullopt;
  return scanners(read_recipe(path)).front();
}

Scene scene_named(const std::string& scene, const std::string& input) {
  const fs::path path = without_slash(scene);
  if (const auto named = case_meant(path, input)) return scene_of_case(*named);
  Scene read = scene_of_file(scene, input);
  expect_one_scanner(path);
  return read;
}

Support support_in(const std::optional<std::string>& scene, const std::string& input) {
  constexpr auto nothing = Support::Shape::nothing;
  if (!scene) return {.shape = nothing};
  if (const auto named = case_meant(without_slash(*scene), input)) return {.bin = recipe_of_case(*named).bin};
  return scene_of_file(*scene, input).support.value_or(Support{.shape = nothing});
}

Scene scene_of(const SceneOptions& options, const std::string& input) {
  Scene scene = options.scene ? scene_named(*options.scene, input) : Scene{};
  override_camera(options, input, scene);
  if (options.radius || options.length || !options.trees.empty()) override_tubes(options, scene.tubes);
  with_places(options, [&] { validate(scene); });
  return scene;
}

InputError placed(const InputError& error, const SceneOptions& options) {
  const std::string& field = error.place().field;
  return field.starts_with("tube[") ? InputError(place_for(field, options), error.problem()) : error;
}

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) print_error("tanglebin: {}\n", note);
}

}  // namespace tanglebin::cli
