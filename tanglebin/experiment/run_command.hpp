#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/experiment/entry.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// What a command made of a cloud: labels, tubes or both.
struct CommandOutput {
  std::optional<std::vector<std::int32_t>> labels;  ///< for each point
  std::optional<std::vector<Tube>> tubes;
  double seconds;  ///< wall clock, from its start to its end
};

/// Runs the command once, in a directory of its own below `scratch`, which must exist, with no more of the
/// case than the cloud and what is known of the scene. Afterwards, the directory is gone and nothing that was
/// started is running. Throws InputError if the command fails, takes more than its limits allow, writes no
/// output or writes one that cannot be read; the message does not depend on the directory's name.
CommandOutput run_command(const Command& command, const PointCloud& cloud, const KnownScene& known,
                          const std::filesystem::path& scratch);

}  // namespace tanglebin
