#pragma once

#include <filesystem>

#include "tanglebin/files/json_record.hpp"
#include "tanglebin/files/safe_file.hpp"

namespace tanglebin {

/// The results as tables for a spreadsheet (RFC 4180): results.csv with a row for each run, tubes.csv with
/// one for each tube of each run. They are written row by row. A run that failed has a micro-recall of 0,
/// unless there was nothing to score.
class ResultTables {
public:
  ResultTables(const std::filesystem::path& directory, const std::filesystem::path& staging);

  /// Adds a line of results.jsonl.
  void add(const JsonRecord& result);

  /// Gives both files their names.
  void commit();

private:
  StagedFile runs_;
  StagedFile tubes_;
};

}  // namespace tanglebin
