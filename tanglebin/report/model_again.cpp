#include "tanglebin/report/model_again.hpp"

#include <cstdint>
#include <system_error>
#include <unordered_set>
#include <utility>
#include <variant>

#include "tanglebin/base/error.hpp"
#include "tanglebin/experiment/kept_models.hpp"
#include "tanglebin/experiment/summary.hpp"
#include "tanglebin/files/safe_file.hpp"

namespace tanglebin {

namespace fs = std::filesystem;

namespace {

std::size_t count_of_labels(const Model& model) {
  std::unordered_set<std::int32_t> labels(model.labels.begin(), model.labels.end());
  for (const Tube& tube : model.tubes) labels.insert(tube.id);
  return labels.size();
}

}  // namespace

ModelAgain::ModelAgain(fs::path results, const Dataset& dataset, const ExperimentSettings& settings,
                       std::function<void()> at_run)
    : results_(std::move(results)),
      dataset_(dataset),
      settings_(settings),
      at_run_(std::move(at_run)),
      scratch_(results_ / ".pictures.unfinished") {
  fs::remove_all(scratch_);
  make_directories(scratch_);
}

ModelAgain::~ModelAgain() {
  std::error_code ignored;
  fs::remove_all(scratch_, ignored);
}

std::optional<Model> ModelAgain::operator()(const Entry& entry, const SeenCase& seen, const CaseData& data) {
  std::optional<Model> found = known_or_new(entry, seen, data);
  if (!found || count_of_labels(*found) <= most_labels_to_show) return found;
  left_out_.emplace(entry.name, seen);
  return std::nullopt;
}

std::optional<Model> ModelAgain::known_or_new(const Entry& entry, const SeenCase& seen,
                                              const CaseData& data) {
  if (!std::holds_alternative<Command>(entry.what)) return model(entry, seen, data);
  const auto [known, is_new] = of_commands_.try_emplace({entry.name, seen});
  if (is_new) known->second = model(entry, seen, data);
  return known->second;
}

std::optional<Model> ModelAgain::model(const Entry& entry, const SeenCase& seen, const CaseData& data) const {
  at_run_();
  const auto& [scene, scanner] = seen;
  const RunId run{entry.name, scene, ratio_to_show(settings_.ratios), scanner};
  const bool is_kept = std::holds_alternative<Command>(entry.what) && has_model(results_, run);
  const Entry source = is_kept ? entry_of_kept(results_, entry.name) : entry;
  const KnownScene known = told_scene(recipe_seen(dataset_, seen), data, scene, settings_.scene);
  try {
    return model_by(source, known, data, run, settings_, scratch_).model;
  } catch (const InputError&) {
    if (is_built_in(entry)) throw;
    return std::nullopt;
  }
}

}  // namespace tanglebin
