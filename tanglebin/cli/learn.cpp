#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/print.hpp"
#include "tanglebin/experiment/learn_links.hpp"

namespace tanglebin::cli {
namespace {

struct LearnArguments {
  std::string dataset;
  bool json = false;
};

void learn(const LearnArguments& arguments) {
  const Dataset dataset = read_dataset(arguments.dataset);
  std::vector<LinkExample> examples;
  for (const CaseId& id : cases(dataset)) {
    const std::vector<LinkExample> of_case = link_examples(dataset, id);
    examples.insert(examples.end(), of_case.begin(), of_case.end());
  }
  const LinkWeights weights = learn_weights(examples);
  nlohmann::ordered_json json;
  const std::vector<std::pair<std::string, LinkKind>> kinds = {{"chain_ends", LinkKind::chain_ends},
                                                               {"tree_ends", LinkKind::tree_ends},
                                                               {"junction", LinkKind::junction}};
  for (const auto& [name, kind] : kinds) {
    const auto is_of_kind = [&](const LinkExample& example) { return example.kind == kind; };
    const auto links = std::ranges::count_if(examples, is_of_kind);
    const auto true_links = std::ranges::count_if(
        examples, [&](const LinkExample& example) { return is_of_kind(example) && example.is_true; });
    json[name] = {{"links", links}, {"true", true_links}, {"weights", weights.of(kind)}};
    if (!arguments.json) {
      print_out("{:<10} {{{:.4f}}}  of {} links, {} true\n", name, fmt::join(weights.of(kind), ", "), links,
                 true_links);
    }
  }
  if (arguments.json) print_out("{}\n", json.dump());
}

}  // namespace

void add_learn(CLI::App& app) {
  const auto arguments = std::make_shared<LearnArguments>();
  CLI::App* command =
      app.add_subcommand("learn", "Learn how the axis method weighs links, from the scenes of a dataset");
  command->add_option("dataset", arguments->dataset, "Directory of a dataset made by generate")->required();
  command->add_flag("--json", arguments->json, "Print the weights as JSON");
  command->footer(
      "Example:\n  tanglebin learn dataset\n"
      "What ships was learned from recipes/learning.toml: docs/algorithm.md.");
  command->callback([arguments] { learn(*arguments); });
}

}  // namespace tanglebin::cli
