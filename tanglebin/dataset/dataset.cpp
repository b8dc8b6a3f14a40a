#include "tanglebin/dataset/dataset.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <system_error>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/ply.hpp"
#include "tanglebin/io/read_file.hpp"
#include "tanglebin/io/safe_file.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

/// A file of a case, whole as it was written, and its name for messages.
struct CheckedFile {
  std::string name;
  std::istringstream in;
};

CheckedFile open_checked(const Dataset& dataset, const CaseId& id, std::string_view kind,
                         std::string_view extension, std::string_view scanner = {}) {
  const std::string path = file_of(id, kind, extension, scanner);
  const std::vector<FileRecord>& files = dataset.finished.records.at(id).files;
  const auto record = std::ranges::find(files, path, &FileRecord::path);
  const fs::path file = dataset.directory / path;
  if (record == files.end()) throw InputError({file.string(), 0, ""}, "not in the manifest");
  return {file.string(), std::istringstream(checked_bytes(dataset.directory, *record))};
}

}  // namespace

Dataset read_dataset(const fs::path& directory) {
  const fs::path file = directory / "recipe.toml";
  const std::string text = read_file(file);
  std::istringstream in(text);
  return {directory, read_recipe(in, file.string()), sha256(text), finished_cases(directory)};
}

std::string checked_bytes(const fs::path& directory, const FileRecord& file) {
  const fs::path path = directory / file.path;
  const auto expect_size = [&](std::uintmax_t found) {
    if (found == file.bytes) return;
    throw InputError({path.string(), 0, "bytes"}, fmt::format("{}", found),
                     fmt::format("{}, as the manifest says", file.bytes));
  };
  expect_below(directory, path);
  // A file that is much larger than it is to be is not read, nor is a pipe waited for.
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw InputError({path.string(), 0, ""}, "cannot be opened: " + error.message());
  expect_size(size);
  std::string bytes = read_file(path, file.bytes + 1);
  expect_size(bytes.size());
  if (const std::string found = sha256(bytes); found != file.sha256) {
    throw InputError({path.string(), 0, "sha256"}, found, file.sha256 + ", as the manifest says");
  }
  return bytes;
}

std::vector<CaseId> cases(const Dataset& dataset) {
  std::vector<CaseId> there = cases(dataset.recipe);
  std::erase_if(there, [&](const CaseId& id) { return !dataset.finished.records.contains(id); });
  return there;
}

Recipe recipe_of(const Dataset& dataset, const CaseId& id) {
  return resolve(dataset.recipe, dataset.finished.records.at(id).drawn);
}

CaseData read_case(const Dataset& dataset, const CaseId& id) {
  CheckedFile cloud = open_checked(dataset, id, "plys", "ply", dataset.recipe.scanner_name);
  CheckedFile tubes = open_checked(dataset, id, "tube_configurations", "txt");
  return {cloud.name, read_ply(cloud.in, cloud.name), read_configuration(tubes.in, tubes.name)};
}

}  // namespace tanglebin
