#include "tanglebin/cli/progress_report.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "tanglebin/cli/print.hpp"

namespace tanglebin::cli {
namespace {

std::size_t done(const RunProgress& progress) {
  return progress.made + progress.failed;
}

std::size_t remaining(const RunProgress& progress) {
  return progress.wanted - progress.found - done(progress);
}

// Flushes, so that a program at the other end of a pipe gets the event at once.
void print_event(const nlohmann::ordered_json& event) {
  print_json_line(event);
  std::fflush(stdout);
}

}  // namespace

void add_progress_option(CLI::App& command, ProgressStyle& style) {
  const std::map<std::string, ProgressStyle> styles{{"line", ProgressStyle::line},
                                                    {"json", ProgressStyle::json}};
  command
      .add_option("--progress", style,
                  "line: one line on the terminal; json: a line of JSON on standard output for each event")
      ->transform(CLI::CheckedTransformer(styles))
      ->option_text("line|json [line]");
}

ProgressReport::~ProgressReport() {
  if (is_shown_) print_error("\n");
}

RunObserver ProgressReport::observer() {
  RunObserver observer{.stopping = [this] { print_stopping(); }};
  if (style_ == ProgressStyle::json) {
    observer.progress = [this](const RunProgress& progress) { print_progress(progress); };
    observer.ended = [](const CaseEvent& event, const RunProgress&) { print_end_of_case(event); };
    return observer;
  }
  if (is_terminal_) observer.progress = [this](const RunProgress& progress) { show_line(progress); };
  return observer;
}

double ProgressReport::rate(const RunProgress& progress) const {
  return static_cast<double>(done(progress)) / seconds_since(start_);
}

void ProgressReport::show_line(const RunProgress& progress) {
  std::string line = fmt::format("\r{} of {} cases", progress.found + done(progress), progress.wanted);
  if (done(progress) > 0) {
    const double pace = rate(progress);
    line += fmt::format(", {:.2g}/s, {} left", pace,
                        duration_text(static_cast<double>(remaining(progress)) / pace));
  }
  if (progress.rejected > 0) line += fmt::format(", {} attempts rejected", progress.rejected);
  if (progress.failed > 0) line += fmt::format(", {} cases failed", progress.failed);
  print_error("{} \x1b[K", line);
  is_shown_ = true;
}

void ProgressReport::print_stopping() const {
  if (is_shown_) print_error("\n");
  print_error("tanglebin: stopping after the cases in progress; once more to end at once\n");
}

void ProgressReport::print_progress(const RunProgress& progress) {
  if (Clock::now() - last_printed_ < std::chrono::seconds(1)) return;
  last_printed_ = Clock::now();
  nlohmann::ordered_json event{{"event", "progress"},       {"wanted", progress.wanted},
                               {"found", progress.found},   {"made", progress.made},
                               {"failed", progress.failed}, {"rejected", progress.rejected},
                               {"rate", rate(progress)},    {"remaining_seconds", nullptr}};
  if (done(progress) > 0) {
    event["remaining_seconds"] = static_cast<double>(remaining(progress)) / rate(progress);
  }
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

std::string duration_text(double seconds) {
  constexpr long in_minute = 60;
  constexpr long in_hour = 3600;
  const long whole = std::lround(seconds);
  if (whole < in_minute) return fmt::format("{} s", whole);
  if (whole < in_hour) return fmt::format("{} min {:02} s", whole / in_minute, whole % in_minute);
  return fmt::format("{} h {:02} min", whole / in_hour, whole % in_hour / in_minute);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace tanglebin::cli
