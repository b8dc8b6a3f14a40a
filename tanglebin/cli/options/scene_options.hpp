#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/dataset/seen_case.hpp"
#include "tanglebin/scene/resolve_scene.hpp"
#include "tanglebin/scene/scene.hpp"

namespace CLI {
class App;
}

// Options, shared by several commands, that say what is known about a scene.
namespace tanglebin::cli {

/// What is known, as the command line has it.
struct SceneOptions {
  std::optional<std::string> scene;
  std::optional<std::string> camera;
  std::optional<std::string> frame;
  std::optional<std::string> unit;
  std::optional<std::string> radius;
  std::optional<std::string> length;
  std::vector<std::string> trees;
};

/// Adds --scene, which sets `scene`.
void add_scene_option(CLI::App& command, std::optional<std::string>& scene);

/// Adds --camera, --frame and --unit, which fill `options`.
void add_camera_options(CLI::App& command, SceneOptions& options);

/// Adds --radius, --length and --tree, which fill `options`.
void add_tube_options(CLI::App& command, SceneOptions& options);

/// These inputs and, if there is a --scene, what is read for it: the scene file and the camera file that this
/// names, or the dataset and its own files.
std::vector<std::string> inputs_with(const std::optional<std::string>& scene,
                                     std::vector<std::string> inputs);

/// The scene that --scene names: a scene file, a recipe, a dataset's case as DATASET/A10/1, with the
/// scanner's name if there are several (DATASET/A10/left/1), or a dataset in which `input`, a file, is.
/// Throws InputError naming what is wrong with it.
Scene scene_named(const std::string& scene, const std::string& input);

/// The scanner of a dataset's case or a recipe that --scene names, as scene_named() takes it; none of a scene
/// file, which only says what the camera is.
std::optional<Scanner> scanner_in(const std::string& scene, const std::string& input);

/// The support of the scene that --scene names; nothing without one.
Support support_in(const std::optional<std::string>& scene, const std::string& input);

/// A finished case of a dataset, as one of its scanners sees it.
struct DatasetCase {
  Dataset dataset;
  SeenCase seen;
};

/// The case that a path such as DATASET/A10/1 or DATASET/A10/left/1 names; none for the path of a file or of
/// nothing in a dataset. Throws InputError for a case or a scanner that the dataset does not have, and if
/// several scanners see the case and none is named.
std::optional<DatasetCase> dataset_case(const std::string& name);

/// The scene of the options, of which all but --scene override its single values. `input` is the cloud's
/// file. Throws InputError naming the option.
Scene scene_of(const SceneOptions& options, const std::string& input);

/// An error about the scene of the options. If it is about a tube's value, it names the option that gave the
/// value, or else the file of --scene and the value's line.
InputError placed(const InputError& error, const SceneOptions& options);

/// Calls `call`, which looks at the scene of the options, and places its InputError.
template <typename Call>
auto with_places(const SceneOptions& options, Call call) {
  try {
    return call();
  } catch (const InputError& error) {
    throw placed(error, options);
  }
}

/// Prints what was estimated or taken for granted, a line each, on standard error.
void print_notes(const std::vector<std::string>& notes);

}  // namespace tanglebin::cli
