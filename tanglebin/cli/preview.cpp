#include <CLI/CLI.hpp>

#include "tanglebin/cli/commands.hpp"

namespace tanglebin::cli {

void add_preview(CLI::App& app) {
  app.add_subcommand("preview");
}

}  // namespace tanglebin::cli
