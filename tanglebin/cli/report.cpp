#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "tanglebin/cli/arguments.hpp"
#include "tanglebin/cli/commands.hpp"
#include "tanglebin/report/page.hpp"
#include "tanglebin/report/results.hpp"

namespace tanglebin::cli {
namespace {

struct ReportArguments {
  std::string results;
  std::string out;
};

void write_report(const ReportArguments& arguments) {
  write_output(arguments.out, report_page(read_results_directory(arguments.results)));
}

}  // namespace

void add_report(CLI::App& app) {
  const auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command =
      app.add_subcommand("report", "Write an experiment's results as a page, beside the paper's");
  command->add_option("results", arguments->results, "Directory that `tanglebin experiment` wrote")
      ->required();
  command
      ->add_option("--out", arguments->out,
                   "HTML page to write: one file that needs no other; - writes standard output")
      ->required();
  command->footer(
      "Draws with gnuplot (Debian: gnuplot-nox).\n\n"
      "Example:\n  tanglebin report results --out report.html");
  command->callback([arguments] { write_report(*arguments); });
}

}  // namespace tanglebin::cli
