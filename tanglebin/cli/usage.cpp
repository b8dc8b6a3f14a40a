#include "tanglebin/cli/usage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>

#include "tanglebin/base/suggestion.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/cli/terminal/print.hpp"

namespace tanglebin::cli {
namespace {

struct Renaming {
  std::string_view command;
  std::string_view old_name;
  std::string_view name;
};

// The names of 0.1.0, for one version.
constexpr std::array<Renaming, 4> renamings{{{"scan", "--set", "--parameter"},
                                             {"model", "--tubes", "--modelled-tubes"},
                                             {"score", "--labels", "--labelled"},
                                             {"score", "--tubes", "--modelled-tubes"}}};

bool is_option(std::string_view argument) {
  return argument.size() > 2 && argument.starts_with("--");
}

// "--name" of "--name" and of "--name=value".
std::string_view name_of_option(std::string_view argument) {
  return argument.substr(0, argument.find('='));
}

std::vector<std::string_view> names_of(const std::vector<const CLI::App*>& commands) {
  std::vector<std::string_view> names;
  names.reserve(commands.size());
  for (const CLI::App* command : commands) names.emplace_back(command->get_name());
  return names;
}

// Those that have a name, "--name": not the positional arguments.
std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

[[noreturn]] void reject(const std::string& message) {
  throw CLI::ParseError(message, CLI::ExitCodes::ExtrasError);
}

void expect_known_option(const CLI::App& command, const std::string& argument) {
  const std::string_view name = name_of_option(argument);
  const std::vector<std::string> known = options_of(command);
  if (std::ranges::find(known, name) != known.end()) return;
  reject(fmt::format("unknown option {}, {}", excerpt(name), suggestion(name, {known.begin(), known.end()})));
}

}  // namespace

std::vector<std::string> with_current_names(std::vector<std::string> arguments) {
  for (std::string& argument : arguments) {
    const auto renaming = std::ranges::find_if(renamings, [&](const Renaming& candidate) {
      return candidate.command == arguments.front() && candidate.old_name == name_of_option(argument);
    });
    if (renaming == renamings.end()) continue;
    print_error("tanglebin: {} is now {}\n", renaming->old_name, renaming->name);
    argument.replace(0, renaming->old_name.size(), renaming->name);
  }
  return arguments;
}

void expect_known_names(const CLI::App& app, const std::vector<std::string>& arguments) {
  const std::vector<const CLI::App*> commands = app.get_subcommands([](const CLI::App*) { return true; });
  const std::vector<std::string_view> names = names_of(commands);
  if (arguments.empty()) reject(fmt::format("expected a command: {}", fmt::join(names, ", ")));
  const std::string& name = arguments.front();
  const auto has_name = [&](const CLI::App* command) { return command->get_name() == name; };
  const auto command = std::ranges::find_if(commands, has_name);
  if (command == commands.end() && !name.starts_with('-'))
    reject(fmt::format("unknown command {}, {}", excerpt(name), suggestion(name, names)));
  for (const std::string& argument : arguments) {
    if (is_option(argument)) expect_known_option(command == commands.end() ? app : **command, argument);
  }
}

std::string usage_message(const CLI::App* /*app*/, const CLI::Error& error) {
  std::string text = error.what();
  // CLI11 counts the values and names their type.
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    text = text.substr(0, text.find(':')) + ": expected one value";
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) text += "; lists have commas, such as 1,5,10";
  return fmt::format("tanglebin: {}\nRun with --help for more information.\n", text);
}

}  // namespace tanglebin::cli
