#pragma once

#include <compare>
#include <string>

#include "tanglebin/dataset/dataset.hpp"

namespace tanglebin {

/// A case as one of its scanners sees it.
struct SeenCase {
  CaseId scene;
  std::string scanner{};  ///< its name; empty for the one [scanner] of a recipe

  // NOLINTNEXTLINE(modernize-use-nullptr): a false alarm of clang-tidy 14
  auto operator<=>(const SeenCase&) const = default;
};

/// What a scanner sees, in words: "A, left" of a scanner that has a name, otherwise "A".
std::string seen_by(const std::string& scanner, const std::string& what);

/// "A10/3", or "A10/3, left" of a scanner that has a name.
std::string name_of(const SeenCase& seen);

/// The recipe of a finished case (recipe_of()) with this scanner alone. Throws InputError if there is no such
/// scanner.
Recipe recipe_seen(const Dataset& dataset, const SeenCase& seen);

/// The scanner's cloud of a finished case, and the tubes. Throws InputError as read_case() does.
CaseData read_seen_case(const Dataset& dataset, const SeenCase& seen);

}  // namespace tanglebin
