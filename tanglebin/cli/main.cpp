#include <fmt/format.h>
#include <malloc.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/terminal/exit_status.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/cli/usage.hpp"
#include "tanglebin/dataset/versions.hpp"

namespace {

using namespace tanglebin::cli;

// "0.2.0 (boost 1.74.0, compiler GNU 12.2.0, …)"
std::string version_and_build() {
  tanglebin::Versions others = tanglebin::versions();
  const std::string version = others.extract("tanglebin").mapped();
  std::vector<std::string> build;
  build.reserve(others.size());
  for (const auto& [name, of] : others) build.push_back(fmt::format("{} {}", name, of));
  return fmt::format("{} ({})", version, fmt::join(build, ", "));
}

int run(int argc, char** argv) {
  CLI::App app{
      "Simulate labelled 3D scans of bins of entangled tubes; model the tubes and score the result."};
  app.name("tanglebin");
  app.set_version_flag("--version", version_and_build());
  app.require_subcommand(1);
  add_generate(app);
  add_merge(app);
  add_verify(app);
  add_export(app);
  add_scan(app);
  add_preview(app);
  add_view(app);
  add_locate(app);
  add_model(app);
  add_score(app);
  add_experiment(app);
  add_compare(app);
  add_report(app);
  add_learn(app);
  add_calibrate(app);
  app.footer(
      "Exit status: 0 done, 2 bad input, 3 cases failed, 4 faults found, 5 the system refused (disk full, "
      "…),\n"
      "6 a scan that does not fit its scene or shows no tube, 7 worse than allowed, 64 wrong usage, 130 and "
      "143\n"
      "interrupted, 1 an error of the program itself.");
  app.failure_message(usage_message);
  try {
    std::vector<std::string> arguments = with_current_names({argv + 1, argv + argc});
    expect_known_names(app, arguments);
    std::ranges::reverse(arguments);  // CLI11 takes them from the end
    app.parse(std::move(arguments));  // runs the chosen command's callback
  } catch (const CLI::ParseError& error) {
    // A RuntimeError carries the exit status that a command chose; anything else is wrong usage.
    std::stringstream complaints;
    const int status = app.exit(error, std::cout, complaints);
    for (std::string line; std::getline(complaints, line);) print_error("{}\n", line);
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

int explain(const char* what, int status) {
  print_error("tanglebin: {}\n", what);
  return status;
}

int run_and_explain(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const tanglebin::InputError& error) {
    return explain(error.what(), exit_bad_input);
  } catch (const tanglebin::SystemError& error) {
    return explain(error.what(), exit_refused);
  } catch (const std::system_error& error) {
    return explain(error.what(), exit_refused);
  } catch (const std::bad_alloc&) {
    return explain("out of memory", exit_refused);
  } catch (const std::exception& error) {
    return explain(error.what(), exit_internal_error);
  }
}

// The large buffers of a case are those of the next one. Getting them anew, zeroed by the kernel, takes a
// twentieth of the time.
void keep_freed_memory() {
  constexpr int mebibyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * mebibyte);  // the most that glibc accepts
  mallopt(M_TRIM_THRESHOLD, 1024 * mebibyte);
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  // If the reader of the output exits, this program goes on: it does more than print.
  std::signal(SIGPIPE, SIG_IGN);
  // A file that may not grow (ulimit -f) is an error as a full disk is.
  std::signal(SIGXFSZ, SIG_IGN);
  const int status = run_and_explain(argc, argv);
  if (!is_output_lost()) return status;
  return explain("standard output: cannot write all output", exit_refused);
}
