#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/cloud_or_tubes.hpp"
#include "tanglebin/cli/options/outputs.hpp"
#include "tanglebin/cli/options/scene_options.hpp"
#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/io/read_cloud.hpp"
#include "tanglebin/io/read_tubes.hpp"
#include "tanglebin/report/scene_view.hpp"
#include "tanglebin/score/score_clouds.hpp"

namespace tanglebin::cli {
namespace {

constexpr const char* footer =
    "The labels of a cloud are the truth if --labelled is given, as those of a dataset's case always are. If "
    "it is not, they are what was found.\n\n"
    "Example:\n  tanglebin view dataset/A10/1 --labelled labelled.ply --modelled-tubes tubes.txt --out "
    "scene.html\n"
    "  tanglebin view labelled.ply --modelled-tubes tubes.txt --out scene.html";

struct ViewArguments {
  std::string input;
  std::string out;
  std::optional<std::string> labelled;
  std::optional<std::string> true_tubes;
  std::optional<std::string> modelled_tubes;
  std::optional<std::string> scene;
};

std::vector<Tube> tubes_in(const std::string& file) {
  return read_input(file, [](auto&&... from) { return read_tubes(from...); });
}

// A dataset's case with its true labels and tubes, in its bin.
ViewedScene scene_of(const DatasetCase& named) {
  CaseData data = read_seen_case(named.dataset, named.seen);
  ViewedScene scene{.name = name_of(named.seen),
                    .cloud = std::move(data.cloud),
                    .truth = Labelling{.name = "truth", .labels = {}, .tubes = std::move(data.tubes)},
                    .found = {},
                    .support = {.bin = recipe_of(named.dataset, named.seen.scene).bin}};
  scene.truth->labels = truth_labels(scene.cloud, data.cloud_file);
  return scene;
}

// A cloud, whose labels are the truth if there are others to compare with, or tubes.
ViewedScene scene_of_file(const ViewArguments& arguments) {
  ViewedScene scene{.name = std::filesystem::path(arguments.input).filename().string(),
                    .cloud = {},
                    .truth = {},
                    .found = {},
                    .support = support_in(arguments.scene, arguments.input)};
  CloudOrTubes input = read_cloud_or_tubes(arguments.input);
  if (auto* tubes = std::get_if<std::vector<Tube>>(&input)) {
    scene.found.push_back({.name = "tubes", .labels = {}, .tubes = std::move(*tubes)});
    return scene;
  }
  scene.cloud = std::move(std::get<PointCloud>(input));
  if (arguments.labelled) {
    scene.truth = {.name = "truth", .labels = truth_labels(scene.cloud, arguments.input), .tubes = {}};
  } else if (!scene.cloud.labels.empty()) {
    scene.found.push_back({.name = "labels", .labels = scene.cloud.labels, .tubes = {}});
  }
  return scene;
}

void add_labels(const std::string& file, ViewedScene& scene) {
  const PointCloud labelled = read_input(file, [](auto&&... from) { return read_cloud(from...); });
  scene.found.push_back(
      {.name = "found",
       .labels = match_points(scene.cloud, labelled, predicted_labels(labelled, file), file),
       .tubes = {}});
}

void add_true_tubes(const std::string& file, ViewedScene& scene) {
  if (!scene.truth) scene.truth = {.name = "truth", .labels = {}, .tubes = {}};
  scene.truth->tubes = tubes_in(file);
}

void add_modelled_tubes(const std::string& file, ViewedScene& scene) {
  if (scene.found.empty()) scene.found.push_back({.name = "found", .labels = {}, .tubes = {}});
  scene.found.back().tubes = tubes_in(file);
}

void expect_a_cloud(const ViewArguments& arguments, const ViewedScene& scene) {
  if (!scene.cloud.points.empty()) return;
  for (const auto& [option, file] :
       {std::pair("--labelled", arguments.labelled), std::pair("--true-tubes", arguments.true_tubes),
        std::pair("--modelled-tubes", arguments.modelled_tubes)}) {
    if (file) throw InputError({"", 0, option}, "tubes to view", "a cloud or a dataset's case beside it");
  }
}

ViewedScene scene_of(const ViewArguments& arguments) {
  const std::optional<DatasetCase> named = dataset_case(arguments.input);
  ViewedScene scene = named ? scene_of(*named) : scene_of_file(arguments);
  expect_a_cloud(arguments, scene);
  if (arguments.labelled) add_labels(*arguments.labelled, scene);
  if (arguments.true_tubes) add_true_tubes(*arguments.true_tubes, scene);
  if (arguments.modelled_tubes) add_modelled_tubes(*arguments.modelled_tubes, scene);
  if (!scene.cloud.labels.empty()) scene.cloud.colors.clear();  // they are those of the labels
  return scene;
}

void view(const ViewArguments& arguments) {
  expect_outputs({{"--out", arguments.out, {".html"}}}, inputs_with(arguments.scene, {arguments.input}));
  write_output(arguments.out, view_page(scene_of(arguments)));
}

}  // namespace

void add_view(CLI::App& app) {
  const auto arguments = std::make_shared<ViewArguments>();
  CLI::App* command = app.add_subcommand("view", "Write an HTML page that shows a scene in 3D");
  command
      ->add_option("input", arguments->input,
                   "Cloud (.ply, .pcd), tubes (configuration or tubes.json) or a dataset's case, such as "
                   "DATASET/A10/1 or DATASET/A10/left/1; - for standard input")
      ->required();
  command->add_option("--out", arguments->out, "Self-contained HTML page to write; - for standard output")
      ->required();
  command->add_option("--labelled", arguments->labelled,
                      "Cloud with the labels that were found: all or some points of the input, in any order");
  command->add_option("--true-tubes", arguments->true_tubes,
                      "True tubes of a cloud (configuration or tubes.json)");
  command->add_option("--modelled-tubes", arguments->modelled_tubes,
                      "Tubes that were found (configuration or tubes.json)");
  add_scene_option(*command, arguments->scene);
  command->footer(footer);
  command->callback([arguments] { view(*arguments); });
}

}  // namespace tanglebin::cli
