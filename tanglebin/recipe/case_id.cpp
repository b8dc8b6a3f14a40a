#include "tanglebin/recipe/case_id.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tanglebin/base/expect.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/recipe/randomization.hpp"

namespace tanglebin {

std::vector<CaseId> cases(const Recipe& recipe) {
  std::vector<CaseId> result;
  for (const SetRecipe& set : recipe.sets) {
    for (const int tubes : set.tubes)
      for (int number = 1; number <= set.cases; ++number) result.push_back({set.name, tubes, number});
    if (!set.drawn_tubes) continue;
    for (int number = 1; number <= set.cases; ++number)
      result.push_back({set.name, draw_number_of_tubes(recipe, set, number), number});
  }
  return result;
}

void expect_cases(const Recipe& recipe, const std::vector<CaseId>& wanted) {
  std::vector<CaseId> all = cases(recipe);
  std::ranges::sort(all);
  for (const CaseId& id : wanted)
    expect(std::ranges::binary_search(all, id), "wanted", excerpt(name_of(id)), "a case of the recipe");
}

std::string folder_name(std::string_view set, int tubes) {
  return fmt::format("{}{}", set, tubes);
}

std::string name_of(const CaseId& id) {
  return fmt::format("{}/{}", folder_name(id.set, id.tubes), id.number);
}

std::string file_of(const CaseId& id, std::string_view kind, std::string_view extension,
                    std::string_view scanner) {
  return fmt::format("{}/{}{}{}/{}.{}", folder_name(id.set, id.tubes), scanner, scanner.empty() ? "" : "/",
                     kind, id.number, extension);
}

}  // namespace tanglebin
