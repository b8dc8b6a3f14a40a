#include "tanglebin/cli/terminal/progress_report.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "tanglebin/base/text.hpp"
#include "tanglebin/cli/terminal/print.hpp"

namespace tanglebin::cli {
namespace {

// Flushes, so that a program at the other end of a pipe gets the event at once.
void print_event(const nlohmann::ordered_json& event) {
  print_json_line(event);
  std::fflush(stdout);
}

}  // namespace

void add_progress_option(CLI::App& command, ProgressStyle& style) {
  const auto set_style = [&style](const std::string& name) {
    if (name != "line" && name != "json")
      throw CLI::ValidationError("--progress", fmt::format("found {}, expected line or json", excerpt(name)));
    style = name == "json" ? ProgressStyle::json : ProgressStyle::line;
  };
  command
      .add_option_function<std::string>("--progress", set_style,
                                        "line: on standard error, one line on a terminal or now and then one "
                                        "in a log; json: a line of JSON "
                                        "on standard output for each event")
      ->option_text("line|json [line]");
}

ProgressReport::~ProgressReport() {
  if (is_shown_) print_error("\n");
}

RunObserver ProgressReport::observer() {
  return {.begun = [this](const std::vector<CaseId>& cases) { remaining_.begin(cases); },
          .progress = [this](const RunProgress& progress) { show(progress); },
          .ended = [this](const CaseEvent& event, const RunProgress&) { end(event); },
          .stopping = [this] { print_stopping(); }};
}

void ProgressReport::show(const RunProgress& progress) {
  if (style_ == ProgressStyle::json) {
    print_progress(progress);
  } else if (is_terminal_) {
    show_line(progress);
  } else {
    log(progress);
  }
}

void ProgressReport::end(const CaseEvent& event) {
  remaining_.end(event.id);
  if (style_ == ProgressStyle::json) print_end_of_case(event);
}

void ProgressReport::show_line(const RunProgress& progress) {
  print_error("\r{} \x1b[K", progress_text(progress, remaining_, seconds_since(start_)));
  is_shown_ = true;
}

void ProgressReport::print_stopping() const {
  if (is_shown_) print_error("\n");
  print_error("tanglebin: stopping after the cases in progress; once more to end at once\n");
}

void ProgressReport::log(const RunProgress& progress) {
  const double elapsed = seconds_since(start_);
  const double share =
      static_cast<double>(ended(progress)) / static_cast<double>(std::max<std::size_t>(1, progress.wanted));
  if (!schedule_.is_due(elapsed, share)) return;
  print_error("tanglebin: {}\n", progress_text(progress, remaining_, elapsed));
}

void ProgressReport::print_progress(const RunProgress& progress) {
  if (Clock::now() - last_printed_ < std::chrono::seconds(1)) return;
  last_printed_ = Clock::now();
  const double elapsed = seconds_since(start_);
  nlohmann::ordered_json event{{"event", "progress"}};
  event.update(counts_json(progress));
  event["rejected"] = progress.rejected;
  event["rate"] = rate(progress, elapsed);
  event["remaining_seconds"] = nullptr;
  if (const auto seconds = remaining_.seconds(elapsed)) event["remaining_seconds"] = *seconds;
  print_event(event);
}

void ProgressReport::print_end_of_case(const CaseEvent& event) {
  nlohmann::ordered_json json{{"event", event.failure.empty() ? "case" : "failure"},
                              {"set", event.id.set},
                              {"tubes", event.id.tubes},
                              {"case", event.id.number}};
  if (event.failure.empty()) {
    json["seconds"] = event.seconds;
    json["rejected"] = event.rejected;
  } else {
    json["reason"] = event.failure;
  }
  print_event(json);
}

nlohmann::ordered_json counts_json(const RunProgress& run) {
  return {{"wanted", run.wanted}, {"found", run.found}, {"made", run.made}, {"failed", run.failed}};
}

std::string left_over(const RunProgress& run) {
  return fmt::format("; stopped, {} to go", run.wanted - run.found - run.made - run.failed);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace tanglebin::cli
