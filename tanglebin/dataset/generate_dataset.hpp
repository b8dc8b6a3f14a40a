#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "tanglebin/dataset/case_id.hpp"
#include "tanglebin/dataset/recipe.hpp"

namespace tanglebin {

/// What a run of generate_dataset() came to.
struct GenerateSummary {
  std::size_t wanted = 0;    ///< cases asked for
  std::size_t found = 0;     ///< of these, already there
  std::size_t made = 0;      ///< of these, made now
  std::size_t rejected = 0;  ///< attempts that gave no valid scene, over the cases made now
  bool complete() const { return found + made == wanted; }
};

/// Makes the wanted cases in `directory`, in `jobs` processes, and with them recipe.toml, manifest.jsonl and
/// times.jsonl (docs/formats.md). Cases that are there already stay as they are, so a run that was stopped
/// goes on where it was: finished cases are in a journal, and their files are whole. The bytes of recipe,
/// manifest and case files depend on recipe and wanted cases alone. Returns early, with what is done, on
/// SIGINT and SIGTERM. `progress` is told how many of the cases are done. Throws InputError where `directory`
/// belongs to another recipe or to a run that is under way, where a file cannot be written, and where a case
/// has no valid scene.
GenerateSummary generate_dataset(const Recipe& recipe, const std::vector<CaseId>& wanted,
                                 const std::filesystem::path& directory, int jobs,
                                 const std::function<void(std::size_t done)>& progress);

}  // namespace tanglebin
