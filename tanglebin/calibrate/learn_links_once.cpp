#include "tanglebin/calibrate/learn_links_once.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "tanglebin/base/bytes_of.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/calibrate/scene_scores.hpp"
#include "tanglebin/experiment/learn_links.hpp"
#include "tanglebin/files/safe_file.hpp"
#include "tanglebin/model/parameters.hpp"
#include "tanglebin/profile/profile.hpp"

namespace tanglebin {
namespace {

LinkWeights weights_from(const Dataset& dataset, const std::vector<CaseId>& scenes) {
  std::vector<LinkScene> seen;
  for (const CaseId& id : scenes) {
    for (const Scanner& scanner : scanners(dataset.recipe)) {
      stop_if_asked();
      std::ranges::move(link_scenes(dataset, {id, scanner.name}), std::back_inserter(seen));
    }
  }
  return learn_weights(seen);
}

// With four decimals, as those that ship.
double rounded_weight(double weight) {
  constexpr double decimals = 1e4;
  return std::round(weight * decimals) / decimals;
}

// Of the kinds of links that the scenes have.
Parameters learned_parameters(const LinkWeights& weights) {
  Parameters learned = link_parameters(weights);
  for (const LinkKind kind : link_kinds) {
    const LinkFeatures& its = weights.of(kind);
    if (std::ranges::any_of(its, [](double weight) { return weight != 0; })) continue;
    const std::string prefix = fmt::format("axis.link.weights.{}.", name_of(kind));
    std::erase_if(learned, [&](const auto& parameter) { return parameter.first.starts_with(prefix); });
  }
  for (auto& [name, weight] : learned) weight = rounded_weight(weight);
  return learned;
}

}  // namespace

Parameters learn_links_once(const Dataset& dataset, const std::vector<CaseId>& scenes,
                            const std::filesystem::path& file, const WorkersObserver& observer) {
  const auto learn = [&](std::size_t /*task*/) {
    const Parameters learned = learned_parameters(weights_from(dataset, scenes));
    write_file(file, bytes_of([&](std::ostream& out) {
                 write_profile(out, {.parameters = learned, .method = Method::axis},
                               "Weights of links, learned from the scenes to calibrate on");
               }));
    return std::string();
  };
  WorkersObserver or_throw = observer;
  or_throw.failed = [&](const TaskFailure& failure) {
    observer.failed(failure);
    throw SystemError(file.string(), "cannot learn the weights of links: " + failure.reason);
  };
  if (!std::filesystem::exists(file) && !run_in_workers(1, 1, learn, or_throw)) throw CalibrationStopped();
  return read_profile(file).parameters;
}

Parameters with_links(const Parameters& start, const Parameters& learned) {
  ModelSettings settings;
  for (const Parameters& given : {start, learned}) {
    for (const auto& [name, value] : given) set_parameter(settings, name, value);
  }
  return changed_parameters(settings);
}

}  // namespace tanglebin
