#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "tanglebin/dataset/manifest.hpp"
#include "tanglebin/dataset/sha256.hpp"
#include "tanglebin/dataset/versions.hpp"

namespace tanglebin {

/// The content of dataset.json: a dataset in a few numbers, and what it was made with.
struct DatasetSummary {
  std::size_t cases = 0;           ///< in the manifest
  std::size_t recipe_cases = 0;    ///< that the recipe has
  std::size_t failed = 0;          ///< in failed.jsonl
  std::size_t files = 0;           ///< in the manifest
  std::string digest{};            ///< Digest of the manifest's cases
  std::set<Versions> made_with{};  ///< more than one if several machines or versions made it

  bool is_complete() const { return cases == recipe_cases; }
};

/// One hash for a whole dataset: the SHA-256 of a line "checksum  path" for each file, as sha256sum prints
/// them, in the manifest's order.
class Digest {
public:
  void add(const CaseRecord& record);
  std::size_t files() const { return files_; }
  std::string hex() const { return hash_.hex(); }

private:
  Sha256 hash_;
  std::size_t files_ = 0;
};

/// A line of JSON with nothing but `made_with`, as in dataset.json, and the inverse, which throws InputError.
std::string to_json(const std::set<Versions>& made_with);
std::set<Versions> made_with(const std::string& json, const std::string& file, std::size_t line);

/// The text of dataset.json.
std::string to_json(const DatasetSummary& summary);

/// dataset.json of a directory; nullopt if there is none. Throws InputError if it cannot be read.
std::optional<DatasetSummary> read_dataset_summary(const std::filesystem::path& directory);

}  // namespace tanglebin
