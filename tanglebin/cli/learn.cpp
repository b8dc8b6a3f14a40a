#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/outputs.hpp"
#include "tanglebin/cli/options/scene_options.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/dataset/versions.hpp"
#include "tanglebin/experiment/learn_confidence.hpp"
#include "tanglebin/experiment/learn_links.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/model/parameters.hpp"
#include "tanglebin/profile/profile.hpp"

namespace tanglebin::cli {
namespace {

struct LearnArguments {
  std::vector<std::string> datasets;
  std::optional<std::string> out;
  bool confidence = false;
  std::optional<std::string> scene;
  bool json = false;
};

std::vector<Output> outputs(const LearnArguments& arguments) {
  if (!arguments.out) return {};
  return {{"--out", *arguments.out, {".toml"}}};
}

// The examples from all scanners' clouds of every case of the datasets.
template <typename Example>
std::vector<Example> examples_of(
    const std::vector<std::string>& datasets,
    const std::function<std::vector<Example>(const Dataset&, const SeenCase&)>& of_case) {
  std::vector<Example> all;
  for (const std::string& directory : datasets) {
    const Dataset dataset = read_dataset(directory);
    for (const CaseId& id : cases(dataset)) {
      for (const Scanner& scanner : scanners(dataset.recipe))
        std::ranges::move(of_case(dataset, {id, scanner.name}), std::back_inserter(all));
    }
  }
  return all;
}

/// Links of one kind.
struct Count {
  int links = 0;
  int true_links = 0;
};

Count count(const std::vector<LinkScene>& scenes, LinkKind kind) {
  Count result;
  for (const LinkScene& scene : scenes) {
    for (std::size_t i = 0; i < scene.links.size(); ++i) {
      if (scene.links[i].kind != kind) continue;
      ++result.links;
      if (scene.is_true[i]) ++result.true_links;
    }
  }
  return result;
}

/// Tubes by their confidence.
struct Reliability {
  double from;  ///< the class's least confidence
  int tubes = 0;
  int right = 0;
  double sum = 0;  ///< of the confidences
};

std::vector<Reliability> reliability(const std::vector<TubeExample>& examples) {
  std::vector<Reliability> classes;
  for (const double from : {0.0, 0.5, 0.8, 0.9, 0.95, 0.98, 0.99, 0.995}) classes.push_back({from});
  for (const auto& [features, is_right] : examples) {
    const double value = confidence(features);
    Reliability& its =
        *std::ranges::find_if(classes.rbegin(), classes.rend(),
                              [&](const Reliability& candidate) { return value >= candidate.from; });
    ++its.tubes;
    its.right += is_right ? 1 : 0;
    its.sum += value;
  }
  std::erase_if(classes, [](const Reliability& of) { return of.tubes == 0; });
  return classes;
}

nlohmann::ordered_json json_of(const std::vector<Reliability>& classes) {
  auto json = nlohmann::ordered_json::array();
  for (const auto& [from, tubes, right, sum] : classes)
    json.push_back({{"from", from}, {"tubes", tubes}, {"mean_confidence", sum / tubes}, {"right", right}});
  return json;
}

void print(const std::vector<Reliability>& classes, const std::string& title) {
  print_out("{}:\n{:>6} {:>6} {:>6} {:>6}\n", title, "from", "tubes", "mean", "right");
  for (const auto& [from, tubes, right, sum] : classes)
    print_out("{:>6} {:>6} {:>6.3f} {:>6.3f}\n", from, tubes, sum / tubes,
              static_cast<double>(right) / tubes);
}

std::vector<TubeExample> tubes_told(const Scene& scene, const std::vector<std::string>& datasets) {
  return examples_of<TubeExample>(datasets, [&](const Dataset& dataset, const SeenCase& seen) {
    return tube_examples(dataset, seen, scene);
  });
}

void learn_for_tubes(const LearnArguments& arguments) {
  const std::optional<Scene> told =
      arguments.scene ? std::optional(scene_named(*arguments.scene, "")) : std::nullopt;
  std::vector<TubeExample> examples = tubes_told({}, arguments.datasets);
  const std::vector<Reliability> classes = reliability(examples);
  std::vector<Reliability> classes_told;
  if (told) {
    const std::vector<TubeExample> others = tubes_told(*told, arguments.datasets);
    classes_told = reliability(others);
    std::ranges::copy(others, std::back_inserter(examples));
  }
  const ConfidenceFeatures weights = learn_confidence(examples);
  const auto right = std::ranges::count_if(examples, &TubeExample::is_right);
  if (arguments.json) {
    nlohmann::ordered_json json{{"tubes", examples.size()},
                                {"right", right},
                                {"weights", weights},
                                {"reliability", json_of(classes)}};
    if (told) json["reliability_told_scene"] = json_of(classes_told);
    print_json_line(json);
    return;
  }
  print_out("confidence {{{:.4f}}}  from {} tubes, {} right\n", fmt::join(weights, ", "), examples.size(),
            right);
  print(classes, "by the built-in confidence");
  if (told) print(classes_told, "the same, told " + *arguments.scene);
}

void write_weights(const LinkWeights& weights, const LearnArguments& arguments) {
  const std::string title = fmt::format("Weights of links, learned by tanglebin {} from {}",
                                        versions().at("tanglebin"), fmt::join(arguments.datasets, ", "));
  write_output(*arguments.out, bytes_of([&](std::ostream& out) {
    write_profile(out, {.parameters = link_parameters(weights), .method = Method::axis}, title);
  }));
}

void learn_for_links(const LearnArguments& arguments) {
  const std::vector<LinkScene> scenes = examples_of<LinkScene>(arguments.datasets, link_scenes);
  const LinkWeights weights = learn_weights(scenes);
  if (arguments.out) write_weights(weights, arguments);
  if (take_standard_output(outputs(arguments))) return;
  nlohmann::ordered_json json;
  for (const LinkKind kind : link_kinds) {
    const auto [links, true_links] = count(scenes, kind);
    json[name_of(kind)] = {{"links", links}, {"true", true_links}, {"weights", weights.of(kind)}};
    if (!arguments.json) {
      print_out("{:<10} {{{:.4f}}}  from {} links, {} true\n", name_of(kind),
                fmt::join(weights.of(kind), ", "), links, true_links);
    }
  }
  if (arguments.json) print_json_line(json);
}

std::vector<std::string> recipes_of(const std::vector<std::string>& datasets) {
  std::vector<std::string> files;
  files.reserve(datasets.size());
  for (const std::string& directory : datasets)
    files.push_back((std::filesystem::path(directory) / recipe_name).string());
  return files;
}

void learn(const LearnArguments& arguments) {
  if (arguments.confidence && arguments.out)
    throw InputError({"", 0, "--out"}, "a profile has the weights of links, not of --confidence");
  if (arguments.scene && !arguments.confidence)
    throw InputError({"", 0, "--scene"},
                     "links are learned from what the recipe says; only --confidence has it");
  expect_outputs(outputs(arguments), recipes_of(arguments.datasets));
  for (const std::string& directory : arguments.datasets) expect_dataset(directory);
  arguments.confidence ? learn_for_tubes(arguments) : learn_for_links(arguments);
}

}  // namespace

void add_learn(CLI::App& app) {
  const auto arguments = std::make_shared<LearnArguments>();
  CLI::App* command =
      app.add_subcommand("learn", "Learn the axis method's weights from the scenes of a dataset");
  command->add_option("datasets", arguments->datasets, "Directories of datasets from `tanglebin generate`")
      ->required();
  command->add_option(
      "--out", arguments->out,
      "Write the weights as a profile (.toml) for --profile of model and experiment; - for standard output");
  command->add_flag(
      "--confidence", arguments->confidence,
      "Learn the weights of a tube's confidence instead of those of links, and say how right the "
      "built-in confidence is");
  command
      ->add_option("--scene", arguments->scene,
                   "With --confidence: model each scan once more, told what this scene file says in place of "
                   "what the recipe says")
      ->option_text("FILE");
  command->add_flag("--json", arguments->json, "Print the weights as JSON");
  command->footer(
      "Example:\n  tanglebin learn dataset --out profile.toml\n"
      "The built-in weights are from recipes/learning.toml and recipes/learning-views.toml; those of the\n"
      "confidence from recipes/confidence.toml, recipes/confidence-zivid.toml and recipes/bars.toml\n"
      "(docs/robustness.md#confidence).");
  command->callback([arguments] { learn(*arguments); });
}

}  // namespace tanglebin::cli
