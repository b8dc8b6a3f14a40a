#include "tanglebin/calibrate/calibration_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/random.hpp"
#include "tanglebin/dataset/generate_dataset.hpp"
#include "tanglebin/dataset/seen_case.hpp"
#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {
namespace {

// So many, one of each set and number of tubes before the second of any; what does not suffice for another of
// each is spread evenly over them. In mixed order.
std::vector<CaseId> scenes_of(const Recipe& recipe, int count) {
  std::vector<CaseId> all = cases(recipe);
  std::ranges::stable_sort(all, {}, &CaseId::number);
  const auto kinds = static_cast<std::size_t>(std::ranges::count(all, 1, &CaseId::number));
  const auto wanted = static_cast<std::size_t>(count);
  const std::size_t rest = wanted % kinds;
  std::vector<CaseId> ids(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(wanted - rest));
  for (std::size_t i = 0; i < rest; ++i) ids.push_back(all[wanted - rest + i * kinds / rest]);
  Rng rng(recipe.seed);
  for (std::size_t i = ids.size(); i > 1; --i)
    std::swap(ids[i - 1], ids[static_cast<std::size_t>(uniform_integer(rng, 0, static_cast<int>(i) - 1))]);
  return ids;
}

bool shows_a_tube(const Dataset& dataset, const CaseId& id) {
  return std::ranges::all_of(scanners(dataset.recipe), [&](const Scanner& scanner) {
    return has_tube(read_seen_case(dataset, {id, scanner.name}).cloud.labels);
  });
}

}  // namespace

Recipe recipe_of_part(Recipe recipe, const std::string& part, int count) {
  constexpr std::uint64_t greatest_seed = (std::uint64_t{1} << 63U) - 1;  // that TOML can hold
  recipe.seed = attempt_seed(recipe.seed, "calibration, " + part, 0, 0, 0) & greatest_seed;
  recipe.output = {.bin_points = recipe.output.bin_points, .worlds = false, .properties = {.mixed = true}};
  for (SetRecipe& set : recipe.sets) set.cases = count;
  return recipe;
}

std::optional<CalibrationScenes> make_scenes(const Recipe& recipe, const std::string& part, int count,
                                             const std::filesystem::path& directory, int jobs,
                                             const RunObserver& observer) {
  const Recipe own = recipe_of_part(recipe, part, count);
  const std::vector<CaseId> wanted = scenes_of(own, count);
  const FillSummary summary = generate_dataset(own, wanted, directory / part, jobs, observer);
  if (summary.was_interrupted) return std::nullopt;
  CalibrationScenes made{read_dataset(directory / part), {}};
  for (const CaseId& id : wanted) {
    if (made.dataset.catalogue.has(id) && shows_a_tube(made.dataset, id)) made.scenes.push_back(id);
  }
  if (!made.scenes.empty()) return made;
  const std::string reason = summary.failed.empty()
                                 ? "no scene shows a tube to the scanner"
                                 : fmt::format("no valid scene: {}", summary.failed.front().reason);
  throw InputError({"", 0, ""}, reason);
}

}  // namespace tanglebin
