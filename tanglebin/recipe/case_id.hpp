#pragma once

#include <compare>
#include <string>
#include <string_view>
#include <vector>

namespace tanglebin {

struct Recipe;

/// One scene of a dataset.
struct CaseId {
  std::string set;
  int tubes = 1;   ///< how many are in the scene
  int number = 1;  ///< 1, 2, … of this set and number of tubes

  // NOLINTNEXTLINE(modernize-use-nullptr): a false alarm of clang-tidy 14
  auto operator<=>(const CaseId&) const = default;
};

/// Every case of a valid recipe: by set, number of tubes (both in the recipe's order) and number. Cases that
/// draw their number of tubes are by set and number.
std::vector<CaseId> cases(const Recipe& recipe);

/// Throws InputError naming the first of these cases that the recipe does not have.
void expect_cases(const Recipe& recipe, const std::vector<CaseId>& wanted);

/// The folder of the cases of one set and number of tubes, as in the published data: "A10".
std::string folder_name(std::string_view set, int tubes);

/// "A10/3".
std::string name_of(const CaseId& id);

/// A file of a case, relative to the dataset's directory: "A10/plys/1.ply", or of a scanner that has a name
/// "A10/left/plys/1.ply".
std::string file_of(const CaseId& id, std::string_view kind, std::string_view extension,
                    std::string_view scanner = {});

}  // namespace tanglebin
