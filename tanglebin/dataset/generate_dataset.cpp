#include "tanglebin/dataset/generate_dataset.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/case_files.hpp"
#include "tanglebin/dataset/journal.hpp"
#include "tanglebin/dataset/manifest.hpp"
#include "tanglebin/dataset/safe_file.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/dataset/simulate.hpp"
#include "tanglebin/dataset/workers.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

/// Keeps a directory for one run and its workers. The kernel gives it back when the last of them ends.
class DirectoryLock {
public:
  explicit DirectoryLock(const fs::path& directory)
      : descriptor_(open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor_ < 0) throw InputError({directory.string(), 0, ""}, std::strerror(errno));
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      close(descriptor_);
      throw InputError({directory.string(), 0, ""}, "another run is writing here");
    }
  }
  ~DirectoryLock() { close(descriptor_); }
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

private:
  int descriptor_;
};

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

// One case from the recipe to the journal.
void make_case(const Recipe& recipe, const CaseId& id, const fs::path& directory, const Journal& journal) {
  const Scene scene = simulate(recipe, id);

  const auto start = std::chrono::steady_clock::now();
  CaseRecord record{id,
                    scene.seed,
                    scene.simulated,
                    scene.largest_overlap,
                    count_points(scene.scan, recipe.output.bin_points),
                    scene.rejections,
                    {}};
  for (const CaseFile& file : case_files(recipe, id, scene)) {
    make_directories((directory / file.path).parent_path());
    write_file(directory / file.path, file.bytes);
    record.files.push_back({file.path, file.bytes.size(), sha256(file.bytes)});
  }
  TimesRecord times{id, scene.times, peak_memory()};
  times.times.write = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  journal.append(record, times);
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

  // Whatever ends the run, what is done gets into the manifest.
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
  try {
    const Journal journal(directory);
    run_in_workers(
        jobs, missing.size(), [&](std::size_t task) { make_case(recipe, missing[task], directory, journal); },
        [&](std::size_t done) { progress(summary.found + done); });
  } catch (...) {
    finish();
    throw;
  }
  finish();
  return summary;
}

}  // namespace tanglebin
