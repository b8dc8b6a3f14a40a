#include "tanglebin/dataset/dataset.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <system_error>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/seen_case.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/io/ply.hpp"

namespace tanglebin {
namespace {

namespace fs = std::filesystem;

/// A file of a case, checked against the manifest, and its name for messages.
struct CheckedFile {
  std::string name;
  std::istringstream in;
};

CheckedFile open_checked(const fs::path& directory, const CaseRecord& record, std::string_view kind,
                         std::string_view extension, std::string_view scanner = {}) {
  const std::string path = file_of(record.id, kind, extension, scanner);
  const auto listed = std::ranges::find(record.files, path, &FileRecord::path);
  const fs::path file = directory / path;
  if (listed == record.files.end()) throw InputError({file.string(), 0, ""}, "not in the manifest");
  return {file.string(), std::istringstream(checked_bytes(directory, *listed))};
}

Recipe recipe_of_bytes(const std::string& bytes, const fs::path& file) {
  std::istringstream in(bytes);
  return read_recipe(in, file.string());
}

}  // namespace

Recipe recipe_in(const fs::path& directory) {
  const fs::path file = directory / recipe_name;
  return recipe_of_bytes(read_file(file), file);
}

Dataset read_dataset(const fs::path& directory) {
  const fs::path file = directory / recipe_name;
  const std::string bytes = read_file(file);
  return {directory, recipe_of_bytes(bytes, file), sha256(bytes), Catalogue(directory)};
}

std::string checked_bytes(const fs::path& directory, const FileRecord& file) {
  const fs::path path = directory / file.path;
  const auto expect_size = [&](std::uintmax_t found) {
    if (found == file.bytes) return;
    throw InputError({path.string(), 0, "bytes"}, fmt::format("{}", found),
                     fmt::format("{}, as the manifest says", file.bytes));
  };
  expect_below(directory, path);
  // So that a much larger file is not read, nor a pipe waited for.
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw InputError({path.string(), 0, ""}, "cannot be opened: " + error.message());
  expect_size(size);
  std::string bytes = read_file(path, file.bytes);
  expect_size(bytes.size());
  if (const std::string found = sha256(bytes); found != file.sha256) {
    throw InputError({path.string(), 0, "sha256"}, found, file.sha256 + ", as the manifest says");
  }
  return bytes;
}

std::vector<CaseId> cases(const Dataset& dataset) {
  std::vector<CaseId> there = cases(dataset.recipe);
  std::erase_if(there, [&](const CaseId& id) { return !dataset.catalogue.has(id); });
  return there;
}

Recipe recipe_of(const Dataset& dataset, const CaseId& id) {
  return resolve(dataset.recipe, id, dataset.catalogue.record(id).drawn);
}

void expect_clouds(const Dataset& dataset) {
  if (dataset.recipe.output.plys) return;
  throw InputError({(dataset.directory / recipe_name).string(), 0, "output.plys"},
                   "false, so the dataset has no clouds", "true; generate a dataset with clouds");
}

CaseData read_seen_case(const Dataset& dataset, const SeenCase& seen) {
  expect_clouds(dataset);
  const CaseRecord record = dataset.catalogue.record(seen.scene);
  CheckedFile cloud = open_checked(dataset.directory, record, "plys", "ply", seen.scanner);
  CheckedFile tubes = open_checked(dataset.directory, record, "tube_configurations", "txt");
  return {cloud.name, read_ply(cloud.in, cloud.name), read_configuration(tubes.in, tubes.name)};
}

CaseData read_case(const Dataset& dataset, const CaseId& id) {
  return read_seen_case(dataset, {id, dataset.recipe.scanner_name});
}

}  // namespace tanglebin
