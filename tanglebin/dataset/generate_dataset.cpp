#include "tanglebin/dataset/generate_dataset.hpp"

#include <fmt/core.h>
#include <sys/resource.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/case_files.hpp"
#include "tanglebin/dataset/directory_lock.hpp"
#include "tanglebin/dataset/finished_cases.hpp"
#include "tanglebin/dataset/journal.hpp"
#include "tanglebin/dataset/manifest.hpp"
#include "tanglebin/dataset/safe_file.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/dataset/simulate.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

std::string text_of(const Recipe& recipe) {
  std::ostringstream out;
  write_recipe(out, recipe);
  return out.str();
}

// The directory's recipe is written once; another one is not let in.
void claim(const fs::path& directory, const Recipe& recipe) {
  const fs::path file = directory / "recipe.toml";
  const std::string wanted = text_of(recipe);
  if (!fs::exists(file)) {
    write_file(file, wanted);
    return;
  }
  std::ifstream found_stream(file);
  std::istringstream wanted_stream(wanted);
  std::string found_line;
  std::string wanted_line;
  for (std::size_t number = 1;; ++number) {
    const bool more_found = static_cast<bool>(std::getline(found_stream, found_line));
    const bool more_wanted = static_cast<bool>(std::getline(wanted_stream, wanted_line));
    if (!more_found && !more_wanted) return;
    if (more_found && more_wanted && found_line == wanted_line) continue;
    throw InputError({file.string(), number, ""},
                     fmt::format("the directory belongs to another recipe: it has \"{}\", this one \"{}\"",
                                 more_found ? found_line : "", more_wanted ? wanted_line : ""));
  }
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  constexpr double kibibytes_in_mebibyte = 1024;
  return static_cast<double>(usage.ru_maxrss) / kibibytes_in_mebibyte;
}

std::size_t count_points(const Scan& scan, bool with_bin) {
  std::size_t points = 0;
  for (const Pixel& pixel : scan.pixels) {
    if (pixel.label > bin_label || (with_bin && pixel.label == bin_label)) ++points;
  }
  return points;
}

std::vector<ScannerRecord> scanner_records(const Recipe& recipe, const Scene& scene) {
  if (recipe.scanner_name.empty()) return {};
  const bool with_bin = recipe.output.bin_points;
  std::vector<ScannerRecord> records{{recipe.scanner_name, count_points(scene.scan, with_bin)}};
  for (std::size_t i = 0; i < recipe.further_scanners.size(); ++i) {
    records.push_back({recipe.further_scanners[i].name, count_points(scene.further_scans[i], with_bin)});
  }
  return records;
}

// One case from the recipe to its files; returns what the journal is to have of it.
std::string make_case(const Recipe& dataset_recipe, const CaseId& id, const fs::path& directory) {
  const std::vector<DrawnNumber> drawn = draw(dataset_recipe, id);
  const Recipe recipe = resolve(dataset_recipe, drawn);
  const Scene scene = simulate(recipe, id);

  const auto start = std::chrono::steady_clock::now();
  CaseRecord record{id,
                    scene.seed,
                    scene.simulated,
                    scene.largest_overlap,
                    count_points(scene.scan, recipe.output.bin_points),
                    scene.rejections,
                    {},
                    scanner_records(recipe, scene),
                    drawn};
  for (const CaseFile& file : case_files(recipe, id, scene)) {
    make_directories((directory / file.path).parent_path());
    write_file(directory / file.path, file.bytes);
    record.files.push_back({file.path, file.bytes.size(), sha256(file.bytes)});
  }
  TimesRecord times{id, scene.times, peak_memory()};
  times.times.write = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return journal_line(record, times);
}

}  // namespace

GenerateSummary generate_dataset(const Recipe& recipe, const std::vector<CaseId>& wanted,
                                 const fs::path& directory, int jobs,
                                 const std::function<void(std::size_t done)>& progress) {
  make_directories(directory);
  const DirectoryLock lock(directory);
  claim(directory, recipe);
  const std::vector<CaseId> all = cases(recipe);
  const FinishedCases before = finished_cases(directory);
  write_manifest(directory, before, all);  // also clears away a journal whose last line may be cut off
  std::vector<CaseId> missing;
  for (const CaseId& id : wanted) {
    if (!before.records.contains(id)) missing.push_back(id);
  }
  GenerateSummary summary{
      .wanted = wanted.size(), .found = wanted.size() - missing.size(), .made = 0, .rejected = 0};

  const auto finish = [&] {
    const FinishedCases after = finished_cases(directory);
    for (const CaseId& id : missing) {
      const auto made = after.records.find(id);
      if (made == after.records.end()) continue;
      ++summary.made;
      summary.rejected += made->second.rejections.size();
    }
    write_manifest(directory, after, all);
  };
  run_with_journal(
      directory, jobs, missing.size(),
      [&](std::size_t task) { return make_case(recipe, missing[task], directory); },
      [&](std::size_t done) { progress(summary.found + done); }, finish);
  return summary;
}

}  // namespace tanglebin
