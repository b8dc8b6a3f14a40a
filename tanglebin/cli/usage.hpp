#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Error;
}  // namespace CLI

// What the command line says about names of commands and options.
namespace tanglebin::cli {

/// The arguments after the program's name, with the current names of renamed options. Prints a line on
/// standard error for each.
std::vector<std::string> with_current_names(std::vector<std::string> arguments);

/// Throws CLI::ParseError for a missing or unknown command and for an unknown option, with the names that
/// there are.
void expect_known_names(const CLI::App& app, const std::vector<std::string>& arguments);

/// What the program prints of a command line that CLI11 rejects.
std::string usage_message(const CLI::App* app, const CLI::Error& error);

}  // namespace tanglebin::cli
