#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/cli/options/outputs.hpp"
#include "tanglebin/model/model_tubes.hpp"

namespace CLI {
class App;
}

// What `model` says of a model beside the labelled cloud.
namespace tanglebin::cli {

/// Files for other programs.
struct ModelFiles {
  std::optional<std::string> tubes;  ///< .txt or .json
  std::optional<std::string> mesh;   ///< .ply or .obj
};

/// Adds --modelled-tubes and --mesh, which fill `files`.
void add_options(CLI::App& command, ModelFiles& files);

/// The files that are asked for.
std::vector<Output> outputs(const ModelFiles& files);

/// Their names and contents.
std::vector<std::pair<std::string, std::string>> contents(const ModelFiles& files, const Model& model);

/// Prints a line for each tube, and where the points are.
void print_tubes(const Model& model);

/// Adds the same to the JSON that `model` prints: "usable", "counts", "findings" and "found".
void add_tubes(nlohmann::ordered_json& json, const Model& model);

/// Prints the findings to standard error, each on one line with the cloud's name.
void print_findings(const Model& model, const std::string& cloud);

/// Ends the command with its exit status if the model is refused.
void expect_usable(const Model& model);

}  // namespace tanglebin::cli
