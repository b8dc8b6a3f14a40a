#include "tanglebin/experiment/run_failure.hpp"

#include <array>
#include <utility>

#include "tanglebin/base/text.hpp"
#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {
namespace {

constexpr std::array<std::pair<FailureOf, const char*>, 3> names{
    {{FailureOf::scene, "scene"}, {FailureOf::method, "method"}, {FailureOf::worker, "worker"}}};

}  // namespace

std::optional<RunFailure> failure_of_scene(const std::vector<std::int32_t>& labels) {
  if (has_tube(labels)) return std::nullopt;
  return RunFailure{FailureOf::scene, "no point of the cloud is on a tube"};
}

void add_failure(Json& json, const RunFailure& failure) {
  for (const auto& [of, name] : names) {
    if (of == failure.of) json["failure_of"] = name;
  }
  json["failure"] = failure.reason;
}

std::optional<RunFailure> failure_in(const JsonRecord& record) {
  if (!record.has("failure")) return std::nullopt;
  const std::string found = record.text("failure_of");
  for (const auto& [of, name] : names) {
    if (found == name) return RunFailure{of, record.text("failure")};
  }
  record.fail("failure_of", excerpt(found), "scene, method or worker");
}

}  // namespace tanglebin
