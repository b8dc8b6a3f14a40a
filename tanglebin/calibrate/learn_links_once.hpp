#pragma once

#include <filesystem>
#include <vector>

#include "tanglebin/calibrate/race.hpp"
#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/runs/workers.hpp"

namespace tanglebin {

/// All weights of links, as parameters, learned from these scenes (learn_links.hpp) in a worker process; none
/// of a kind of link that the scenes do not have. They are kept in `file`, a profile, and not learned again.
/// Throws CalibrationStopped if SIGINT or SIGTERM ended it, and SystemError with the reason if the worker
/// fails.
Parameters learn_links_once(const Dataset& dataset, const std::vector<CaseId>& scenes,
                            const std::filesystem::path& file, const WorkersObserver& observer);

/// The parameters to start from with the learned weights in place of their own. None is at its default.
Parameters with_links(const Parameters& start, const Parameters& learned);

}  // namespace tanglebin
