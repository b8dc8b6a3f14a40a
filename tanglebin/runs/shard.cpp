#include "tanglebin/runs/shard.hpp"

#include <fmt/core.h>

#include <string_view>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {
namespace {

constexpr const char* slurm_index = "SLURM_ARRAY_TASK_ID";
constexpr const char* kubernetes_index = "JOB_COMPLETION_INDEX";
constexpr std::string_view remedy = "; --shard I/N says which part to make";

std::optional<int> number_in(const Environment& environment, const std::string& name) {
  const std::optional<std::string> text = environment(name);
  if (!text) return std::nullopt;
  const auto number = to_number<int>(*text);
  if (!number || *number < 0) {
    throw InputError({"", 0, name}, excerpt(*text), fmt::format("a whole number, not negative{}", remedy));
  }
  return number;
}

int required_number_in(const Environment& environment, const std::string& name, std::string_view who) {
  const std::optional<int> number = number_in(environment, name);
  if (!number) throw InputError({"", 0, name}, fmt::format("not set, though {}{}", who, remedy));
  return *number;
}

Shard checked(const Shard& shard, const std::string& variable, int found) {
  if (shard.index >= 1 && shard.index <= shard.count) return shard;
  throw InputError({"", 0, variable}, fmt::format("{}", found),
                   fmt::format("one of {} numbers without a gap{}", shard.count, remedy));
}

std::optional<Shard> slurm_shard(const Environment& environment) {
  const std::optional<int> id = number_in(environment, slurm_index);
  if (!id) return std::nullopt;
  constexpr std::string_view who = "SLURM_ARRAY_TASK_ID is";
  const int count = required_number_in(environment, "SLURM_ARRAY_TASK_COUNT", who);
  const int first = required_number_in(environment, "SLURM_ARRAY_TASK_MIN", who);
  const int step = number_in(environment, "SLURM_ARRAY_TASK_STEP").value_or(1);
  const int last = first + (count - 1) * step;
  if (const int found = number_in(environment, "SLURM_ARRAY_TASK_MAX").value_or(last); found != last) {
    throw InputError({"", 0, "SLURM_ARRAY_TASK_MAX"}, fmt::format("{}", found),
                     fmt::format("{}, the last of {} numbers without a gap{}", last, count, remedy));
  }
  const bool is_on_a_step = step > 0 && (*id - first) % step == 0;
  return checked({is_on_a_step ? (*id - first) / step + 1 : 0, count}, slurm_index, *id);
}

std::optional<Shard> kubernetes_shard(const Environment& environment) {
  const std::optional<int> index = number_in(environment, kubernetes_index);
  if (!index) return std::nullopt;
  const int count = required_number_in(environment, "JOB_COMPLETIONS", "JOB_COMPLETION_INDEX is");
  return checked({*index + 1, count}, kubernetes_index, *index);
}

}  // namespace

std::string name_of(const Shard& shard) {
  return fmt::format("{}-of-{}", shard.index, shard.count);
}

std::optional<std::string> array_variable(const Environment& environment) {
  for (const char* name : {slurm_index, kubernetes_index}) {
    if (environment(name)) return name;
  }
  return std::nullopt;
}

std::optional<Shard> shard_from(const Environment& environment) {
  if (const std::optional<Shard> shard = slurm_shard(environment)) return shard;
  return kubernetes_shard(environment);
}

}  // namespace tanglebin
