#include "tanglebin/calibrate/learn_links_once.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/calibrate/scene_scores.hpp"
#include "tanglebin/experiment/learn_links.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/model/parameters.hpp"
#include "tanglebin/profile/profile.hpp"

namespace tanglebin {
namespace {

LinkWeights weights_from(const Dataset& dataset, const std::vector<CaseId>& scenes) {
  std::vector<EndExample> examples;
  for (const CaseId& id : scenes) {
    for (const Scanner& scanner : scanners(dataset.recipe)) {
      stop_if_asked();
      std::ranges::copy(end_examples(dataset, {id, scanner.name}), std::back_inserter(examples));
    }
  }
  return learn_weights(examples);
}

// With four decimals, as those that ship.
double rounded_weight(double weight) {
  constexpr double decimals = 1e4;
  return std::round(weight * decimals) / decimals;
}

LinkWeights rounded_where_learned(LinkWeights weights) {
  for (const LinkKind kind : link_kinds) {
    LinkFeatures& its = weights.of(kind);
    const bool is_learned = std::ranges::any_of(its, [](double weight) { return weight != 0; });
    if (is_learned)
      std::ranges::transform(its, its.begin(), rounded_weight);
    else
      its = learned_weights.of(kind);
  }
  return weights;
}

}  // namespace

Parameters learn_links_once(const Dataset& dataset, const std::vector<CaseId>& scenes,
                            const std::filesystem::path& file, const WorkersObserver& observer) {
  const auto learn = [&](std::size_t /*task*/) {
    const LinkWeights weights = rounded_where_learned(weights_from(dataset, scenes));
    write_file(file, bytes_of([&](std::ostream& out) {
                 write_profile(out, {.parameters = link_parameters(weights), .method = Method::axis},
                               "Weights of links, learned from the scenes to calibrate on");
               }));
    return std::string();
  };
  if (!std::filesystem::exists(file) && !run_in_workers(1, 1, learn, observer)) throw CalibrationStopped();
  if (!std::filesystem::exists(file)) return {};  // the worker failed
  ModelSettings settings;
  apply(read_profile(file), settings);
  return changed_parameters(settings);
}

}  // namespace tanglebin
