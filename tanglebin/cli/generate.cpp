#include <CLI/CLI.hpp>

#include "tanglebin/cli/commands.hpp"

namespace tanglebin::cli {

void add_generate(CLI::App& app) {
  app.add_subcommand("generate");
}

}  // namespace tanglebin::cli
