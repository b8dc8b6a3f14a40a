#include "tanglebin/report/model_again.hpp"

#include <system_error>
#include <variant>

#include "tanglebin/base/error.hpp"
#include "tanglebin/experiment/summary.hpp"
#include "tanglebin/files/safe_file.hpp"

namespace tanglebin {

ModelAgain::ModelAgain(const std::filesystem::path& results, const Dataset& dataset,
                       const ExperimentSettings& settings, const std::function<void()>& at_run)
    : dataset_(dataset), settings_(settings), at_run_(at_run), scratch_(results / ".pictures.unfinished") {
  std::filesystem::remove_all(scratch_);
  make_directories(scratch_);
}

ModelAgain::~ModelAgain() {
  std::error_code ignored;
  std::filesystem::remove_all(scratch_, ignored);
}

std::optional<Model> ModelAgain::operator()(const Entry& entry, const SeenCase& seen,
                                            const CaseData& data) const {
  at_run_();
  const auto& [scene, scanner] = seen;
  const RunId run{entry.name, scene, ratio_to_show(settings_.ratios), scanner};
  const KnownScene known = known_scene(recipe_seen(dataset_, seen), data, scene, settings_.scene);
  try {
    return model_by(entry, known, data, run, settings_, scratch_).model;
  } catch (const InputError&) {
    if (is_built_in(entry)) throw;
    return std::nullopt;
  }
}

}  // namespace tanglebin
