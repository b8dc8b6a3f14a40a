#include "tanglebin/dataset/merge_datasets.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/case_files.hpp"
#include "tanglebin/dataset/dataset.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

/// A dataset to be merged.
struct Part {
  fs::path directory;
  Catalogue catalogue;
};

std::vector<Part> open_parts(const std::vector<fs::path>& directories, const Recipe& recipe) {
  std::vector<Part> parts;
  parts.reserve(directories.size());
  for (const fs::path& directory : directories) {
    expect_same_recipe(directory, recipe);
    parts.push_back({directory, Catalogue(directory)});
  }
  return parts;
}

// The part to take each case from.
std::map<CaseId, const Part*> sources(const std::vector<Part>& parts, const std::vector<CaseId>& of_recipe) {
  const std::set<CaseId> known(of_recipe.begin(), of_recipe.end());
  std::map<CaseId, const Part*> sources;
  for (const Part& part : parts) {
    const std::string manifest = (part.directory / manifest_name).string();
    for (const CaseId& id : part.catalogue.cases()) {
      const std::string name = name_of(id);
      if (!known.contains(id)) throw InputError({manifest, 0, name}, "not a case of the recipe");
      const auto [other, is_new] = sources.try_emplace(id, &part);
      if (is_new) continue;
      if (to_json(part.catalogue.record(id)) != to_json(other->second->catalogue.record(id))) {
        throw InputError({manifest, 0, name},
                         fmt::format("another scene than in {}", other->second->directory.string()));
      }
    }
  }
  return sources;
}

// Only files that a run would have written are copied.
void expect_own_paths(const CaseRecord& record, const std::vector<std::string>& own,
                      const fs::path& manifest) {
  for (const FileRecord& file : record.files) {
    if (std::ranges::find(own, file.path) != own.end()) continue;
    throw InputError({manifest.string(), 0, name_of(record.id)}, file.path, "one of the case's own files");
  }
}

MadeCase copy_case(const Part& part, const Recipe& recipe, const CaseId& id, const CaseWriter& writer) {
  const CaseRecord record = part.catalogue.record(id);
  expect_own_paths(record, paths_of(recipe, id), part.directory / manifest_name);
  for (const FileRecord& file : record.files) {
    writer.write(file.path, checked_bytes(part.directory, file));
  }
  return {record, part.catalogue.times(id).value_or(TimesRecord{id, {}, 0})};
}

}  // namespace

FillSummary merge_datasets(const std::vector<fs::path>& parts, const fs::path& directory, int jobs,
                           const RunObserver& observer) {
  if (parts.empty()) throw InputError({}, "no datasets to merge");
  FillRequest request{.recipe = recipe_in(parts.front()), .wanted = {}, .directory = directory, .jobs = jobs};
  const std::vector<Part> opened = open_parts(parts, request.recipe);
  const std::vector<CaseId> all = cases(request.recipe);
  const std::map<CaseId, const Part*> source_of = sources(opened, all);
  std::ranges::copy_if(all, std::back_inserter(request.wanted),
                       [&](const CaseId& id) { return source_of.contains(id); });
  for (const Part& part : opened) {
    for (const auto& [id, failed] : part.catalogue.failed()) request.failed.push_back(failed);
    request.made_with.insert(part.catalogue.made_with().begin(), part.catalogue.made_with().end());
    if (const auto summary = read_dataset_summary(part.directory)) {
      request.made_with.insert(summary->made_with.begin(), summary->made_with.end());
    }
  }
  return fill_dataset(
      request,
      [&](const CaseId& id, const CaseWriter& writer) {
        return copy_case(*source_of.at(id), request.recipe, id, writer);
      },
      observer);
}

}  // namespace tanglebin
