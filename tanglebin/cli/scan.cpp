#include <CLI/CLI.hpp>

#include "tanglebin/cli/commands.hpp"

namespace tanglebin::cli {

void add_scan(CLI::App& app) {
  app.add_subcommand("scan");
}

}  // namespace tanglebin::cli
