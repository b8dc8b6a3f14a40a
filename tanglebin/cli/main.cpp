#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/commands.hpp"

namespace {

constexpr int exit_internal_error = 1;
constexpr int exit_bad_input = 2;
constexpr int exit_usage = 64;  // EX_USAGE of sysexits.h

int run(int argc, char** argv) {
  CLI::App app{"Labelled 3D scans of bins of entangled tubes: generate, settle, scan, model, score."};
  app.name("tanglebin");
  app.set_version_flag("--version", TANGLEBIN_VERSION);
  app.require_subcommand(1);
  tanglebin::cli::add_generate(app);
  tanglebin::cli::add_merge(app);
  tanglebin::cli::add_verify(app);
  tanglebin::cli::add_scan(app);
  tanglebin::cli::add_preview(app);
  tanglebin::cli::add_model(app);
  tanglebin::cli::add_score(app);
  tanglebin::cli::add_experiment(app);
  tanglebin::cli::add_report(app);
  tanglebin::cli::add_learn(app);
  try {
    app.parse(argc, argv);  // runs the chosen command's callback
  } catch (const CLI::ParseError& error) {
    // A command that ends early by its own choice says with which status; all else is wrong usage.
    const int status = app.exit(error);
    const bool is_usage = dynamic_cast<const CLI::RuntimeError*>(&error) == nullptr;
    return status != 0 && is_usage ? exit_usage : status;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const tanglebin::InputError& error) {
    fmt::print(stderr, "tanglebin: {}\n", error.what());
    return exit_bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "tanglebin: {}\n", error.what());
    return exit_internal_error;
  }
}
