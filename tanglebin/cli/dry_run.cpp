#include "tanglebin/cli/dry_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cli/options/arguments.hpp"
#include "tanglebin/cli/terminal/print.hpp"
#include "tanglebin/io/images.hpp"
#include "tanglebin/pictures/picture_of_scan.hpp"
#include "tanglebin/report/text.hpp"
#include "tanglebin/scan/scanner.hpp"

namespace tanglebin::cli {
namespace {

SetEstimate sum_of(const std::vector<SetEstimate>& sets) {
  SetEstimate sum;
  for (const SetEstimate& set : sets) {
    sum.cases += set.cases;
    sum.seconds += set.seconds;
    sum.bytes += set.bytes;
  }
  return sum;
}

// Two digits are more than an estimate deserves.
std::string rough_duration(double seconds) {
  constexpr double minute = 60;
  constexpr double hour = 60 * minute;
  if (seconds < 2 * minute) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < 2 * hour) return fmt::format("{:.0f} min", seconds / minute);
  return fmt::format("{:.0f} h", seconds / hour);
}

std::string size_text(double bytes) {
  constexpr double megabyte = 1e6;
  constexpr double gigabyte = 1e9;
  if (bytes < gigabyte) return fmt::format("{:.0f} MB", std::ceil(bytes / megabyte));
  return fmt::format("{:.1f} GB", bytes / gigabyte);
}

void print_text(const DryRun& run, int jobs) {
  for (const SetEstimate& set : run.sets) {
    print_out("set {}: {}, about {} of one processor's time and {}\n", set.set, counted(set.cases, "case"),
              rough_duration(set.seconds), size_text(set.bytes));
  }
  const SetEstimate all = sum_of(run.sets);
  print_out("in all: {}, about {} with --jobs {} and {}\n", counted(all.cases, "case"),
            rough_duration(all.seconds / jobs), jobs, size_text(all.bytes));
  for (const std::string& warning : run.warnings) print_out("warning: {}\n", warning);
}

nlohmann::ordered_json json_of(const SetEstimate& estimate) {
  return {{"cases", estimate.cases},
          {"processor_seconds", estimate.seconds},
          {"bytes", std::round(estimate.bytes)}};
}

void print_json(const DryRun& run) {
  nlohmann::ordered_json json = json_of(sum_of(run.sets));
  for (const SetEstimate& set : run.sets) json["sets"][set.set] = json_of(set);
  json["warnings"] = run.warnings;
  print_json_line(json);
}

void write_picture(const DryRun& run, const std::string& file) {
  if (!run.first) throw InputError({"", 0, "--picture"}, "no valid scene", "one to draw");
  const auto& [recipe, scene] = *run.first;
  const Scan ideal = scan(scene.tubes, recipe.bin, recipe.camera);
  const Picture picture = picture_of_scan(ideal, scene.scan, "the first case");
  write_output(file, color_png(picture.width, picture.height, picture.pixels));
}

}  // namespace

void print_dry_run(const Recipe& recipe, const std::vector<CaseId>& wanted, const DryRunReport& report) {
  const DryRun run = dry_run(
      recipe, wanted, std::min<std::chrono::steady_clock::duration>(report.case_limit, default_patience));
  if (report.picture == standard_stream) {
    for (const std::string& warning : run.warnings) print_error("tanglebin: warning: {}\n", warning);
  } else if (report.json) {
    print_json(run);
  } else {
    print_text(run, report.jobs);
  }
  if (report.picture) write_picture(run, *report.picture);
}

}  // namespace tanglebin::cli
