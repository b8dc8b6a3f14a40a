#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/print.hpp"
#include "tanglebin/cli/usage.hpp"

namespace {

using tanglebin::cli::print_error;

constexpr int exit_internal_error = 1;
constexpr int exit_bad_input = 2;
constexpr int exit_usage = 64;  // EX_USAGE of sysexits.h

int run(int argc, char** argv) {
  CLI::App app{
      "Simulate labelled 3D scans of bins of entangled tubes; model the tubes and score the result."};
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
  app.failure_message(tanglebin::cli::usage_message);
  try {
    std::vector<std::string> arguments = tanglebin::cli::with_current_names({argv + 1, argv + argc});
    tanglebin::cli::expect_known_names(app, arguments);
    std::ranges::reverse(arguments);  // CLI11 takes them from the end
    app.parse(std::move(arguments));  // runs the chosen command's callback
  } catch (const CLI::ParseError& error) {
    // A RuntimeError carries the exit status that a command chose; anything else is wrong usage.
    const int status = app.exit(error);
    const bool is_usage = dynamic_cast<const CLI::RuntimeError*>(&error) == nullptr;
    return status != 0 && is_usage ? exit_usage : status;
  }
  return 0;
}

// Writing to a pipe only fails if the reader has closed it, which is the reader's choice.
bool is_pipe(int descriptor) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 && (S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode));
}

bool is_output_lost() {
  std::cout.flush();
  const bool is_lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  return is_lost && !is_pipe(STDOUT_FILENO);
}

int run_and_explain(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const tanglebin::InputError& error) {
    print_error("tanglebin: {}\n", error.what());
    return exit_bad_input;
  } catch (const std::exception& error) {
    print_error("tanglebin: {}\n", error.what());
    return exit_internal_error;
  }
}

}  // namespace

int main(int argc, char** argv) {
  // If the reader of the output exits, this program goes on: it does more than print.
  std::signal(SIGPIPE, SIG_IGN);
  const int status = run_and_explain(argc, argv);
  if (!is_output_lost()) return status;
  print_error("tanglebin: standard output: cannot write all output\n");
  return exit_bad_input;
}
