#pragma once

#include <string>

namespace tanglebin::cli {

/// Scores a directory of labels against the dataset in `directory`, and prints a row for each scene and the
/// means by number of tubes. Throws CLI::RuntimeError with exit_cases_failed if scenes have no labels that
/// can be read.
void score_dataset(const std::string& directory, const std::string& labels, bool json);

}  // namespace tanglebin::cli
