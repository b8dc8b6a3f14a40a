#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/cli/arguments.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/print.hpp"
#include "tanglebin/experiment/learn_links.hpp"

namespace tanglebin::cli {
namespace {

struct LearnArguments {
  std::string dataset;
  bool json = false;
};

std::vector<EndExample> examples_of(const Dataset& dataset) {
  std::vector<EndExample> ends;
  for (const CaseId& id : cases(dataset)) {
    const std::vector<EndExample> of_case = end_examples(dataset, id);
    ends.insert(ends.end(), of_case.begin(), of_case.end());
  }
  return ends;
}

/// Links of one kind.
struct Count {
  int links = 0;
  int true_links = 0;
};

Count count(const std::vector<EndExample>& ends, LinkKind kind) {
  Count result;
  for (const EndExample& end : ends) {
    for (const LinkExample& link : end) {
      if (link.kind != kind) continue;
      ++result.links;
      if (link.is_true) ++result.true_links;
    }
  }
  // A link is an example for each end that it uses up.
  return {result.links / ends_taken(kind), result.true_links / ends_taken(kind)};
}

void learn(const LearnArguments& arguments) {
  expect_dataset(arguments.dataset);
  const std::vector<EndExample> examples = examples_of(read_dataset(arguments.dataset));
  const LinkWeights weights = learn_weights(examples);
  nlohmann::ordered_json json;
  for (const auto& [name, kind] : {std::pair{"chain_ends", LinkKind::chain_ends},
                                   {"tree_ends", LinkKind::tree_ends},
                                   {"junction", LinkKind::junction}}) {
    const auto [links, true_links] = count(examples, kind);
    json[name] = {{"links", links}, {"true", true_links}, {"weights", weights.of(kind)}};
    if (!arguments.json) {
      print_out("{:<10} {{{:.4f}}}  from {} links, {} true\n", name, fmt::join(weights.of(kind), ", "), links,
                true_links);
    }
  }
  if (arguments.json) print_json_line(json);
}

}  // namespace

void add_learn(CLI::App& app) {
  const auto arguments = std::make_shared<LearnArguments>();
  CLI::App* command =
      app.add_subcommand("learn", "Learn the axis method's link weights from the scenes of a dataset");
  command->add_option("dataset", arguments->dataset, "Directory of a dataset from `tanglebin generate`")
      ->required();
  command->add_flag("--json", arguments->json, "Print the weights as JSON");
  command->footer(
      "Example:\n  tanglebin learn dataset\n"
      "The built-in weights are from recipes/learning.toml (docs/algorithm.md).");
  command->callback([arguments] { learn(*arguments); });
}

}  // namespace tanglebin::cli
