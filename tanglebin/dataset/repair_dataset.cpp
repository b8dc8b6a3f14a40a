#include "tanglebin/dataset/repair_dataset.hpp"

#include <system_error>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/case_files.hpp"
#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/dataset/generate_dataset.hpp"
#include "tanglebin/files/safe_file.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

// A link to one is not in the way: the file takes the link's place.
void expect_no_directory_in_the_way(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_directory(fs::symlink_status(file, ignored)))
    throw InputError({file.string(), 0, ""}, "a directory", "a file or nothing");
}

// Before anything is changed, as what is in the way may be the user's.
void expect_nothing_in_the_way(const fs::path& directory, const VerifySummary& found) {
  for (const char* name : dataset_files) expect_no_directory_in_the_way(directory / name);
  for (const CaseId& id : found.broken) {
    for (const std::string& path : paths_of(found.recipe, id)) {
      expect_no_file_in_the_way((directory / path).parent_path());
      expect_no_directory_in_the_way(directory / path);
    }
  }
}

}  // namespace

FillSummary repair_dataset(const std::filesystem::path& directory, const VerifySummary& found, int jobs,
                           const RunObserver& observer) {
  expect_nothing_in_the_way(directory, found);
  return generate_cases({.recipe = found.recipe,
                         .wanted = found.broken,
                         .directory = directory,
                         .jobs = jobs,
                         .repair = found.broken},
                        observer);
}

}  // namespace tanglebin
