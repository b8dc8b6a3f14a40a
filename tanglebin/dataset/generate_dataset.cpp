#include "tanglebin/dataset/generate_dataset.hpp"

#include <sys/resource.h>

#include <chrono>
#include <string>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/case_files.hpp"
#include "tanglebin/dataset/versions.hpp"
#include "tanglebin/runs/workers.hpp"
#include "tanglebin/simulate/simulate.hpp"

namespace tanglebin {
namespace {

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

std::vector<ScannerRecord> scanner_records(const Recipe& recipe, const SimulatedScene& scene) {
  if (recipe.scanner_name.empty()) return {};
  const bool with_bin = recipe.output.bin_points;
  std::vector<ScannerRecord> records{{recipe.scanner_name, count_points(scene.scan, with_bin)}};
  for (std::size_t i = 0; i < recipe.further_scanners.size(); ++i) {
    records.push_back({recipe.further_scanners[i].name, count_points(scene.further_scans[i], with_bin)});
  }
  return records;
}

// One case from the recipe to its files.
MadeCase make_case(const Recipe& dataset_recipe, const CaseId& id, const CaseWriter& writer) {
  const std::vector<DrawnNumber> drawn = draw(dataset_recipe, id);
  const auto [recipe, scene] = [&] {
    try {
      Recipe resolved = resolve(dataset_recipe, id, drawn);
      SimulatedScene simulated = simulate(resolved, id, stop_if_asked);
      return std::pair{std::move(resolved), std::move(simulated)};
    } catch (const InputError& error) {  // no valid recipe or scene; the next case may have one
      throw TaskImpossible(error.problem());
    }
  }();

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
    record.files.push_back(writer.write(file.path, file.bytes));
  }
  TimesRecord times{id, scene.times, peak_memory()};
  times.times.write = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return {std::move(record), times};
}

}  // namespace

FillSummary generate_cases(FillRequest request, const RunObserver& observer) {
  request.made_with = {versions()};
  return fill_dataset(
      request,
      [&](const CaseId& id, const CaseWriter& writer) { return make_case(request.recipe, id, writer); },
      observer);
}

FillSummary generate_dataset(const Recipe& recipe, const std::vector<CaseId>& wanted,
                             const std::filesystem::path& directory, int jobs, const RunObserver& observer,
                             const std::optional<Shard>& shard) {
  expect_cases(recipe, wanted);
  return generate_cases(
      {.recipe = recipe, .wanted = wanted, .directory = directory, .shard = shard, .jobs = jobs}, observer);
}

}  // namespace tanglebin
