#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "tanglebin/cli/commands.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/options/outputs.hpp"
#include "tanglebin/report/page.hpp"
#include "tanglebin/report/results.hpp"

namespace tanglebin::cli {
namespace {

struct ReportArguments {
  std::string results;
  std::string out;
};

void write_report(const ReportArguments& arguments) {
  expect_outputs({{"--out", arguments.out, {".html"}}}, {arguments.results});
  write_output(arguments.out, report_page(read_results_directory(arguments.results), arguments.out));
}

}  // namespace

void add_report(CLI::App& app) {
  const auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command =
      app.add_subcommand("report", "Write an HTML page of an experiment's results, beside the paper's");
  command->add_option("results", arguments->results, "Directory of results from `tanglebin experiment`")
      ->required();
  command->add_option("--out", arguments->out, "Self-contained HTML page to write; - for standard output")
      ->required();
  command->footer("Example:\n  tanglebin report results --out report.html");
  command->callback([arguments] { write_report(*arguments); });
}

}  // namespace tanglebin::cli
